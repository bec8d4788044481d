// The extension module vorocl._vorocl: a thin layer over the C++ classes. What users call is Python, in
// python/vorocl, which checks and converts arguments before they come here.
#include "module.hpp"

NB_MODULE(_vorocl, module) {
  using namespace vorocl::python;
  nb::set_leak_warnings(false);  // diagrams that are kept until the interpreter ends are no leak
  bind_errors(module);
  bind_devices(module);
  bind_seeds(module);
  bind_diagrams(module);
  bind_exact_cells(module);
  bind_masks(module);
}
