#include "formats/images/modules.hpp"

#include "formats/load_module.hpp"

namespace vorocl::command {

namespace {

const char* const advice = "install vorocl again, with the folder vorocl of its libraries, and OpenCV";

}  // namespace

const ImageModule& image_module() {
  static const auto& module = *static_cast<const ImageModule*>(load_module("vorocl_images.so", advice));
  return module;
}

const FilmModule& film_module() {
  static const auto& module = *static_cast<const FilmModule*>(load_module("vorocl_films.so", advice));
  return module;
}

}  // namespace vorocl::command
