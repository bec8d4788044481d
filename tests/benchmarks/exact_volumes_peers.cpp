// Times exact cells of volumes beside Voro++'s, in turn in one run: the least and the median of the times by
// the clock, and the least processor time, which other work on the machine changes less. And compares their
// volumes and neighbours.
//
//   c++ -std=c++17 -O3 -march=native exact_volumes_peers.cpp $(pkg-config --cflags --libs vorocl) -lvoro++ -o
//   peers
//   ./peers uniform|periodic|lattice|noise|clusters COUNT [REPEAT]
//   ./peers melt COPIES [REPEAT] FRAME.csv    (of x,y,z in a periodic box of the side 10, so often along each
//   axis)
//
// VoroCL begins with points in the host's memory, and ends when the measures of cells and faces are read.
// Voro++ computes the same of each cell.
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

struct Set {
  double side = 1;
  bool is_periodic = true;
  std::vector<Point> points;
};

Set random_set(std::size_t count, bool is_periodic) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anywhere(0, 1);
  Set set = {1, is_periodic, {}};
  for (std::size_t i = 0; i < count; ++i)
    set.points.push_back({anywhere(random), anywhere(random), anywhere(random)});
  return set;
}

/// A cubic lattice, of which points lie so far from their places, as a share of the lattice's step.
Set lattice(std::size_t count, double noise) {
  const auto side = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(count))));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.5, noise);
  const auto at = [&](std::size_t place) {
    return static_cast<double>(place) + (noise > 0 ? normal(random) : 0.5);
  };
  Set set = {static_cast<double>(side), true, {}};
  for (std::size_t i = 0; i < side * side * side; ++i)
    set.points.push_back({at(i % side), at(i / side % side), at(i / side / side)});
  return set;
}

Set clusters(std::size_t count) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Set set = {1, false, {}};
  while (set.points.size() < count) {
    const double spread = std::pow(10, -1.5 - static_cast<double>(set.points.size() % 6) / 2);
    const auto middle = [&](std::size_t k) {
      return 0.2 + 0.6 * std::fmod(0.618 * static_cast<double>(k), 1);
    };
    const std::size_t k = set.points.size() % 50;
    const Point at = {middle(k) + spread * normal(random), middle(7 * k + 1) + spread * normal(random),
                      middle(31 * k + 2) + spread * normal(random)};
    if (std::min({at.x, at.y, at.z}) >= 0 && std::max({at.x, at.y, at.z}) < 1) set.points.push_back(at);
  }
  return set;
}

Set melt(std::size_t copies, const char* path) {
  std::ifstream file(path);
  Set set = {10 * static_cast<double>(copies), true, {}};
  std::string line;
  for (Point at; std::getline(file, line);) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &at.x, &at.y, &at.z) != 3) continue;
    for (std::size_t i = 0; i < copies * copies * copies; ++i) {
      const auto moved = [](double x, std::size_t by) { return x + 10 * static_cast<double>(by); };
      set.points.push_back(
          {moved(at.x, i % copies), moved(at.y, i / copies % copies), moved(at.z, i / copies / copies)});
    }
  }
  return set;
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

struct Cells {
  std::vector<double> volumes;
  std::vector<std::size_t> neighbours;
};

struct Program {
  std::string name;
  std::function<Cells()> run;
  std::vector<double> clock = {}, processor = {};
  Cells found = {};
};

Cells with_voro(const Set& set) {
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(set.points.size()) / 5)));
  voro::container container(0, set.side, 0, set.side, 0, set.side, blocks, blocks, blocks, set.is_periodic,
                            set.is_periodic, set.is_periodic, 8);
  for (std::size_t i = 0; i < set.points.size(); ++i)
    container.put(static_cast<int>(i), set.points[i].x, set.points[i].y, set.points[i].z);
  Cells found = {std::vector<double>(set.points.size()), std::vector<std::size_t>(set.points.size())};
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbours;
  std::vector<double> areas;
  double x = 0, y = 0, z = 0, surface = 0;
  if (!loop.start()) return found;
  do {
    if (!container.compute_cell(cell, loop)) continue;
    const auto id = static_cast<std::size_t>(loop.pid());
    found.volumes[id] = cell.volume();
    cell.centroid(x, y, z);
    surface += cell.surface_area();
    cell.neighbors(neighbours);
    cell.face_areas(areas);
    found.neighbours[id] = static_cast<std::size_t>(
        std::count_if(neighbours.begin(), neighbours.end(), [](int neighbour) { return neighbour >= 0; }));
  } while (loop.inc());
  return found;
}

}  // namespace

int main(int count_of_arguments, char** arguments) {
  if (count_of_arguments < 3) return std::puts("see the head of the source"), 2;
  const std::string kind = arguments[1];
  const std::size_t count = std::strtoull(arguments[2], nullptr, 10);
  const int repeat = count_of_arguments > 3 ? std::atoi(arguments[3]) : 7;
  Set set;
  if (kind == "uniform" || kind == "periodic") set = random_set(count, kind == "periodic");
  if (kind == "lattice" || kind == "noise") set = lattice(count, kind == "noise" ? 0.02 : 0);
  if (kind == "clusters") set = clusters(count);
  if (kind == "melt" && count_of_arguments > 4) set = melt(count, arguments[4]);
  if (set.points.empty()) return std::puts("no such set, or no melt"), 2;

  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Axis along(2, 0, set.side), axis = set.is_periodic ? along.periodic() : along.closed();
  const vorocl::Grid grid(axis, axis, axis);
  vorocl::ExactCellsResult result;
  std::vector<Program> programs;
  programs.push_back({"VoroCL", [&] {
                        vorocl::exact_cells(vorocl::Seeds(device, grid, set.points), result);
                        Cells found;
                        for (const vorocl::ExactCell& cell : result.read()) {
                          found.volumes.push_back(cell.area);
                          found.neighbours.push_back(cell.neighbours);
                        }
                        std::vector<std::uint32_t> neighbours(result.edges());
                        std::vector<double> areas(result.edges());
                        device.queue().enqueueReadBuffer(result.edge_neighbours(), CL_TRUE, 0,
                                                         4 * neighbours.size(), neighbours.data());
                        device.queue().enqueueReadBuffer(result.lengths(), CL_TRUE, 0, 8 * areas.size(),
                                                         areas.data());
                        return found;
                      }});
  programs.push_back({"Voro++", [&] { return with_voro(set); }});
  programs.front().run();  // builds its kernels, and makes its buffers
  for (int i = 0; i < repeat; ++i) {
    for (Program& program : programs) {
      const double clock = clock_ms(), processor = processor_ms();
      program.found = program.run();
      program.clock.push_back(clock_ms() - clock);
      program.processor.push_back(processor_ms() - processor);
    }
  }
  std::printf("%zu points, %s, %d times: least and median by the clock, least processor time, in ms\n",
              set.points.size(), kind.c_str(), repeat);
  for (Program& program : programs) {
    std::sort(program.clock.begin(), program.clock.end());
    std::sort(program.processor.begin(), program.processor.end());
    double volume = 0;
    for (const double of_cell : program.found.volumes) volume += of_cell;
    std::printf("  %-8s %9.1f %9.1f %9.1f, volumes sum to 1 %+.1e\n", program.name.c_str(),
                program.clock.front(), program.clock[program.clock.size() / 2], program.processor.front(),
                volume / std::pow(set.side, 3) - 1);
  }
  std::size_t different = 0;
  double worst = 0;
  const Cells &ours = programs[0].found, &theirs = programs[1].found;
  for (std::size_t id = 0; id < set.points.size(); ++id) {
    different += ours.neighbours[id] != theirs.neighbours[id] ? 1 : 0;
    worst = std::max(worst, std::abs(ours.volumes[id] / theirs.volumes[id] - 1));
  }
  std::printf(
      "  cells with another number of neighbours: %zu; volumes differ by at most %.1e of themselves\n",
      different, worst);
}
