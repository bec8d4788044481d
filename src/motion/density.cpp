#include "motion/density.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr double greatest_weight = 65535;
constexpr std::size_t sums_of_cell = 4;

void check_density(const Window& window, const std::vector<float>& density) {
  const PixelGrid pixels(window);
  if (density.size() != pixels.pixels()) {
    throw Error("a density of " + std::to_string(density.size()) + " values; the diagram has " +
                size_text(pixels.without_periods()) + " pixels, and each needs one");
  }
  for (std::size_t i = 0; i < density.size(); ++i) {
    // Written so that a NaN fails.
    if (density[i] >= 0 && std::isfinite(density[i])) continue;
    const auto width = static_cast<std::size_t>(pixels.width()), row = i / width;
    const auto height = static_cast<std::size_t>(pixels.height());
    throw Error("the density of pixel (" + std::to_string(i % width) + ", " + std::to_string(row % height) +
                (pixels.is_volume() ? ", " + std::to_string(row / height) : "") + ") is " +
                std::to_string(density[i]) + "; it must be a finite number of at least 0");
  }
}

}  // namespace

Density::Density(const Device& device, const Window& window, const std::vector<float>& density)
    : device_(device) {
  check_density(window, density);
  const double greatest = *std::max_element(density.begin(), density.end());
  if (greatest == 0) throw Error("the density is 0 everywhere; some pixel must weigh something");
  std::vector<std::uint16_t> weights;
  weights.reserve(density.size());
  for (const double of_pixel : density) {
    weights.push_back(static_cast<std::uint16_t>(std::lround(greatest_weight * of_pixel / greatest)));
  }
  unit_ = greatest / greatest_weight;
  pixels_ = allocate_with(device, weights, "the weights of pixels");
}

double Density::weigh(const Diagram& diagram) {
  const MeasuredDiagram of = cells_of(diagram);
  const cl_uint count = of.count();
  const std::size_t sums = sums_of_cell * count;
  for (cl::Buffer* const zeros : {&at_home_, &elsewhere_}) {
    make_room(*zeros, of.device, sums * sizeof(cl_ulong));
    if (count > 0) fill(of.device, *zeros, cl_ulong{0}, sums);
  }
  for (cl::Buffer* const joined : {&weight_, &sum_x_, &sum_y_, &sum_z_}) {
    make_room(*joined, of.device, count * sizeof(cl_ulong));
  }
  const Blocks blocks(of.device, of.grid);
  make_room(energies_, of.device, blocks.count() * sizeof(cl_ulong));
  const char* const file = "motion/density.cl";
  const KernelOptions options = of.options_without_metric();
  blocks.run(kernels_, file, "add_weights", options, diagram.labels(), of.positions(), count, of.periods(),
             of.size(), blocks.bits(), pixels_, at_home_, elsewhere_, energies_);
  kernels_.get(of.device, file, "join_weights", of.grid, options)
      .over_items(count, of.positions(), count, of.periods(), of.size(), at_home_, elsewhere_, weight_,
                  sum_x_, sum_y_, sum_z_);
  diagram.wait();
  // In two parts, for the sum of all blocks may need more than 64 bits.
  std::uint64_t high = 0, low = 0;
  for (const cl_ulong energy : download<cl_ulong>(of.device, energies_, blocks.count())) {
    high += energy >> 32;
    low += energy & 0xffffffffu;
  }
  return unit_ * (std::ldexp(static_cast<double>(high), 32) + static_cast<double>(low));
}

std::vector<CellWeight> Density::read(std::size_t cells) const {
  const auto weight = download<cl_ulong>(device_, weight_, cells);
  const auto sum_x = download<cl_long>(device_, sum_x_, cells);
  const auto sum_y = download<cl_long>(device_, sum_y_, cells);
  const auto sum_z = download<cl_long>(device_, sum_z_, cells);
  std::vector<CellWeight> read;
  read.reserve(cells);
  for (std::size_t id = 0; id < cells; ++id) read.push_back({weight[id], sum_x[id], sum_y[id], sum_z[id]});
  return read;
}

}  // namespace vorocl
