// The C functions of distance transforms of images.
#include "calls.hpp"
#include "vorocl/distance_transform.hpp"

using namespace vorocl;

struct vorocl_distance_transform {
  DistanceTransform transform;
};

namespace {

PixelType to_type(vorocl_pixel_type type) {
  if (type == VOROCL_PIXEL_UINT8) return PixelType::uint8;
  if (type == VOROCL_PIXEL_UINT16) return PixelType::uint16;
  if (type == VOROCL_PIXEL_UINT32) return PixelType::uint32;
  if (type == VOROCL_PIXEL_UINT64) return PixelType::uint64;
  if (type == VOROCL_PIXEL_FLOAT32) return PixelType::float32;
  if (type == VOROCL_PIXEL_FLOAT64) return PixelType::float64;
  refuse("pixel type", type);
}

Marked to_marked(vorocl_marked marked) {
  if (marked == VOROCL_MARKED_ZEROS) return Marked::zeros;
  if (marked == VOROCL_MARKED_NON_ZEROS) return Marked::non_zeros;
  refuse("choice of marked pixels", marked);
}

void require_one_place(const char* image, bool on_host, bool in_buffer) {
  if (on_host && in_buffer)
    throw Error(std::string(image) + " has both pixels and a buffer; leave one of them NULL");
}

ImageSource to_image(const vorocl_image_source& image) {
  require_one_place("the image", image.pixels != nullptr, image.buffer != nullptr);
  const PixelType type = to_type(image.type);
  if (image.buffer != nullptr) return {retained(image.buffer), type};
  return {&given(static_cast<const char*>(image.pixels), "image"), type};
}

ImageTarget to_image(const vorocl_image_target& image, const char* name) {
  require_one_place(name, image.pixels != nullptr, image.buffer != nullptr);
  if (image.buffer != nullptr) return {retained(image.buffer), to_type(image.type)};
  if (image.pixels != nullptr) return {image.pixels, to_type(image.type)};
  return {};
}

}  // namespace

vorocl_status vorocl_distance_transform_create(const vorocl_device* device, vorocl_grid grid,
                                               const double size[3], vorocl_distance_transform** transform) {
  return make_object(transform, "transform", [&] {
    const PixelSize lengths = size != nullptr ? PixelSize{size[0], size[1], size[2]} : PixelSize();
    return vorocl_distance_transform{DistanceTransform(of(device), to_grid(grid), lengths)};
  });
}

void vorocl_distance_transform_free(vorocl_distance_transform* transform) { delete transform; }

vorocl_status vorocl_distance_transform_run(vorocl_distance_transform* transform,
                                            const vorocl_image_source* image, vorocl_marked marked,
                                            double farthest, const vorocl_transform_targets* targets) {
  return guarded([&] {
    DistanceTransform& run_by = given(transform, "transform").transform;
    const vorocl_transform_targets& wanted = given(targets, "targets");
    run_by.run(to_image(given(image, "image")),
               {to_image(wanted.distances, "distances"), to_image(wanted.indices, "indices"),
                to_image(wanted.places, "places"), to_image(wanted.ranks, "ranks"),
                to_image(wanted.values, "values")},
               {to_marked(marked), farthest});
  });
}

vorocl_status vorocl_distance_transform_found(const vorocl_distance_transform* transform, int* found) {
  return answer(found, "found", [&] { return given(transform, "transform").transform.found() ? 1 : 0; });
}
