#include <fmt/format.h>

#include <cmath>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

constexpr int most_enlarged = 1000;

const Choices<Quantity> quantities = {{"id", Quantity::id},
                                      {"distance", Quantity::distance},
                                      {"area", Quantity::area},
                                      {"neighbours", Quantity::neighbours},
                                      {"column:NAME", Quantity::column}};

Coloring parse_coloring(const std::string& text) {
  const std::string column = "column:";
  if (text.compare(0, column.size(), column) != 0) return {choose(quantities, text), ""};
  const std::string name(trimmed(text.substr(column.size())));
  if (name.empty()) throw Error("\"" + text + "\" names no column; give column:NAME");
  return {Quantity::column, name};
}

std::optional<double> parse_interval(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto interval = parse_number<double>(text);
  if (!interval || !std::isfinite(*interval) || *interval < 1) {
    throw Error("\"" + text + "\" must be a number of pixels, at least 1");
  }
  return interval;
}

/// "z=K" to a slice. Throws Error if it is not that.
VolumeSlice parse_slice(const std::string& text) {
  const bool is_of_an_axis = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  const auto at = is_of_an_axis ? parse_number<std::int64_t>(text.substr(2)) : std::nullopt;
  if (!at || *at < 0) throw Error("\"" + text + "\" must be z=K, y=K or x=K, such as z=128");
  return {text[0], *at};
}

}  // namespace

void add_picture_options(Command& command, PictureOptions& options) {
  command.begin_section(pictures_section);
  const Choices<std::optional<Palette>> palettes = {
      {"viridis", Palette::viridis},     {"turbo", Palette::turbo},     {"greys", Palette::greys},
      {"viridis_r", Palette::viridis_r}, {"turbo_r", Palette::turbo_r}, {"greys_r", Palette::greys_r},
      {"okabe-ito", Palette::okabe_ito}};
  command
      .add_parsed("--color", options.color, parse_coloring,
                  "What the colour of a pixel shows; a column has numbers or texts: " + names_of(quantities))
      .value_name("NAME")
      .default_text("id");
  command.add_choice(
      "--palette", options.palette, palettes,
      "Colours of quantities, with _r reversed; okabe-ito: 8 colours of ids and whole numbers");
  command
      .add_parsed("--scale", options.scale, parse_scale,
                  "Values at the ends of the palette, or percentiles, such as 2%,98%")
      .value_name("LOW,HIGH");
  command.add("--log", options.logarithmic, "Colours go by the logarithm of the quantity");
  command.add("--color-bar", options.color_bar, "Draw the scale at the right, with numbers");
  command.add("--edges", options.edge_width, "Draw the borders of the cells, N pixels wide")
      .value_name("[N]")
      .value_optional()
      .default_text("1")
      .in_range(1, widest_edge);
  const auto set_contours = [&options](const std::string& text) {
    options.contours = true;
    return parse_interval(text);
  };
  command
      .add_parsed("--contours", options.contour_interval, set_contours,
                  "Draw lines of equal distance to the nearest seed, one every D pixels")
      .value_name("[D]")
      .value_optional();
  command.add("--points-overlay", options.points_overlay, "Draw the seeds");
  command.add("--stamp", options.stamp, "Write the frame, and its time step, into the lower left corner");
  command.add("--enlarge", options.enlargement, "Draw each pixel as a square of K x K")
      .value_name("K")
      .in_range(1, most_enlarged)
      .default_is_value();
}

void refuse_picture_options(const Command& command, const std::string& files) {
  for (const char* name : {"--color", "--palette", "--scale", "--log", "--color-bar", "--edges", "--contours",
                           "--points-overlay", "--stamp", "--enlarge"}) {
    if (command.has(name)) throw UsageError(std::string(name) + " requires " + files);
  }
}

void add_slice_option(Command& command, PictureOptions& options) {
  command
      .add_parsed("--slice", options.slice, parse_slice,
                  "Of a volume, the slice that the picture shows, from 0: z=K, or along x or y")
      .value_name("z=K")
      .in_section(pictures_section);
}

void check_slice(const PictureOptions& options, const std::string& picture_path, const Grid& volume) {
  const std::optional<VolumeSlice>& slice = options.slice;
  if (picture_path.empty()) {
    if (slice) throw UsageError("--slice is of the picture: give -o PICTURE");
    return;
  }
  if (!slice) throw UsageError("-o needs --slice z=K, the slice of the volume that it shows");
  const std::int64_t slices = slices_along(volume, slice->axis);
  if (slice->at >= slices) {
    throw UsageError(fmt::format("--slice {}={}: the volume has slices from 0 to {} there", slice->axis,
                                 slice->at, slices - 1));
  }
  const char* const of_planes = options.color.quantity != Quantity::id ? "--color"
                                : options.color_bar                    ? "--color-bar"
                                : options.scale                        ? "--scale"
                                : options.logarithmic                  ? "--log"
                                : options.contours                     ? "--contours"
                                                                       : nullptr;
  if (of_planes != nullptr) {
    throw UsageError(std::string(of_planes) + " is for planes: the picture of a slice shows ids");
  }
  check_picture_options(options);
  check_picture_size(options, size_of_slice(volume, *slice));
}

void check_picture_options(const PictureOptions& options) {
  const bool by_id = options.color.quantity == Quantity::id;
  const bool is_continuous =
      options.color.quantity == Quantity::distance || options.color.quantity == Quantity::area;
  if (by_id && options.palette && !is_categorical(*options.palette)) {
    throw UsageError(
        "this --palette is for quantities, such as --color distance; ids take okabe-ito, or none");
  }
  if (is_continuous && options.palette && is_categorical(*options.palette)) {
    throw UsageError(
        "--palette okabe-ito is for ids and whole numbers, and distances and areas are continuous "
        "quantities; take viridis, turbo or greys");
  }
  const char* const of_quantities = options.color_bar     ? "--color-bar"
                                    : options.scale       ? "--scale"
                                    : options.logarithmic ? "--log"
                                                          : nullptr;
  if (options.logarithmic && options.palette && is_categorical(*options.palette)) {
    throw UsageError(
        "--log is for quantities, and --palette okabe-ito for whole numbers; take viridis, turbo or greys");
  }
  if (options.logarithmic && options.scale && !options.scale->percent && options.scale->low <= 0) {
    throw UsageError(
        fmt::format("--log needs a --scale that begins above 0, and not at {}", options.scale->low));
  }
  if (by_id && of_quantities != nullptr) {
    throw UsageError(fmt::format(
        "{} needs a --color that is a quantity: distance, area, neighbours or column:NAME", of_quantities));
  }
}

void check_picture_size(const PictureOptions& options, const Size& size) {
  const int most = Size::max_side / size.longest_side();
  if (options.enlargement > most) {
    throw UsageError(
        fmt::format("--enlarge {} of {} x {} pixels makes too large a picture; at most {} is possible",
                    options.enlargement, size.width(), size.height(), most));
  }
}

ScaleEnds parse_scale(const std::string& text) {
  const Error error("\"" + text +
                    "\" must be LOW,HIGH, two numbers of which the second is greater, such as 0,100, or "
                    "percentiles, such as 2%,98%");
  const auto comma = text.find(',');
  if (comma == std::string::npos) throw error;
  int percents = 0;
  const auto end = [&](std::string_view number) {
    number = trimmed(number);
    if (!number.empty() && number.back() == '%') {
      ++percents;
      number.remove_suffix(1);
    }
    const auto value = parse_number<double>(number);
    if (!value || !std::isfinite(*value)) throw error;
    return *value;
  };
  const std::string_view whole = text;
  const double low = end(whole.substr(0, comma)), high = end(whole.substr(comma + 1));
  if (low >= high || percents == 1 || (percents == 2 && (low < 0 || high > 100))) throw error;
  return {low, high, percents == 2};
}

}  // namespace vorocl::command
