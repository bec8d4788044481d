#include "formats/id_order.hpp"

#include <array>
#include <numeric>

namespace vorocl::command {

void sort_by_id(std::vector<IdAndRow>& rows, std::vector<IdAndRow>& spare) {
  if (rows.empty()) return;
  // Digit after digit from the lowest one.
  constexpr int bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  spare.resize(rows.size());
  for (int shift = 32; shift < 64; shift += bits) {
    const auto digit_of = [shift](IdAndRow row) { return row >> shift & (digits - 1); };
    std::array<std::size_t, digits> begin = {};
    for (const IdAndRow row : rows) ++begin[digit_of(row)];
    if (begin[digit_of(rows[0])] == rows.size()) continue;  // all have this one
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), std::size_t{0});
    for (const IdAndRow row : rows) spare[begin[digit_of(row)]++] = row;
    rows.swap(spare);
  }
}

}  // namespace vorocl::command
