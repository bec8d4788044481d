// The rows of tables, made by threads.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/csv.hpp"
#include "formats/output_file.hpp"
#include "formats/workers.hpp"

namespace vorocl::command {

/// The text of some rows.
class RowText {
 public:
  /// Of a value that a row does not have.
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// `first` stands before the values of each row.
  explicit RowText(std::string first) : first_(std::move(first)) {}

  void begin_row() { text_.append(std::string_view(first_)); }

  /// Adds a number as "{}" writes it, and nothing where it is unknown.
  void add(double value) {
    constexpr std::size_t longest = 32;  // of a number with the comma behind it
    const std::size_t size = text_.size();
    text_.resize(size + longest);
    char* const begin = text_.data() + size;
    char* const end = std::isnan(value) ? begin : write(begin, value);
    *end = ',';
    text_.resize(size + static_cast<std::size_t>(end - begin) + 1);
  }

  template <typename... Values>
  void add(double first, double second, const Values&... others) {
    add(first);
    add(second);
    (add(others), ...);
  }

  void add(const CsvFields& fields) {
    if (!fields.empty()) text_.append(to_csv(fields) + ',');
  }

  /// Behind one value or more.
  void end_row() { text_[text_.size() - 1] = '\n'; }

  void clear() { text_.clear(); }
  std::string_view text() const { return {text_.data(), text_.size()}; }

 private:
  /// Most numbers of tables are whole, for which there is a shorter way.
  static char* write(char* to, double value) {
    constexpr double most = 1e15;  // of those that "{}" writes without an exponent
    if (std::fabs(value) < most && !(value == 0 && std::signbit(value))) {
      const auto whole = static_cast<std::int64_t>(value);
      if (static_cast<double>(whole) == value) return fmt::format_to(to, FMT_COMPILE("{}"), whole);
    }
    return fmt::format_to(to, FMT_COMPILE("{}"), value);
  }

  std::string first_;
  fmt::memory_buffer text_;
};

/// Adds the rows of items, with `first` before each: `add` appends the values of one to a text. Threads make
/// pieces, which are added in order.
template <typename Item, typename Add>
void add_rows(GrowingFile& table, const std::string& first, const std::vector<Item>& items, const Add& add) {
  constexpr std::size_t items_of_piece = 4096, most_pieces = 16;  // held at once
  std::vector<RowText> pieces;
  for (std::size_t i = 0; i < most_pieces; ++i) pieces.emplace_back(first);
  Workers workers(items.size() / items_of_piece);  // none for few items
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t count = 0;
    for (; count < most_pieces && begin < items.size(); ++count, begin += items_of_piece) {
      workers.add([&items, &add, &piece = pieces[count], begin] {
        piece.clear();
        for (std::size_t i = begin; i < std::min(items.size(), begin + items_of_piece); ++i) {
          piece.begin_row();
          add(piece, items[i]);
          piece.end_row();
        }
      });
    }
    workers.wait();
    for (std::size_t i = 0; i < count; ++i) table << pieces[i].text();
  }
}

}  // namespace vorocl::command
