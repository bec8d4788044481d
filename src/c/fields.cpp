// The C functions of fields: one handle for values of all types.
#include <cstdint>
#include <variant>
#include <vector>

#include "calls.hpp"

using namespace vorocl;

struct vorocl_field {
  std::variant<Field<std::int32_t>, Field<float>, Field<std::uint8_t>, Field<std::uint32_t>> values;
  std::size_t pixels = 0;  // of the diagram; 0 while it is empty
};

namespace {

/// Fills the field with values of one type: `fill` takes the diagram and the typed field.
template <typename T, typename Fill>
vorocl_status fill_field(vorocl_field* field, const vorocl_diagram* diagram, Fill fill) {
  return guarded([&] {
    given(field, "field").pixels = 0;
    if (!std::holds_alternative<Field<T>>(field->values)) field->values.emplace<Field<T>>();
    const Diagram& from = of(diagram);
    fill(from, std::get<Field<T>>(field->values));
    field->pixels = from.window().pixels();
  });
}

}  // namespace

vorocl_status vorocl_field_create(vorocl_field** field) {
  return make_object(field, "field", [] { return vorocl_field{}; });
}

void vorocl_field_free(vorocl_field* field) { delete field; }

vorocl_status vorocl_field_int_distances(vorocl_field* field, const vorocl_diagram* diagram) {
  return fill_field<std::int32_t>(
      field, diagram, [](const Diagram& from, Field<std::int32_t>& to) { distance_field(from, to); });
}

vorocl_status vorocl_field_float_distances(vorocl_field* field, const vorocl_diagram* diagram) {
  return fill_field<float>(field, diagram,
                           [](const Diagram& from, Field<float>& to) { distance_field(from, to); });
}

vorocl_status vorocl_field_border_mask(vorocl_field* field, const vorocl_diagram* diagram) {
  return fill_field<std::uint8_t>(
      field, diagram, [](const Diagram& from, Field<std::uint8_t>& to) { border_mask(from, to); });
}

vorocl_status vorocl_field_map_labels(vorocl_field* field, const vorocl_diagram* diagram,
                                      const uint32_t* table, size_t count) {
  return fill_field<std::uint32_t>(field, diagram, [&](const Diagram& from, Field<std::uint32_t>& to) {
    if (count > 0) given(table, "table");
    map_labels(from, std::vector<std::uint32_t>(table, table + count), to);
  });
}

vorocl_status vorocl_field_map_labels_by_buffer(vorocl_field* field, const vorocl_diagram* diagram,
                                                cl_mem table) {
  return fill_field<std::uint32_t>(field, diagram, [&](const Diagram& from, Field<std::uint32_t>& to) {
    given(table, "table");
    map_labels(from, retained(table), to);
  });
}

vorocl_status vorocl_field_expand_labels(vorocl_field* field, const vorocl_diagram* diagram,
                                         double distance) {
  return fill_field<std::uint32_t>(field, diagram, [&](const Diagram& from, Field<std::uint32_t>& to) {
    expand_labels(from, distance, to);
  });
}

vorocl_status vorocl_field_buffer(const vorocl_field* field, cl_mem* values) {
  return answer(values, "values", [&] {
    const vorocl_field& from = given(field, "field");
    if (from.pixels == 0) return cl_mem{nullptr};
    return std::visit([](const auto& typed) { return typed.values()(); }, from.values);
  });
}

vorocl_status vorocl_field_read(const vorocl_field* field, void* values, size_t bytes) {
  return guarded([&] {
    const vorocl_field& from = given(field, "field");
    std::visit(
        [&](const auto& typed) {
          using Value = typename decltype(typed.read())::value_type;
          check_count(from.pixels * sizeof(Value), "bytes", bytes);
          if (bytes == 0) return;
          if (values == nullptr) throw NullArgument{"values"};
          typed.read(static_cast<Value*>(values));
        },
        from.values);
  });
}
