// The rows of tables, made by threads.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/output_file.hpp"
#include "formats/workers.hpp"

namespace vorocl::command {

/// Adds a number as "{}" writes it. Most numbers of tables are whole, for which there is a shorter way.
inline void add_number(fmt::memory_buffer& text, double value) {
  constexpr double most = 1e15;  // of those that "{}" writes without an exponent
  const bool is_whole = std::fabs(value) < most && value == std::trunc(value);
  if (is_whole && !(value == 0 && std::signbit(value))) {
    const fmt::format_int digits(static_cast<std::int64_t>(value));
    text.append(digits.data(), digits.data() + digits.size());
  } else {
    fmt::format_to(fmt::appender(text), FMT_COMPILE("{}"), value);
  }
}

/// Adds the rows of items that `add` appends to a text: threads make pieces of it, which are added in order.
/// `fetch` is called for an item some rows before: it may have the processor fetch what the row needs.
template <typename Item, typename Add, typename Fetch>
void add_rows(GrowingFile& table, const std::vector<Item>& items, const Add& add, const Fetch& fetch) {
  constexpr std::size_t items_of_piece = 4096, most_pieces = 16;  // held at once
  constexpr std::size_t ahead = 8;                                // a row takes longer than a fetch
  std::vector<fmt::memory_buffer> pieces(most_pieces);
  Workers workers(items.size() / items_of_piece);  // none for few items
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t count = 0;
    for (; count < most_pieces && begin < items.size(); ++count, begin += items_of_piece) {
      workers.add([&items, &add, &fetch, &piece = pieces[count], begin] {
        piece.clear();
        const std::size_t end = std::min(items.size(), begin + items_of_piece);
        for (std::size_t i = begin; i < end; ++i) {
          if (i + ahead < end) fetch(items[i + ahead]);
          add(piece, items[i]);
        }
      });
    }
    workers.wait();
    for (std::size_t i = 0; i < count; ++i) table << std::string_view(pieces[i].data(), pieces[i].size());
  }
}

/// The same where rows need nothing that lies apart.
template <typename Item, typename Add>
void add_rows(GrowingFile& table, const std::vector<Item>& items, const Add& add) {
  add_rows(table, items, add, [](const Item&) {});
}

}  // namespace vorocl::command
