// Small diagrams whose labels are known, as `vorocl devices --check` makes them.
#include "trials/known_answers.hpp"

#include <nanobind/stl/vector.h>

#include "module.hpp"

namespace vorocl::python {

namespace {

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const command::KnownAnswer& answer : command::known_answers()) {
    result.push_back(command::to_string(answer));
  }
  return result;
}

bool is_right(const Device& device, std::size_t index) {
  const command::KnownAnswer& answer = command::known_answers().at(index);
  return command::hash_on(device, answer) == answer.hash;
}

}  // namespace

void bind_known_answers(nb::module_& module) {
  module.def("known_answers", names);
  module.def("is_known_answer_right", is_right, nb::arg("device"), nb::arg("index"), without_gil());
}

}  // namespace vorocl::python
