#include "core/placement.hpp"

#include <utility>

#include "runtime/buffer.hpp"

namespace vorocl {

bool kernels_go_round(const Window& window, const PixelGrid& shown) {
  constexpr int most = 32000;  // margins of the exact engine's index must fit beside a period
  return window.is_whole() && !window.grid().is_tilted() && shown.periodic() == window.grid().periodic() &&
         (!shown.periodic_x() || shown.width() <= most) && (!shown.periodic_y() || shown.height() <= most);
}

std::shared_ptr<const Placement> place_in_window(const Device& device, const Window& window,
                                                 const PixelGrid& shown,
                                                 const std::vector<PlanePosition>& pixels) {
  std::vector<PlanePosition> seen;  // from the window's first pixel
  std::vector<std::uint32_t> packed;
  seen.reserve(pixels.size() + 1);  // one more is added when they are uploaded
  packed.reserve(pixels.size() + 1);
  bool all_inside = true;
  for (const PlanePosition& at : pixels) {
    if (is_absent(at)) {
      seen.push_back(at);
      packed.push_back(absent_position);
      continue;
    }
    const PlanePosition here = {
        {static_cast<cl_int>(at.s[0] - window.x()), static_cast<cl_int>(at.s[1] - window.y())}};
    const bool inside = is_inside(shown, here);
    seen.push_back(here);
    packed.push_back(inside ? pack(here.s[0], here.s[1]) : absent_position);
    all_inside = all_inside && inside;
  }
  packed.push_back(absent_position);
  auto positions = std::make_shared<const cl::Buffer>(allocate_with(device, packed, "the seeds"));
  if (all_inside && kernels_go_round(window, shown)) {
    return std::make_shared<const Placement>(Placement{shown, std::move(positions), nullptr});
  }
  if (window.grid().is_tilted()) {  // the images are places of points
    return std::make_shared<const Placement>(
        Placement{shown.without_periods(), std::move(positions), nullptr});
  }
  return std::make_shared<const Placement>(
      Placement{shown.without_periods(), std::move(positions),
                gather_outer_seeds(device, window, shown.without_periods(), std::move(seen))});
}

}  // namespace vorocl
