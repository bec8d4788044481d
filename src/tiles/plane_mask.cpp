#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/box_tree.hpp"
#include "runtime/internal.hpp"
#include "runtime/pixel_grid.hpp"
#include "tiles/near_seeds.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// The set pixels of a plane: a bit for each, and a tree of blocks above them.
///
/// The bits of pixels row by row. Above them a bit says of each block of 8 x 8 pixels whether one is set, of
/// each 8 x 8 such blocks whether one has a pixel, and so on up to one word. An index for NearSeeds, whose
/// numbers are x + width * y.
class MaskIndex {
 public:
  MaskIndex(std::int64_t width, std::int64_t height)
      : width_(width), height_(height), words_(parts(width, word_bits)) {
    std::int64_t across = width, down = height;
    do {
      across = parts(across, fan);
      down = parts(down, fan);
      levels_.push_back(
          {parts(across, fan), std::vector<Word>(to_index(parts(across, fan) * parts(down, fan)))});
    } while (across > fan || down > fan);
  }

  std::int64_t rows() const { return static_cast<std::int64_t>(before_.size()) - 1; }
  std::uint64_t size() const { return before_.back(); }

  /// Returns false, and adds nothing, if there were `most` seeds or more.
  bool add_row(const std::uint8_t* pixels, std::uint64_t most) {
    const std::size_t first = bits_.size();
    std::uint64_t seeds = size();
    for (std::int64_t x = 0; x < width_; x += word_bits) {
      Word word = 0;
      for (std::int64_t i = 0; i < std::min(word_bits, width_ - x); ++i) {
        word |= static_cast<Word>(pixels[x + i] != 0) << i;
      }
      bits_.push_back(word);
      seeds += count_bits(word);
    }
    if (seeds >= most) {
      bits_.resize(first);
      return false;
    }
    const std::int64_t y = rows();
    for (std::int64_t block = 0; block < parts(width_, fan); ++block) {
      if (byte_at(block, y) != 0) mark(block, y / fan);
    }
    before_.push_back(seeds);
    return true;
  }

  PlaneSeed seed(std::size_t number) const {
    const auto x = static_cast<std::int64_t>(number) % width_, y = static_cast<std::int64_t>(number) / width_;
    return seed_at(x, y, id_from(x, y));
  }

  void find_inside(const PlaneRectangle& rectangle, std::vector<PlaneSeed>& found) const {
    const std::int64_t end = rectangle.x + rectangle.width;
    for (std::int64_t y = rectangle.y; y < rectangle.y + rectangle.height; ++y) {
      std::uint64_t id = id_from(rectangle.x, y);
      for (std::int64_t x = rectangle.x; x < end; x = (x / word_bits + 1) * word_bits) {
        Word word = word_at(x / word_bits, y) >> x % word_bits;
        if (end - x < word_bits) word &= bit(end - x) - 1;
        for (; word != 0; word &= word - 1) found.push_back(seed_at(x + lowest_bit(word), y, id++));
      }
    }
  }

  template <typename Enters, typename Use>
  bool visit(Enters enters, Use use) const {
    return visit(levels_.size(), 0, 0, enters, use);
  }

  template <typename Distance, typename Counts, typename Use>
  void visit_nearest_first(Distance distance, Counts counts, Use use) const {
    visit_nearest_first(levels_.size(), 0, 0, distance, counts, use);
  }

 private:
  using Word = std::uint64_t;
  static constexpr std::int64_t word_bits = 64, fan = 8;

  struct Level {
    std::int64_t words;  // of a row of them
    std::vector<Word> bits;
  };

  static std::size_t to_index(std::int64_t number) { return static_cast<std::size_t>(number); }
  static std::int64_t parts(std::int64_t whole, std::int64_t of) { return (whole + of - 1) / of; }
  static Word bit(std::int64_t number) { return Word{1} << number; }
  static int lowest_bit(Word word) { return __builtin_ctzll(word); }
  static std::uint64_t count_bits(Word word) {
    return static_cast<std::uint64_t>(__builtin_popcountll(word));
  }

  Word word_at(std::int64_t word, std::int64_t y) const { return bits_[to_index(y * words_ + word)]; }

  /// Of 8 pixels of a row.
  Word byte_at(std::int64_t block, std::int64_t y) const {
    return word_at(block / fan, y) >> block % fan * fan & 255;
  }

  /// Says of a block of pixels that it has one, and of those above it.
  void mark(std::int64_t x, std::int64_t y) {
    for (Level& level : levels_) {
      Word& word = level.bits[to_index(y / fan * level.words + x / fan)];
      const Word before = std::exchange(word, word | bit(y % fan * fan + x % fan));
      if (before != 0) return;
      x /= fan;
      y /= fan;
    }
  }

  /// The seeds before a pixel.
  std::uint64_t id_from(std::int64_t x, std::int64_t y) const {
    std::uint64_t id = before_[to_index(y)];
    for (std::int64_t word = 0; word < x / word_bits; ++word) id += count_bits(word_at(word, y));
    return id + count_bits(word_at(x / word_bits, y) & (bit(x % word_bits) - 1));
  }

  static PlaneSeed seed_at(std::int64_t x, std::int64_t y, std::uint64_t id) {
    return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::uint32_t>(id)};
  }

  /// The 8 x 8 bits of a block of a level; pixels are level 0.
  Word block(std::size_t level, std::int64_t x, std::int64_t y) const {
    if (level > 0) return levels_[level - 1].bits[to_index(y * levels_[level - 1].words + x)];
    Word pixels = 0;
    for (std::int64_t row = 0; row < std::min(fan, height_ - y * fan); ++row) {
      pixels |= byte_at(x, y * fan + row) << row * fan;
    }
    return pixels;
  }

  /// The pixels of a bit of a level.
  Box box_of(std::size_t level, std::int64_t x, std::int64_t y) const {
    std::int64_t side = 1;
    for (; level > 0; --level) side *= fan;
    const auto clipped = [](std::int64_t at, std::int64_t end) {
      return static_cast<std::int32_t>(std::min(at, end - 1));
    };
    return {clipped(x * side, width_), clipped(y * side, height_), clipped((x + 1) * side - 1, width_),
            clipped((y + 1) * side - 1, height_)};
  }

  std::size_t number_of(std::int64_t x, std::int64_t y) const { return to_index(x + width_ * y); }

  template <typename Enters, typename Use>
  bool visit(std::size_t level, std::int64_t x, std::int64_t y, const Enters& enters, const Use& use) const {
    for (Word bits = block(level, x, y); bits != 0; bits &= bits - 1) {
      const std::int64_t inner_x = x * fan + lowest_bit(bits) % fan,
                         inner_y = y * fan + lowest_bit(bits) / fan;
      if (level == 0) {
        if (!use(number_of(inner_x, inner_y))) return false;
      } else if (enters(box_of(level, inner_x, inner_y)) &&
                 !visit(level - 1, inner_x, inner_y, enters, use)) {
        return false;
      }
    }
    return true;
  }

  template <typename Distance, typename Counts, typename Use>
  void visit_nearest_first(std::size_t level, std::int64_t x, std::int64_t y, const Distance& distance,
                           const Counts& counts, const Use& use) const {
    using Length = decltype(distance(Box()));
    struct Inner {
      Length away;
      std::int64_t x, y;
      Box box;
    };
    std::array<Inner, fan * fan> order;
    std::size_t count = 0;
    for (Word bits = block(level, x, y); bits != 0; bits &= bits - 1) {
      const std::int64_t inner_x = x * fan + lowest_bit(bits) % fan,
                         inner_y = y * fan + lowest_bit(bits) / fan;
      const Box box = box_of(level, inner_x, inner_y);
      const Length away = distance(box);
      if (counts(box, away)) order[count++] = {away, inner_x, inner_y, box};
    }
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Inner& a, const Inner& b) { return a.away < b.away; });
    for (std::size_t i = 0; i < count; ++i) {
      const Inner& inner = order[i];
      if (!counts(inner.box, inner.away)) continue;
      if (level == 0) {
        use(number_of(inner.x, inner.y));
      } else {
        visit_nearest_first(level - 1, inner.x, inner.y, distance, counts, use);
      }
    }
  }

  std::int64_t width_, height_;
  std::int64_t words_;  // of a row of pixels
  std::vector<Word> bits_;
  std::vector<std::uint64_t> before_ = {0};  // the seeds before each row, and before the one to come
  std::vector<Level> levels_;
};

struct PlaneMaskState {
  explicit PlaneMaskState(const Grid& of) : grid(of), index(grid.width(), grid.height()) {}

  Grid grid;
  MaskIndex index;
};

PlaneMask::PlaneMask(const Grid& grid) {
  refuse_volume(grid, "a mask of tiles");
  refuse_tilted(grid, "a mask of tiles");
  state_ = make_state<PlaneMaskState>(grid);
}

PlaneMaskState& PlaneMask::state() const {
  if (!state_) throw Error("this mask was moved from, and has no rows; use the one it was moved to");
  return *state_;
}

void PlaneMask::add_rows(const std::uint8_t* pixels, std::int64_t count) {
  auto& [grid, index] = state();
  if (count < 0 || count > grid.height() - index.rows()) {
    throw Error("the mask has " + std::to_string(index.rows()) + " of " + std::to_string(grid.height()) +
                " rows, and cannot take " + std::to_string(count) + " more");
  }
  for (std::int64_t row = 0; row < count; ++row, pixels += grid.width()) {
    if (!index.add_row(pixels, no_label))
      throw Error("the mask has 2^32 - 1 seeds or more, which ids cannot number");
  }
}

std::int64_t PlaneMask::rows() const { return state().index.rows(); }
const Grid& PlaneMask::grid() const { return state().grid; }
std::uint64_t PlaneMask::id_end() const { return state().index.size(); }

void PlaneMask::find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const {
  const auto& [grid, index] = state();
  if (index.rows() < grid.height()) {
    throw Error("the mask has " + std::to_string(index.rows()) + " of " + std::to_string(grid.height()) +
                " rows; add the others before tiles are made");
  }
  NearSeeds(index, grid, metric).find(window, seeds);
}

}  // namespace vorocl
