#include "vorocl/simulation.hpp"

#include <string>
#include <utility>
#include <vector>

#include "vorocl/error.hpp"

namespace vorocl {

Simulation::Simulation(Seeds seeds, Motion motion)
    : seeds_(std::move(seeds)), window_(seeds_.grid()), motion_(std::move(motion)) {
  if (!motion_) throw Error("a simulation needs a motion that moves the seeds");
}

Simulation::Simulation(Seeds seeds, const Window& window, Motion motion)
    : seeds_(std::move(seeds)), window_(window), motion_(std::move(motion)) {
  if (!motion_) throw Error("a simulation needs a motion that moves the seeds");
}

std::size_t Simulation::add_engine(Engine engine) {
  if (!engine) throw Error("a simulation needs engines that fill diagrams; this one is empty");
  if (frame_ >= 0) throw Error("an engine must be added before the first frame is made");
  tracks_.push_back({std::move(engine), Diagram(seeds_.device(), window_), {}, {}, 0, 0});
  return tracks_.size() - 1;
}

void Simulation::skip() {
  Window window = window_;
  if (frame_ >= 0) {
    const bool follows = window_ == Window(seeds_.grid());
    motion_(seeds_, window, frame_ + 1);
    // A window of the whole grid stays one when the grid changes.
    if (follows && window == window_) window = Window(seeds_.grid());
  }
  std::vector<Diagram> diagrams;  // all of them, before anything changes
  for (const Track& track : tracks_) {
    if (track.diagram.window() != window) diagrams.emplace_back(seeds_.device(), window);
  }
  for (Track& track : tracks_) {
    if (track.diagram.window() == window) continue;
    track.diagram = std::move(diagrams.back());
    diagrams.pop_back();
  }
  window_ = window;
  ++frame_;
}

void Simulation::step() {
  skip();
  for (Track& track : tracks_) {
    track.report = track.engine(seeds_, track.diagram);
    if (frame_ == 0) continue;  // every engine starts from nothing there: the paper does not count it
    track.untimed.push_back(track.report);
    track.host_milliseconds += track.report.host_milliseconds();
  }
}

double Simulation::milliseconds(std::size_t engine) {
  track(engine);  // throws if there is none
  Track& timed = tracks_[engine];
  for (const Report& report : timed.untimed) timed.milliseconds += report.milliseconds();
  timed.untimed.clear();
  return timed.milliseconds;
}

const Simulation::Track& Simulation::track(std::size_t engine) const {
  if (engine < tracks_.size()) return tracks_[engine];
  throw Error("the simulation has " + std::to_string(tracks_.size()) + " engines, and none of number " +
              std::to_string(engine));
}

}  // namespace vorocl
