// Runs every kernel on small grids, for checkers that watch memory and races (tools/check_kernels.sh). Prints
// nothing.
#include "brute_force.hpp"
#include "exact/lists.hpp"
#include "vorocl/vorocl.hpp"

using namespace vorocl;

namespace {

void run_all(const Device& device, const Grid& grid, Metric metric) {
  const Seeds seeds(device, grid, centres(random_pixels(grid, 9, 1)));
  Diagram diagram(device, grid), other(device, grid);
  for (const Neighbourhood neighbourhood : {Neighbourhood::moore, Neighbourhood::von_neumann}) {
    jump_flooding(seeds, diagram, {metric, neighbourhood, JumpFloodingVariant::jfa});
    standard_flooding(seeds, other, {metric, neighbourhood});
  }
  similarity(diagram, other);
  for (const ListLength length : {ListLength::full, ListLength::two_entries}) {
    exact_diagram_with_lists(seeds, diagram, {metric}, length);
  }
  distance_errors(seeds, other, diagram, metric);
  Seeds::random(device, grid, 5, 1).read();
  const std::vector<cl_float2> points = {{{1, 2}}, {{2, 4}}};
  const cl::Buffer buffer(device.queue(), points.begin(), points.end(), true);
  Seeds(device, grid, buffer, points.size()).check();
}

void move_all(const Device& device, const Grid& grid, Metric metric) {
  Seeds seeds(device, grid, centres(random_pixels(grid, 9, 3)));
  Diagram diagram(device, grid);
  dynamic_jump_flooding(seeds, diagram, 0, {metric});
  random_step(seeds, 2, Border::reflect, 1, 1);
  dynamic_jump_flooding(seeds, diagram, 2, {metric});
  seeds.move_to({Point{1, 1}, std::nullopt, Point{2, 2}});
  dynamic_jump_flooding(seeds, diagram, 40, {metric});
  diagram.wait();
}

void measure_all(const Device& device, const Grid& grid, Metric metric) {
  Seeds seeds(device, grid, centres(random_pixels(grid, 9, 2)));
  Diagram diagram(device, grid);
  const auto engine = [&](const Seeds& moved, Diagram& filled, double) {
    return jump_flooding(moved, filled, {metric});
  };
  relax(seeds, diagram, engine, 1);
  cell_statistics(seeds, diagram);
  CellShapesResult shapes;
  cell_shapes(seeds, diagram, shapes, metric);
  AdjacencyResult pairs;
  adjacency(seeds, diagram, pairs);
  count_vertices(diagram);
  Field<std::int32_t> integers;
  Field<float> floats;
  Field<std::uint8_t> mask;
  distance_field(seeds, diagram, integers, metric);
  distance_field(seeds, diagram, floats, metric);
  border_mask(diagram, mask);
  device.finish();
}

}  // namespace

int main() {
  const Device device = Device::select();
  for (const int vector_width : {1, 4}) {
    const Device shaped = device.with_tuning({vector_width, 4, 2});
    for (const Metric metric : {Metric::euclidean, Metric::manhattan}) {
      run_all(shaped, Grid(13, 9), metric);
      run_all(shaped, Grid(3, 11), metric);
      move_all(shaped, Grid(13, 9), metric);
      measure_all(shaped, Grid(40, 19), metric);
      measure_all(shaped, Grid(3, 11), metric);
    }
  }
}
