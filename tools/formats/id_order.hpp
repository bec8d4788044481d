// Rows in the order of their ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorocl::command {

/// An id, and the number of its row from 0 in the lower half.
using IdAndRow = std::uint64_t;

inline IdAndRow id_and_row(std::uint32_t id, std::size_t row) { return IdAndRow{id} << 32 | row; }
inline std::uint32_t id_of(IdAndRow row) { return static_cast<std::uint32_t>(row >> 32); }
inline std::uint32_t row_of(IdAndRow row) { return static_cast<std::uint32_t>(row); }

/// By id; rows of one id stay in their order. `spare` is memory for the sorting. Takes 10 ns per row.
void sort_by_id(std::vector<IdAndRow>& rows, std::vector<IdAndRow>& spare);

}  // namespace vorocl::command
