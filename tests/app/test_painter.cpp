// Pictures of diagrams against straight counting of their labels on the host, and films that keep their
// scale.
#define BOOST_TEST_MODULE painter
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "app/outputs/painter.hpp"
#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

const Size size(90, 70);
const Grid grid = size.grid();
const double absent = std::numeric_limits<double>::quiet_NaN();

/// A diagram with everything that its pictures need, kept for as long as they are drawn.
struct Drawn {
  explicit Drawn(const std::vector<Point>& points, std::vector<double> column = {},
                 Metric distance = Metric::euclidean)
      : metric(distance),
        seeds(test_device(), grid, points),
        diagram(test_device(), grid),
        values(std::move(column)) {
    ExactOptions options;
    options.metric = metric;
    exact_diagram(seeds, diagram, options);
    labels = diagram.read();
  }

  /// The next picture of a film, or the only one.
  cv::Mat by(Painter& painter, const std::vector<std::uint32_t>& ids = {}) const {
    MeasureBuffers buffers;
    const View view = {size, grid};
    Measures measures(seeds, diagram, ids, view, buffers);
    return painter.draw(measures, {values, {}});
  }
  cv::Mat with(const PictureOptions& options) const {
    Painter painter(options);
    return by(painter);
  }

  Metric metric;
  Seeds seeds;
  Diagram diagram;
  std::vector<double> values;
  std::vector<std::uint32_t> labels;
};

/// Random pixels, with some seeds on one pixel.
std::vector<Pixel> some_pixels(std::size_t count, std::uint32_t start) {
  std::vector<Pixel> pixels = random_pixels(grid, count, start);
  pixels.push_back(pixels[1]);
  pixels.push_back(pixels[2]);
  return pixels;
}

PictureOptions options_for(Quantity quantity, const std::string& column = "") {
  PictureOptions options;
  options.color = {quantity, column};
  return options;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

std::vector<double> counted_areas(const std::vector<std::uint32_t>& labels, std::size_t seeds) {
  std::vector<double> areas(seeds, 0);
  for (const std::uint32_t label : labels) ++areas[label];
  return areas;
}

std::vector<double> counted_neighbours(const std::vector<std::uint32_t>& labels, std::size_t seeds) {
  std::vector<std::set<std::uint32_t>> sets(seeds);
  const auto width = static_cast<std::size_t>(grid.width());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (const std::size_t other :
         {(i + 1) % width != 0 ? i + 1 : i, i + width < labels.size() ? i + width : i}) {
      if (labels[i] == labels[other]) continue;
      sets[labels[i]].insert(labels[other]);
      sets[labels[other]].insert(labels[i]);
    }
  }
  return transformed(sets, [](const auto& set) { return static_cast<double>(set.size()); });
}

std::vector<float> counted_distances(const std::vector<Pixel>& seeds,
                                     const std::vector<std::uint32_t>& labels, Metric metric) {
  std::vector<float> distances;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const Pixel& seed = seeds[labels[distances.size()]];
      distances.push_back(metric == Metric::euclidean
                              ? static_cast<float>(std::hypot(x - seed.x, y - seed.y))
                              : static_cast<float>(std::abs(x - seed.x) + std::abs(y - seed.y)));
    }
  }
  return distances;
}

/// The least and the greatest of the values that are not 0 (every cell with a pixel has an area and, with two
/// seeds or more, a neighbour).
Scale range_of_cells(const std::vector<double>& values) {
  Scale range = {1e300, -1e300};
  for (const double value : values) {
    if (value == 0 || std::isnan(value)) continue;
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_picture_of_a_film_has_the_colours_of_its_own_ids) {
  const Drawn drawn(centres(random_pixels(grid, 60, 3)));
  for (const std::optional<Palette> palette : {std::optional<Palette>(), std::optional(Palette::okabe_ito)}) {
    PictureOptions options;
    options.palette = palette;
    Painter painter(options, true);
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < drawn.seeds.size(); ++i) ids.push_back(7 * i + 3);
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      std::vector<std::uint32_t> shown = drawn.labels;
      for (std::uint32_t& label : shown) label = ids.at(label);
      BOOST_TEST(same(drawn.by(painter, ids),
                      palette ? color_by_id(shown, grid, *palette) : color_by_id(shown, grid)));
      std::swap(ids[1], ids[4]);
      ids[frame] = 100000 + frame;  // a newcomer
    }
  }
}

BOOST_AUTO_TEST_CASE(areas_are_counted) {
  const std::vector<Pixel> pixels = some_pixels(60, 1);
  const Drawn drawn(centres(pixels));
  const std::vector<double> areas = counted_areas(drawn.labels, pixels.size());
  BOOST_TEST(same(drawn.with(options_for(Quantity::area)),
                  color_by_value(drawn.labels, grid, areas, range_of_cells(areas), Palette::viridis)));
}

BOOST_AUTO_TEST_CASE(neighbours_are_counted) {
  const std::vector<Pixel> pixels = some_pixels(60, 2);
  const Drawn drawn(centres(pixels));
  const std::vector<double> counts = counted_neighbours(drawn.labels, pixels.size());
  for (const Palette palette : {Palette::greys, Palette::okabe_ito}) {
    PictureOptions options = options_for(Quantity::neighbours);
    options.palette = palette;
    BOOST_TEST(same(drawn.with(options),
                    color_by_value(drawn.labels, grid, counts, range_of_cells(counts), palette)));
  }
}

BOOST_AUTO_TEST_CASE(distances_are_those_of_the_metric) {
  const std::vector<Pixel> pixels = some_pixels(20, 3);
  for (const Metric metric : both_metrics) {
    const Drawn drawn(centres(pixels), {}, metric);
    const std::vector<float> distances = counted_distances(pixels, drawn.labels, metric);
    const Scale scale = {0, *std::max_element(distances.begin(), distances.end())};
    const cv::Mat picture = drawn.with(options_for(Quantity::distance));
    const cv::Mat expected = color_by_distance(distances, grid, scale, Palette::viridis);
    BOOST_TEST(cv::norm(picture, expected, cv::NORM_INF) <= 4, name_of(metric));  // a level, of rounding

    PictureOptions options = options_for(Quantity::id);
    options.contours = true;
    options.edge_width = 2;
    cv::Mat lines = color_by_id(drawn.labels, grid);
    draw_contours(lines, distances, round_step(scale, 10));
    draw_edges(lines, drawn.labels, 2);
    BOOST_TEST(same(drawn.with(options), lines), name_of(metric));
  }
}

BOOST_AUTO_TEST_CASE(columns_colour_the_cells_of_their_seeds) {
  const std::vector<Pixel> pixels = random_pixels(grid, 5, 4);
  const Drawn drawn(centres(pixels), {-1, 0.5, absent, 3, 2});
  const cv::Mat picture = drawn.with(options_for(Quantity::column, "c"));
  const std::uint8_t levels[] = {0, 96, 0, 255, 191};  // of viridis, from -1 to 3
  for (std::size_t id = 0; id < pixels.size(); ++id) {
    const auto& color = picture.at<cv::Vec3b>(static_cast<int>(pixels[id].y), static_cast<int>(pixels[id].x));
    if (id == 2) {
      BOOST_TEST((color[0] == color[1] && color[1] == color[2] && color[0] > 180));
    } else {
      const cv::Mat expected =
          color_by_distance({static_cast<float>(levels[id])}, Grid(1, 1), {0, 255}, Palette::viridis);
      BOOST_TEST((color == expected.at<cv::Vec3b>(0, 0)), "seed " << id);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_film_keeps_its_scale_and_size) {
  const Drawn few(centres(random_pixels(grid, 9, 5))), many(centres(random_pixels(grid, 200, 6)));
  for (const Quantity quantity : {Quantity::area, Quantity::distance, Quantity::neighbours}) {
    PictureOptions options = options_for(quantity);
    Painter film(options, true);
    const cv::Mat first = few.by(film), second = many.by(film);
    BOOST_TEST(same(first, few.with(options)));
    BOOST_TEST(!same(second, many.with(options)));
    // An area that cells of both frames have has one colour.
    std::map<double, std::set<int>> colors;
    for (const auto& [drawn, picture] : {std::pair(&few, first), std::pair(&many, second)}) {
      const std::vector<double> areas = counted_areas(drawn->labels, drawn->seeds.size());
      for (std::size_t i = 0; i < grid.pixels(); ++i) {
        const cv::Vec3b color = picture.at<cv::Vec3b>(static_cast<int>(i));
        if (quantity == Quantity::area)
          colors[areas[drawn->labels[i]]].insert(color[0] | color[1] << 8 | color[2] << 16);
      }
    }
    for (const auto& [value, of_value] : colors) BOOST_TEST(of_value.size() == 1u, value);

    options.color_bar = true;
    Painter with_bar(options, true);
    const cv::Mat bar = few.by(with_bar), later = many.by(with_bar);
    const cv::Rect strip(size.width(), 0, bar.cols - size.width(), bar.rows);
    BOOST_TEST(bar.size() == later.size());
    BOOST_TEST(same(bar(strip), later(strip)));
  }
}

BOOST_AUTO_TEST_CASE(a_film_keeps_its_contours) {
  const std::vector<Pixel> few = random_pixels(grid, 9, 5), many = random_pixels(grid, 200, 6);
  const Drawn first(centres(few)), second(centres(many));
  PictureOptions options;
  options.contours = true;
  Painter film(options, true);
  first.by(film);
  options.contour_interval =
      round_step(*range_of(counted_distances(few, first.labels, Metric::euclidean)), 10);
  const cv::Mat lines = second.by(film);
  BOOST_TEST(same(lines, second.with(options)));
  options.contour_interval.reset();
  BOOST_TEST(!same(lines, second.with(options)));
}

BOOST_AUTO_TEST_CASE(a_given_scale_holds_for_every_picture) {
  PictureOptions options = options_for(Quantity::column, "c");
  options.scale = {0, 10};
  const std::vector<Point> points = centres(random_pixels(grid, 2, 7));
  Painter film(options, true);
  const cv::Mat a = Drawn(points, {5, 10}).by(film), b = Drawn(points, {5, 100}).by(film);
  BOOST_TEST(same(a, b));  // 100 is drawn as 10
  BOOST_TEST(!same(a, Drawn(points, {6, 10}).by(film)));
}

BOOST_AUTO_TEST_CASE(pictures_without_values_are_possible_and_bars_are_not) {
  const Drawn empty(std::vector<Point>{}), unknown({{1, 1}, {5, 5}}, {absent, absent});
  const Drawn known({{1, 1}, {5, 5}}, {1, 2});
  for (const Quantity quantity :
       {Quantity::id, Quantity::area, Quantity::neighbours, Quantity::distance, Quantity::column}) {
    PictureOptions options = options_for(quantity, "c");
    options.contours = true;
    const cv::Mat picture = empty.with(options);
    BOOST_TEST(same(picture, cv::Mat(size.height(), size.width(), CV_8UC3, cv::Scalar::all(0))));
  }
  PictureOptions options = options_for(Quantity::column, "c");
  Painter film(options, true);
  unknown.by(film);
  BOOST_TEST(same(known.by(film), known.with(options)));
  options.color_bar = true;
  check_error([&] { unknown.with(options); }, {"no value", "--scale"});
  check_error([&] { empty.with(options); }, {"no value", "--scale"});
  options.scale = {0, 2};
  Painter with_bar(options, true);
  const Drawn fractions({{1, 1}, {5, 5}}, {0.5, 1});
  BOOST_TEST(empty.by(with_bar).size() == fractions.by(with_bar).size());
}

BOOST_AUTO_TEST_CASE(classes_must_be_whole_numbers) {
  PictureOptions options = options_for(Quantity::column, "c_pe");
  options.palette = Palette::okabe_ito;
  const std::vector<Point> points = {{1, 1}, {5, 5}, {9, 9}};
  Drawn(points, {1, absent, 3}).with(options);
  check_error(
      [&] {
        Drawn(points, {1, absent, 2.5}).with(options);
      },
      {"c_pe", "2.5", "okabe-ito", "viridis"});
}
