#include "vorocl/standard_flooding.hpp"

#include "buffer.hpp"
#include "flood.hpp"

namespace vorocl {

namespace {
constexpr int waves_between_reads = 16;  // a read stalls the queue, a wave too many costs a wave
}

Report standard_flooding(const Seeds& seeds, Diagram& diagram, const StandardFloodingOptions& options) {
  Flood flood(seeds, diagram, options.metric);
  const Device& device = diagram.device();
  const cl::Buffer& last_change = diagram.scratch(Diagram::Scratch::flags, sizeof(cl_int));
  fill(device, last_change, cl_int{0}, 1);

  const Wave none = {flood.no_step(), Neighbourhood::von_neumann};
  flood.first_wave(none);
  int waves = 0, changing_waves = 0;
  do {
    for (int i = 0; i < waves_between_reads; ++i) {
      flood.reporting_wave(options.neighbourhood, ++waves, last_change);
    }
    changing_waves = download<cl_int>(device, last_change, 1).front();
  } while (changing_waves == waves);
  flood.last_wave(none);
  return flood.report(changing_waves);
}

}  // namespace vorocl
