// A k-d tree of seeds: the ground truth of diagrams that are too large for brute force.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "brute_force.hpp"

namespace vorocl {

/// Finds the nearest seed of a pixel by the tie rule. Of seeds that share a pixel it holds the lowest id
/// alone.
class SeedTree {
 public:
  SeedTree(const std::vector<Pixel>& seeds, Metric metric) : metric_(metric) {
    std::vector<std::uint32_t> ids(seeds.size());
    std::iota(ids.begin(), ids.end(), 0u);
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return seeds[a] < seeds[b]; };
    std::stable_sort(ids.begin(), ids.end(), before);
    const auto same = [&](std::uint32_t a, std::uint32_t b) { return !before(a, b) && !before(b, a); };
    ids.erase(std::unique(ids.begin(), ids.end(), same), ids.end());
    for (const std::uint32_t id : ids) nodes_.push_back({seeds[id], id, true});
    build(0, nodes_.size());
  }

  /// The seed nearest to some image of the pixel.
  std::uint32_t nearest(const Grid& grid, const Pixel& pixel) const {
    Nearest found;
    for (int y = grid.periodic_y() ? -1 : 0; y <= (grid.periodic_y() ? 1 : 0); ++y) {
      for (int x = grid.periodic_x() ? -1 : 0; x <= (grid.periodic_x() ? 1 : 0); ++x) {
        search(0, nodes_.size(), {pixel.x + x * grid.width(), pixel.y + y * grid.height()}, found);
      }
    }
    return found.node == nullptr ? no_label : found.node->id;
  }

 private:
  /// The middle of its range of nodes: smaller coordinates before it, greater ones behind it.
  struct Node {
    Pixel seed;
    std::uint32_t id;
    bool splits_x;
  };
  struct Nearest {
    const Node* node = nullptr;
    std::int64_t distance = 0;
  };

  void build(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return;
    const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto by_x = [](const Node& a, const Node& b) { return a.seed.x < b.seed.x; };
    const auto by_y = [](const Node& a, const Node& b) { return a.seed.y < b.seed.y; };
    const auto [left, right] = std::minmax_element(at(begin), at(end), by_x);
    const auto [top, bottom] = std::minmax_element(at(begin), at(end), by_y);
    const bool splits_x = right->seed.x - left->seed.x > bottom->seed.y - top->seed.y;
    const std::size_t middle = begin + (end - begin) / 2;
    if (splits_x) {
      std::nth_element(at(begin), at(middle), at(end), by_x);
    } else {
      std::nth_element(at(begin), at(middle), at(end), by_y);
    }
    nodes_[middle].splits_x = splits_x;
    build(begin, middle);
    build(middle + 1, end);
  }

  void search(std::size_t begin, std::size_t end, const Pixel& pixel, Nearest& found) const {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Node& node = nodes_[middle];
    const std::int64_t d = distance(pixel, node.seed, metric_);
    if (found.node == nullptr || d < found.distance ||
        (d == found.distance && node.seed < found.node->seed)) {
      found = {&node, d};
    }
    const std::int64_t offset = node.splits_x ? pixel.x - node.seed.x : pixel.y - node.seed.y;
    const bool before = offset < 0;
    search(before ? begin : middle + 1, before ? middle : end, pixel, found);
    // Seeds behind the line can tie with the nearest one.
    const std::int64_t to_line = metric_ == Metric::euclidean ? offset * offset : std::abs(offset);
    if (to_line <= found.distance) search(before ? middle + 1 : begin, before ? end : middle, pixel, found);
  }

  std::vector<Node> nodes_;
  Metric metric_;
};

/// The labels of the exact diagram with the tie rule, as brute_force() gives them.
inline std::vector<std::uint32_t> tree_labels(const Grid& grid, const std::vector<Pixel>& seeds,
                                              Metric metric) {
  const SeedTree tree(seeds, metric);
  std::vector<std::uint32_t> labels;
  labels.reserve(grid.pixels());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) labels.push_back(tree.nearest(grid, {x, y}));
  }
  return labels;
}

}  // namespace vorocl
