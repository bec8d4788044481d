// Times exact cells beside CGAL's Delaunay triangulation alone and Voro++'s cells, in turn in one run: the
// least and the median of the times by the clock, and the least processor time, which other work on the
// machine changes less.
//
//   c++ -std=c++17 -O3 -march=native exact_cells_peers.cpp $(pkg-config --cflags --libs vorocl) -lvoro++
//   -lgmp -o peers
//   ./peers uniform|periodic|lattice|wave|ellipse COUNT [REPEAT]
//   ./peers clusters COUNT [REPEAT] CITIES.csv    (samples/cities-5000.csv)
//
// VoroCL begins with points in the host's memory, and ends when all measures and polygons are on the device.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>
#include <voro++/voro++.hh>
#include <vorocl/vorocl.hpp>

namespace {

using vorocl::Point;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double side = 1 << 29;

struct Set {
  double height = side;
  bool is_periodic = false;
  std::vector<Point> points;
};

std::vector<Point> uniform(std::size_t count) {
  std::mt19937_64 random(5);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(random() % (1 << 29)), y = static_cast<double>(random() % (1 << 29));
    points.push_back({x, y});
  }
  return points;
}

std::vector<Point> lattice(std::size_t count) {
  const auto columns = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
  const double step = std::floor(side / static_cast<double>(columns));
  std::vector<Point> points;
  for (std::size_t i = 0; i < columns * columns; ++i) {
    points.push_back(
        {step * (static_cast<double>(i % columns) + 0.5), step * (static_cast<double>(i / columns) + 0.5)});
  }
  return points;
}

/// Points around cities, some 25 km from them.
std::vector<Point> clusters(std::size_t count, const char* path) {
  std::ifstream file(path);
  std::string line;
  std::vector<Point> cities;
  for (Point city; std::getline(file, line);) {
    if (std::sscanf(line.c_str(), "%lf,%lf", &city.x, &city.y) == 2) cities.push_back(city);
  }
  constexpr double spread = 25 / 111.2, radians = 3.14159265358979323846 / 180;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, spread);
  std::vector<Point> points;
  while (points.size() < count && !cities.empty()) {
    const Point city = cities[random() % cities.size()];
    const double squeezed = std::max(std::abs(std::cos(city.y * radians)), 0.1);
    const double x = std::fmod(city.x + normal(random) / squeezed + 540, 360);
    const double y = std::clamp(90 - city.y + normal(random), 0.0, 179.999);
    points.push_back({std::floor(x / 360 * side), std::floor(y / 360 * side)});
  }
  return points;
}

/// Points close to each other along a curve, of which this is the place at a fraction of its length.
template <typename Place>
std::vector<Point> curve(std::size_t count, Place place) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Point at = place(static_cast<double>(i) / static_cast<double>(count));
    points.push_back({std::floor(at.x * side), std::floor(at.y * side)});
  }
  return points;
}

double clock_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double processor_ms() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  return 1e3 * static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-3 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

struct Program {
  std::string name;
  std::function<void()> run;
  std::vector<double> clock = {}, processor = {};
};

void with_voro(const Set& set) {
  const double unit = 1 / side, layer = 0.5 / std::sqrt(static_cast<double>(set.points.size()));
  const int blocks = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(set.points.size()) / 3)));
  voro::container container(0, 1, 0, set.height * unit, -layer, layer, blocks, blocks, 1, set.is_periodic,
                            set.is_periodic, false, 8);
  for (std::size_t i = 0; i < set.points.size(); ++i)
    container.put(static_cast<int>(i), set.points[i].x * unit, set.points[i].y * unit, 0);
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbours;
  std::vector<double> areas;
  if (!loop.start()) return;
  do {
    if (!container.compute_cell(cell, loop)) continue;
    cell.volume();
    cell.neighbors(neighbours);
    cell.face_areas(areas);
  } while (loop.inc());
}

}  // namespace

int main(int count_of_arguments, char** arguments) {
  if (count_of_arguments < 3) return std::puts("see the head of the source"), 2;
  const std::string kind = arguments[1];
  const std::size_t count = std::strtoull(arguments[2], nullptr, 10);
  const int repeat = count_of_arguments > 3 ? std::atoi(arguments[3]) : 7;
  Set set;
  set.is_periodic = kind == "periodic";
  if (kind == "lattice") set.points = lattice(count);
  if (kind == "uniform" || kind == "periodic") set.points = uniform(count);
  if (kind == "wave")
    set.points = curve(count, [](double at) { return Point{at, 0.5 + 0.25 * std::sin(12 * at)}; });
  if (kind == "ellipse") {
    set.points = curve(count, [](double at) {
      const double angle = 2 * 3.14159265358979323846 * at;
      return Point{0.5 + 0.45 * std::cos(angle), 0.5 + 0.2 * std::sin(angle)};
    });
  }
  if (kind == "clusters" && count_of_arguments > 4) {
    set.height = side / 2;
    set.points = clusters(count, arguments[4]);
  }
  if (set.points.empty()) return std::puts("no such set, or no cities"), 2;

  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Axis x(1, 0, side), y(1, 0, set.height);
  const vorocl::Grid grid(set.is_periodic ? x.periodic() : x, set.is_periodic ? y.periodic() : y);
  vorocl::ExactCellsResult result;
  std::vector<Kernel::Point_2> points;
  for (const Point& point : set.points) points.emplace_back(point.x, point.y);

  std::vector<Program> programs;
  programs.push_back({"VoroCL", [&] {
                        vorocl::exact_cells(vorocl::Seeds(device, grid, set.points), result);
                        result.edges();
                        device.queue().finish();
                      }});
  programs.push_back({"CGAL's Delaunay triangulation", [&] {
                        CGAL::Delaunay_triangulation_2<Kernel> triangulation(points.begin(), points.end());
                      }});
  if (set.is_periodic || kind == "uniform" || kind == "lattice")
    programs.push_back({"Voro++", [&] { with_voro(set); }});  // a grid of blocks is not for the others
  programs.front().run();                                     // builds its kernels, and makes its buffers
  for (int i = 0; i < repeat; ++i) {
    for (Program& program : programs) {
      const double clock = clock_ms(), processor = processor_ms();
      program.run();
      program.clock.push_back(clock_ms() - clock);
      program.processor.push_back(processor_ms() - processor);
    }
  }
  std::printf("%zu points, %s, %d times: least and median by the clock, least processor time, in ms\n",
              set.points.size(), kind.c_str(), repeat);
  for (Program& program : programs) {
    std::sort(program.clock.begin(), program.clock.end());
    std::sort(program.processor.begin(), program.processor.end());
    std::printf("  %-32s %8.1f %8.1f %8.1f\n", program.name.c_str(), program.clock.front(),
                program.clock[program.clock.size() / 2], program.processor.front());
  }
}
