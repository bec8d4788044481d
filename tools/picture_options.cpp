#include "picture_options.hpp"

#include <opencv2/imgcodecs.hpp>

#include "options.hpp"
#include "quiet_standard_error.hpp"
#include "usage_error.hpp"

namespace vorocl::command {

void add_picture_options(CLI::App& app, PictureOptions& options, CLI::Option* file) {
  const Choices<Coloring> colorings = {{"id", Coloring::id}, {"distance", Coloring::distance}};
  const Choices<std::optional<Palette>> palettes = {{"viridis", Palette::viridis}, {"turbo", Palette::turbo}};
  add_choice(app, "--color", options.color, colorings,
             "What the colour of a pixel shows: its cell's seed or the distance to it")
      ->default_str("id")
      ->needs(file);
  add_choice(app, "--palette", options.palette, palettes, "Colours of distances")
      ->default_str("viridis")
      ->needs(file);
  app.add_flag("--edges", options.edges, "Draw the borders of the cells")->needs(file);
  app.add_flag("--points-overlay", options.points_overlay, "Draw the seeds")->needs(file);
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> all = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  return all;
}

void check_picture_options(const PictureOptions& options) {
  if (options.palette && options.color == Coloring::id) throw UsageError("--palette needs --color distance");
}

cv::Mat draw(const LabelImage& image, const LabelImage& named, const std::vector<Point>& seeds, Metric metric,
             const PictureOptions& options) {
  cv::Mat picture = options.color == Coloring::id
                        ? color_by_id(named.labels, named.grid)
                        : color_by_distance(image.labels, image.grid, seeds, metric,
                                            options.palette.value_or(Palette::viridis));
  if (options.edges) draw_edges(picture, image.labels);
  if (options.points_overlay) draw_points(picture, seeds);
  return picture;
}

void write_picture(const std::string& path, const cv::Mat& picture) {
  const QuietStandardError quiet;
  bool written = false;
  try {
    written = cv::imwrite(path, picture);
  } catch (const cv::Exception&) {  // its text names OpenCV's own source lines
  }
  if (!written) throw Error("writing " + path + " failed");
}

}  // namespace vorocl::command
