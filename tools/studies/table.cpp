#include "studies/table.hpp"

#include <fmt/format.h>

#include <ctime>

#include "vorocl/version.hpp"

namespace vorocl::command {

Origin origin_of(const Device& device, const EvaluationSettings& settings) {
  return {{"version", VOROCL_VERSION},
          {"platform", device.platform_name()},
          {"device", device.name()},
          {"driver", device.driver_version()},
          {"rng_seed", std::to_string(settings.rng_seed)},
          {"step_length", std::to_string(settings.step_length)},
          {"frames", std::to_string(settings.frames)},
          {"timed_frames", std::to_string(settings.timed_frames)},
          {"repeats", std::to_string(settings.repeats)}};
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char text[sizeof "2026-01-31T12:00:00Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::string text(double value) { return fmt::format("{}", value); }

}  // namespace vorocl::command
