#include "core/seeds_frame.hpp"

#include <cstring>
#include <string>

#include "runtime/bad_point.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

double coordinate(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

}  // namespace

PointCheck::PointCheck(const Device& device, const Grid& grid)
    : device_(device), grid_(grid), found_(allocate(device, sizeof(cl_uint4), "the check of the points")) {}

void PointCheck::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  fill(device_, found_, cl_uint4{{no_label, 0, 0, 0}}, 1);
  known_ = false;
  bad_point_.reset();
}

void PointCheck::read() const {
  if (known_) return;
  const cl_uint4 found = download<cl_uint4>(device_, found_, 1).front();
  if (found.s[0] != no_label) {
    bad_point_ = point_outside(grid_, found.s[0], {coordinate(found.s[1]), coordinate(found.s[2])});
  }
  absent_ = found.s[3];
  known_ = true;
}

const std::optional<BadPoint>& PointCheck::bad_point() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  read();
  return bad_point_;
}

std::size_t PointCheck::absent() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  read();
  return absent_;
}

std::size_t SeedsFrame::alive() const { return size - absent - (marked ? points->absent() : 0); }

void SeedsFrame::check() const {
  if (points && points->bad_point()) throw BadPoint(*points->bad_point());
}

void SeedsFrame::refuse_outer_seeds(const char* what) const {
  if (!outer) return;
  const std::string lie = outer->outside == 0 ? "the seeds have a periodic domain"
                                              : std::to_string(outer->outside) + " of " +
                                                    std::to_string(size) + " seeds lie outside the grid";
  throw Error(lie + ", which " + what + " cannot take; only exact diagrams do");
}

}  // namespace vorocl
