// What a function makes of each element of a range.
#pragma once

#include <iterator>
#include <type_traits>
#include <vector>

namespace vorocl {

template <typename Range, typename Function>
auto transformed(const Range& range, Function function) {
  std::vector<std::decay_t<decltype(function(*std::begin(range)))>> results;
  results.reserve(std::size(range));
  for (const auto& element : range) results.push_back(function(element));
  return results;
}

}  // namespace vorocl
