// The C functions that fill diagrams.
#include "c_api.hpp"

using namespace vorocl;

namespace {

Metric to_metric(vorocl_metric metric) {
  if (metric == VOROCL_EUCLIDEAN) return Metric::euclidean;
  if (metric == VOROCL_MANHATTAN) return Metric::manhattan;
  refuse("metric", metric);
}

Neighbourhood to_neighbourhood(vorocl_neighbourhood neighbourhood) {
  if (neighbourhood == VOROCL_MOORE) return Neighbourhood::moore;
  if (neighbourhood == VOROCL_VON_NEUMANN) return Neighbourhood::von_neumann;
  if (neighbourhood == VOROCL_MIXED) throw Error("only dynamic jump flooding has a mixed neighbourhood");
  refuse("neighbourhood", neighbourhood);
}

NeighbourhoodMix to_mix(vorocl_neighbourhood neighbourhood) {
  if (neighbourhood == VOROCL_MIXED) return NeighbourhoodMix::mixed;
  return to_neighbourhood(neighbourhood) == Neighbourhood::moore ? NeighbourhoodMix::moore
                                                                 : NeighbourhoodMix::von_neumann;
}

JumpFloodingVariant to_variant(vorocl_variant variant) {
  if (variant == VOROCL_JFA) return JumpFloodingVariant::jfa;
  if (variant == VOROCL_JFA_PLUS_1) return JumpFloodingVariant::jfa_plus_1;
  if (variant == VOROCL_JFA_PLUS_2) return JumpFloodingVariant::jfa_plus_2;
  if (variant == VOROCL_ONE_PLUS_JFA) return JumpFloodingVariant::one_plus_jfa;
  refuse("variant", variant);
}

}  // namespace

vorocl_status vorocl_standard_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                       vorocl_metric metric, vorocl_neighbourhood neighbourhood) {
  return guarded([&] {
    vorocl_diagram& to = given(diagram, "diagram");
    to.report =
        standard_flooding(of(seeds), to.diagram, {to_metric(metric), to_neighbourhood(neighbourhood)});
  });
}

vorocl_status vorocl_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram, vorocl_metric metric,
                                   vorocl_neighbourhood neighbourhood, vorocl_variant variant) {
  return guarded([&] {
    vorocl_diagram& to = given(diagram, "diagram");
    to.report = jump_flooding(of(seeds), to.diagram,
                              {to_metric(metric), to_neighbourhood(neighbourhood), to_variant(variant)});
  });
}

vorocl_status vorocl_dynamic_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                           const vorocl_dynamic_jump_flooding_options* options) {
  return guarded([&] {
    vorocl_diagram& to = given(diagram, "diagram");
    const auto& from = given(options, "options");
    const DynamicPlanOptions plan = {to_mix(from.neighbourhood), from.von_neumann_waves, from.extra_waves};
    to.report = dynamic_jump_flooding(of(seeds), to.diagram, from.max_step,
                                      {to_metric(from.metric), plan, from.refresh_interval});
  });
}

vorocl_status vorocl_exact_diagram(const vorocl_seeds* seeds, vorocl_diagram* diagram, vorocl_metric metric) {
  return guarded([&] {
    vorocl_diagram& to = given(diagram, "diagram");
    ExactOptions options;
    options.metric = to_metric(metric);
    to.report = exact_diagram(of(seeds), to.diagram, options);
  });
}
