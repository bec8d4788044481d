#include <algorithm>

#include "app/options/option_groups.hpp"
#include "formats/files.hpp"
#include "formats/images/film.hpp"

namespace vorocl::command {

Option add_file_option(Command& command, FileRequest& request, bool numbered) {
  const FileKind& kind = request.kind;
  std::string example;
  if (numbered) example = "; one file per frame, such as frames/%05d" + kind.extensions.front();
  if (numbered && kind.table() != nullptr)
    example += ", or one table of all, such as " + kind.option.substr(2) + ".csv";
  return command.add(kind.option, request.path, kind.about + example).value_name(numbered ? "FILES" : "FILE");
}

void add_cell_columns_option(Command& command, FileRequest& cells) {
  Choices<std::string> columns;
  for (const std::string& name : cell_columns(CellsOf::both)) columns.emplace_back(name, name);
  const auto choose_all = [&cells, columns](const std::vector<std::string>& texts) {
    std::vector<std::string> names;
    for (const std::string& text : texts) {
      const std::string name = choose(columns, text);
      if (std::find(names.begin(), names.end(), name) != names.end())
        throw Error("\"" + name + "\" is given twice");
      names.push_back(name);
    }
    cells.columns = names;
  };
  command
      .add_texts("--cell-columns", choose_all, "The columns of --cells, in this order: " + names_of(columns))
      .value_name("NAMES")
      .default_text("all")
      .needs(command.option("--cells"));
}

void add_film_options(Command& command, FrameWriterOptions& options, const std::string& value_name,
                      const std::string& about) {
  command.begin_section(files_to_write);
  const Option picture = command.add("-o", options.picture_path, about).value_name(value_name);
  command.add("--fps", options.frames_per_second, "Frames per second of the film")
      .value_name("F")
      .in_range(0.1, 240.0)
      .default_is_value()
      .needs(picture);
  add_picture_options(command, options.picture);
  command.begin_section(files_to_write);
}

void check_film_options(const Command& command, const FrameWriterOptions& options) {
  if (options.picture_path.empty()) refuse_picture_options(command, "-o");
  if (command.has("--fps") && extension_of(options.picture_path) != film_extension)
    throw UsageError(std::string("--fps is for a film, such as -o a") + film_extension);
}

void add_frame_writer_options(Command& command, FrameWriterOptions& options) {
  add_film_options(command, options, "FILM|PICTURES",
                   "Film to write, .mp4 (H.264), or a picture for each frame, such as frames/%05d.png");
  options.files = {{labels_kind(), ""}, {cells_kind(), ""}, {adjacency_kind(), ""}, {distance_kind(), ""}};
  for (FileRequest& request : options.files) add_file_option(command, request, true);
  add_cell_columns_option(command, options.files[1]);
  command
      .add("--similarity", options.similarity_path,
           "Similarities to write, frame by frame, with --compare-with exact errors too: .csv")
      .value_name("FILE")
      .needs(command.option("--compare-with"));
  command
      .add("--statistics", options.statistics_path, "Statistics of cells to write, one row per frame: .csv")
      .value_name("FILE");
  command
      .add("--every", options.every,
           "Write pictures, files and rows of cells and pairs of frames 0, K, 2 K, ... alone")
      .value_name("K")
      .in_range(1, 1000000000)
      .default_is_value();
}

}  // namespace vorocl::command
