#include "vorocl/diagram.hpp"

#include "buffer.hpp"

namespace vorocl {

Diagram::Diagram(const Device& device, const Grid& grid)
    : device_(device), grid_(grid), scratch_(static_cast<std::size_t>(Scratch::count_)) {
  labels_ = allocate(device, grid.pixels() * sizeof(std::uint32_t), "the label image");
  fill(device, labels_, no_label, grid.pixels());
}

Diagram::Diagram(const Device& device, const Grid& grid, const cl::Buffer& labels)
    : device_(device), grid_(grid), labels_(labels), scratch_(static_cast<std::size_t>(Scratch::count_)) {
  check_foreign_buffer(device, labels, grid.pixels() * sizeof(std::uint32_t), "the buffer of labels",
                       Access::read_and_write);
}

std::vector<std::uint32_t> Diagram::read() const {
  wait();
  return download<std::uint32_t>(device_, labels_, grid_.pixels());
}

void Diagram::wait() const {
  device_.finish();
  if (seeds_) seeds_->check();
}

const cl::Buffer& Diagram::scratch(Scratch use, std::size_t bytes) {
  cl::Buffer& buffer = scratch_[static_cast<std::size_t>(use)];
  if (buffer() == nullptr || size_of(buffer) < bytes) {
    buffer = cl::Buffer();
    std::size_t held = size_of(labels_);
    for (const cl::Buffer& other : scratch_) held += other() == nullptr ? 0 : size_of(other);
    buffer = allocate(device_, bytes, "a diagram's working memory", held);
  }
  return buffer;
}

void Diagram::check_fits(const Seeds& seeds) const {
  if (!seeds.device().same_as(device_)) throw Error("the seeds and the diagram belong to different devices");
  if (seeds.grid() != grid_) {
    throw Error("the seeds' grid is " + std::to_string(seeds.grid().width()) + " x " +
                std::to_string(seeds.grid().height()) + ", the diagram's " + std::to_string(grid_.width()) +
                " x " + std::to_string(grid_.height()));
  }
}

void Diagram::begin(const Seeds& seeds) {
  check_fits(seeds);
  seeds_ = seeds;
  age_ = 0;
}

bool Diagram::holds_labels_of(const Seeds& seeds) const {
  return seeds_ && seeds_->alive() > 0 && seeds_->positions()() == seeds.positions()() &&
         seeds_->vanishings() == seeds.vanishings();
}

}  // namespace vorocl
