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
class TreeOfPixels {
 public:
  TreeOfPixels(const std::vector<Pixel>& seeds, Metric metric) : metric_(metric) {
    std::vector<std::uint32_t> ids(seeds.size());
    std::iota(ids.begin(), ids.end(), 0u);
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return seeds[a] < seeds[b]; };
    std::stable_sort(ids.begin(), ids.end(), before);
    const auto same = [&](std::uint32_t a, std::uint32_t b) { return !before(a, b) && !before(b, a); };
    ids.erase(std::unique(ids.begin(), ids.end(), same), ids.end());
    for (const std::uint32_t id : ids) nodes_.push_back({seeds[id], id, true, {}, {}});
    build(0, nodes_.size());
  }

  /// Of the seeds nearest to each pixel, or to an image of it: each is looked for from the last one on.
  std::vector<std::uint32_t> labels(const Grid& grid) const {
    std::vector<std::uint32_t> labels;
    labels.reserve(grid.pixels());
    Nearest found;
    for (std::int64_t y = 0; y < grid.height(); ++y) {
      for (std::int64_t x = 0; x < grid.width(); ++x) {
        found = nearest(grid, {x, y}, found.node);
        labels.push_back(found.node == nullptr ? no_label : found.node->id);
      }
    }
    return labels;
  }

 private:
  /// The middle of its range of nodes: smaller coordinates before it, greater ones behind it.
  struct Node {
    Pixel seed;
    std::uint32_t id;
    bool splits_x;
    Pixel low, high;  // of all in the range
  };
  struct Nearest {
    const Node* node = nullptr;
    std::int64_t distance = INT64_MAX;

    void take_nearer(const Node& other, std::int64_t d) {
      if (d < distance || (d == distance && other.seed < node->seed)) *this = {&other, d};
    }
  };

  Nearest nearest(const Grid& grid, const Pixel& pixel, const Node* guess) const {
    std::vector<Pixel> images;
    for (int y = grid.y().is_periodic() ? -1 : 0; y <= (grid.y().is_periodic() ? 1 : 0); ++y) {
      for (int x = grid.x().is_periodic() ? -1 : 0; x <= (grid.x().is_periodic() ? 1 : 0); ++x) {
        images.push_back({pixel.x + x * grid.width(), pixel.y + y * grid.height()});
      }
    }
    Nearest found;
    if (guess != nullptr) {
      for (const Pixel& image : images) found.take_nearer(*guess, distance(image, guess->seed, metric_));
    }
    for (const Pixel& image : images) search(0, nodes_.size(), image, found);
    return found;
  }

  void build(std::size_t begin, std::size_t end) {
    if (begin == end) return;
    const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto by_x = [](const Node& a, const Node& b) { return a.seed.x < b.seed.x; };
    const auto by_y = [](const Node& a, const Node& b) { return a.seed.y < b.seed.y; };
    const auto [left, right] = std::minmax_element(at(begin), at(end), by_x);
    const auto [top, bottom] = std::minmax_element(at(begin), at(end), by_y);
    const Pixel low = {left->seed.x, top->seed.y}, high = {right->seed.x, bottom->seed.y};
    const bool splits_x = high.x - low.x > high.y - low.y;
    const std::size_t middle = begin + (end - begin) / 2;
    if (splits_x) {
      std::nth_element(at(begin), at(middle), at(end), by_x);
    } else {
      std::nth_element(at(begin), at(middle), at(end), by_y);
    }
    Node& node = nodes_[middle];
    node.splits_x = splits_x;
    node.low = low;
    node.high = high;
    build(begin, middle);
    build(middle + 1, end);
  }

  void search(std::size_t begin, std::size_t end, const Pixel& pixel, Nearest& found) const {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Node& node = nodes_[middle];
    const Pixel in_box = {std::clamp(pixel.x, node.low.x, node.high.x),
                          std::clamp(pixel.y, node.low.y, node.high.y)};
    if (distance(pixel, in_box, metric_) > found.distance) return;  // as far: a seed there can tie
    found.take_nearer(node, distance(pixel, node.seed, metric_));
    const bool before = node.splits_x ? pixel.x < node.seed.x : pixel.y < node.seed.y;
    search(before ? begin : middle + 1, before ? middle : end, pixel, found);
    search(before ? middle + 1 : begin, before ? end : middle, pixel, found);
  }

  std::vector<Node> nodes_;
  Metric metric_;
};

/// The labels of the exact diagram with the tie rule, as brute_force() gives them.
inline std::vector<std::uint32_t> tree_labels(const Grid& grid, const std::vector<Pixel>& seeds,
                                              Metric metric) {
  return TreeOfPixels(seeds, metric).labels(grid);
}

}  // namespace vorocl
