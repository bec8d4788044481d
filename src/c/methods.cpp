// The C functions that fill diagrams.
#include <algorithm>
#include <optional>

#include "calls.hpp"

using namespace vorocl;

namespace {

/// None: each method has its own.
std::optional<NeighbourhoodMix> to_mix(vorocl_neighbourhood neighbourhood) {
  if (neighbourhood == VOROCL_MOORE) return NeighbourhoodMix::moore;
  if (neighbourhood == VOROCL_VON_NEUMANN) return NeighbourhoodMix::von_neumann;
  if (neighbourhood == VOROCL_MIXED) return NeighbourhoodMix::mixed;
  if (neighbourhood == VOROCL_DEFAULT_NEIGHBOURHOOD) return std::nullopt;
  refuse("neighbourhood", neighbourhood);
}

Reach to_reach(vorocl_reach reach) {
  if (reach == VOROCL_REACH_MEASURED) return Reach::measured;
  if (reach == VOROCL_REACH_PAPER) return Reach::paper;
  if (reach == VOROCL_REACH_AUTHORS) return Reach::authors;
  refuse("reach", reach);
}

std::optional<double> to_displacement(double displacement) {
  if (displacement == VOROCL_DISPLACEMENT_OF_SEEDS) return std::nullopt;
  return displacement;
}

}  // namespace

MethodOptions vorocl::to_options(const vorocl_method_options* options) {
  if (options == nullptr) return {};
  return {to_metric(options->metric),
          to_mix(options->neighbourhood),
          options->von_neumann_waves,
          options->extra_waves,
          options->refresh_interval,
          to_reach(options->reach),
          to_displacement(options->max_displacement)};
}

vorocl_status vorocl_method_count(size_t* count) {
  return answer(count, "count", [&] { return methods().size(); });
}

vorocl_status vorocl_method_get(size_t index, vorocl_method_description* description) {
  return guarded([&] {
    const Method& from = at(methods(), index, "methods");
    given(description, "description") = {from.name.c_str(), from.exact ? 1 : 0, from.continues ? 1 : 0,
                                         from.windows ? 1 : 0, from.volumes ? 1 : 0};
  });
}

vorocl_status vorocl_run(const char* name, const vorocl_seeds* seeds, vorocl_diagram* diagram,
                         const vorocl_method_options* options) {
  return guarded([&] {
    const char* const wanted = &given(name, "method");
    const Seeds& from = of(seeds);
    vorocl_diagram& to = given(diagram, "diagram");
    to.report = {};
    to.report = method(wanted).run(from, to.diagram, to_options(options));
  });
}

vorocl_status vorocl_prepare(const char* name, const vorocl_device* device, vorocl_window window,
                             size_t seeds, vorocl_snap snap, const vorocl_method_options* options) {
  return guarded([&] {
    prepare(method(&given(name, "method")), of(device), to_window(window), seeds, to_options(options),
            to_snap(snap));
  });
}

namespace {

vorocl_status relax_seeds(vorocl_seeds* seeds, vorocl_diagram* diagram, const char* name,
                          const vorocl_method_options* options, int rounds, const float* density,
                          bool is_exact, double* energies, size_t* moved, vorocl_relaxation* relaxation) {
  return guarded([&] {
    const Method& wanted = method(&given(name, "method"));
    vorocl_diagram& to = given(diagram, "diagram");
    const auto run = [&, its_options = to_options(options)](const Seeds& from, Diagram& filled) {
      to.report = {};
      to.report = wanted.run(from, filled, its_options);
      return to.report;
    };
    RelaxOptions how;
    how.exact = is_exact;
    if (density != nullptr) how.density.assign(density, density + to.diagram.window().pixels());
    const Relaxation done = relax(of(seeds), to.diagram, run, rounds, {}, how);
    if (energies != nullptr) std::copy(done.energies.begin(), done.energies.end(), energies);
    if (moved != nullptr) std::copy(done.moved.begin(), done.moved.end(), moved);
    store(relaxation, vorocl_relaxation{done.rounds(), done.converged ? 1 : 0});
  });
}

}  // namespace

vorocl_status vorocl_relax(vorocl_seeds* seeds, vorocl_diagram* diagram, const char* name,
                           const vorocl_method_options* options, int rounds, const float* density,
                           double* energies, size_t* moved, vorocl_relaxation* relaxation) {
  return relax_seeds(seeds, diagram, name, options, rounds, density, false, energies, moved, relaxation);
}

vorocl_status vorocl_relax_exact(vorocl_seeds* seeds, vorocl_diagram* diagram, const char* name,
                                 const vorocl_method_options* options, int rounds, double* energies,
                                 size_t* moved, vorocl_relaxation* relaxation) {
  return relax_seeds(seeds, diagram, name, options, rounds, nullptr, true, energies, moved, relaxation);
}
