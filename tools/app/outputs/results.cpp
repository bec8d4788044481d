#include "app/outputs/results.hpp"

#include "app/sources/bounds.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

Json::Members json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view) {
  return {{"method", method.name},
          {"metric", to_string(metric)},
          {"device", seeds.device().name()},
          {"width", view.picture.grid.width()},
          {"height", view.picture.grid.height()},
          {"periodic", to_string(seeds.periodic())},
          {"area_unit", view.units.of_area()},
          {"length_unit", view.units.of_length()}};
}

}  // namespace vorocl::command
