#include "vorocl/standard_flooding.hpp"

#include "flooding/flood.hpp"

namespace vorocl {

namespace {
constexpr int waves_between_reads = 16;  // a read stalls the queue, a wave too many costs a wave
}

Report standard_flooding(const Seeds& seeds, Diagram& diagram, const StandardFloodingOptions& options) {
  Flood flood(seeds, diagram, options.metric, "standard-flooding");
  flood.clear_last_change();
  flood.first_wave(Flood::none);
  int waves = 0, changing_waves = 0;
  do {
    for (int i = 0; i < waves_between_reads; ++i) flood.reporting_wave(options.neighbourhood, ++waves);
    changing_waves = flood.last_change();
  } while (changing_waves == waves);
  flood.last_wave(Flood::none);
  return flood.commit(static_cast<std::size_t>(changing_waves));
}

}  // namespace vorocl
