#include "formats/numbers.hpp"

#include <cstdint>
#include <cstring>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

namespace vorocl::command {

namespace {

template <typename T>
NumberType type_of() {
  return {sizeof(T), [](const char* bytes, std::size_t count, double* numbers) {
            for (std::size_t i = 0; i < count; ++i) {
              T value;
              std::memcpy(&value, bytes + i * sizeof value, sizeof value);
              numbers[i] = static_cast<double>(value);
            }
          }};
}

}  // namespace

const NumberType* number_type(char kind, std::size_t size) {
  static const std::map<std::pair<char, std::size_t>, NumberType> all = {
      {{'b', 1}, type_of<std::uint8_t>()},  {{'u', 1}, type_of<std::uint8_t>()},
      {{'u', 2}, type_of<std::uint16_t>()}, {{'u', 4}, type_of<std::uint32_t>()},
      {{'u', 8}, type_of<std::uint64_t>()}, {{'i', 1}, type_of<std::int8_t>()},
      {{'i', 2}, type_of<std::int16_t>()},  {{'i', 4}, type_of<std::int32_t>()},
      {{'i', 8}, type_of<std::int64_t>()},  {{'f', 2}, type_of<cv::float16_t>()},
      {{'f', 4}, type_of<float>()},         {{'f', 8}, type_of<double>()}};
  const auto found = all.find({kind, size});
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace vorocl::command
