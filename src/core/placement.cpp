#include "core/placement.hpp"

#include <utility>

#include "runtime/buffer.hpp"

namespace vorocl {

bool are_crowded(const PixelGrid& volume, const std::vector<std::uint32_t>& voxels) {
  // By bins of 8 x 8 x 8 voxels. Measured: with fewer crowded bins, and where nearly all bins have seeds,
  // labelling by candidates takes a shorter time.
  constexpr int bin_bits = 3;
  constexpr std::uint8_t crowded_from = 16;
  constexpr std::size_t bins_per_crowded_one = 48, fewest_bins = 512;
  const VoxelBits bits(volume);
  const auto bins_along = [](int side) { return (static_cast<std::size_t>(side - 1) >> bin_bits) + 1; };
  const std::size_t across = bins_along(volume.width()), down = bins_along(volume.height());
  const std::size_t bins = across * down * bins_along(volume.depth());
  if (bins < fewest_bins || voxels.size() < bins / bins_per_crowded_one * crowded_from) return false;
  std::vector<std::uint8_t> seeds(bins);
  std::size_t crowded = 0, occupied = 0;
  for (const std::uint32_t voxel : voxels) {
    if (voxel == absent_voxel) continue;
    const auto [x, y, z] = bits.unpack(voxel);
    const auto bin = [](int at) { return static_cast<std::size_t>(at) >> bin_bits; };
    std::uint8_t& of_bin = seeds[(bin(z) * down + bin(y)) * across + bin(x)];
    if (of_bin == crowded_from) continue;
    occupied += of_bin == 0 ? 1 : 0;
    ++of_bin;
    crowded += of_bin == crowded_from ? 1 : 0;
  }
  return crowded > bins / bins_per_crowded_one && occupied < bins / 8 * 7;
}

bool kernels_go_round(const Window& window, const PixelGrid& shown) {
  constexpr int most = 32000;  // ways across the ends of periods must fit in 16 bits
  return window.is_whole() && !window.grid().is_tilted() && shown.periodic() == window.periodic() &&
         (!shown.periodic_x() || shown.width() <= most) && (!shown.periodic_y() || shown.height() <= most);
}

PackedPositions::PackedPositions(const PixelGrid& grid) : bits{{16, 15}}, empty(absent_position) {
  if (!grid.is_volume()) return;
  const VoxelBits of_voxels(grid);
  bits = {{of_voxels.x, of_voxels.y}};
  empty = absent_voxel;
}

std::shared_ptr<const Placement> place_in_window(const Device& device, const Window& window,
                                                 const PixelGrid& shown, const std::vector<Place>& places) {
  std::vector<std::uint32_t> packed;
  packed.reserve(places.size() + 1);  // one more is added when they are uploaded
  std::size_t outside = 0;
  for (const Place& place : places) {
    if (is_absent(place)) {
      packed.push_back(absent_position);
      continue;
    }
    const std::int64_t x = pixel_of(place.x) - window.x(), y = pixel_of(place.y) - window.y();
    const bool inside = x >= 0 && x < shown.width() && y >= 0 && y < shown.height();
    packed.push_back(inside ? pack(static_cast<int>(x), static_cast<int>(y)) : absent_position);
    outside += inside ? 0 : 1;
  }
  if (outside > 0 || !kernels_go_round(window, shown)) {
    return std::make_shared<const Placement>(
        Placement{shown.without_periods(), nullptr, nullptr, false, true, outside});
  }
  packed.push_back(absent_position);
  return std::make_shared<const Placement>(Placement{
      shown, std::make_shared<const cl::Buffer>(allocate_with(device, packed, "the seeds")), nullptr});
}

}  // namespace vorocl
