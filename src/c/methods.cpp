// The C functions that fill diagrams.
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
  refuse("reach", reach);
}

/// The name of a variant of jump flooding.
const char* to_name(vorocl_variant variant) {
  if (variant == VOROCL_JFA) return "jfa";
  if (variant == VOROCL_JFA_PLUS_1) return "jfa+1";
  if (variant == VOROCL_JFA_PLUS_2) return "jfa+2";
  if (variant == VOROCL_ONE_PLUS_JFA) return "1+jfa";
  refuse("variant", variant);
}

MethodOptions to_options(const vorocl_method_options* options) {
  if (options == nullptr) return {};
  return {to_metric(options->metric), to_mix(options->neighbourhood), options->von_neumann_waves,
          options->extra_waves,       options->refresh_interval,      to_reach(options->reach)};
}

/// Runs a method and keeps its report; if it fails, there is none.
void run(const char* name, const vorocl_seeds* seeds, vorocl_diagram* diagram, double max_displacement,
         const MethodOptions& options) {
  vorocl_diagram& to = given(diagram, "diagram");
  to.report = {};
  to.report = method(name).run(of(seeds), to.diagram, max_displacement, options);
}

}  // namespace

vorocl_status vorocl_standard_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                       vorocl_metric metric, vorocl_neighbourhood neighbourhood) {
  return guarded([&] {
    run("standard-flooding", seeds, diagram, 0, {to_metric(metric), to_mix(neighbourhood)});
  });
}

vorocl_status vorocl_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram, vorocl_metric metric,
                                   vorocl_neighbourhood neighbourhood, vorocl_variant variant) {
  return guarded([&] {
    run(to_name(variant), seeds, diagram, 0, {to_metric(metric), to_mix(neighbourhood)});
  });
}

vorocl_status vorocl_exact_diagram(const vorocl_seeds* seeds, vorocl_diagram* diagram, vorocl_metric metric) {
  return guarded([&] { run("exact", seeds, diagram, 0, {to_metric(metric)}); });
}

vorocl_status vorocl_dynamic_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                           double max_displacement, const vorocl_method_options* options) {
  return guarded([&] { run("djfa", seeds, diagram, max_displacement, to_options(options)); });
}

// --- by name ---

vorocl_status vorocl_method_count(size_t* count) {
  return answer(count, "count", [&] { return methods().size(); });
}

vorocl_status vorocl_method_get(size_t index, vorocl_method_description* description) {
  return guarded([&] {
    const Method& from = at(methods(), index, "methods");
    given(description, "description") = {from.name.c_str(), from.exact ? 1 : 0, from.continues ? 1 : 0,
                                         from.outer_seeds ? 1 : 0};
  });
}

vorocl_status vorocl_run(const char* name, const vorocl_seeds* seeds, vorocl_diagram* diagram,
                         double max_displacement, const vorocl_method_options* options) {
  return guarded([&] { run(&given(name, "method"), seeds, diagram, max_displacement, to_options(options)); });
}

vorocl_status vorocl_prepare(const char* name, const vorocl_device* device, vorocl_grid grid, size_t seeds,
                             const vorocl_method_options* options) {
  return guarded([&] {
    prepare(method(&given(name, "method")), of(device), to_grid(grid), seeds, to_options(options));
  });
}
