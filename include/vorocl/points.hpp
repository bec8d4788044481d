// Points of the caller's, on the host or on the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// A view of points on the host, in the units of the data: nothing is copied until seeds are made of them.
/// A point may be absent: then its seed has an id and no cell. Points without a z lie in a plane, whatever
/// the coordinates of its one slice are.
///
/// Lifetime: what it views must live until the call that takes it returns.
class VOROCL_API Points {
 public:
  Points(const std::vector<Point>& points) : Points(points.data(), points.size()) {}
  Points(std::initializer_list<Point> points) : Points(points.begin(), points.size()) {}
  Points(const Point* points, std::size_t count);

  /// A seed without a point is absent.
  Points(const std::vector<std::optional<Point>>& points)
      : first_(points.data()), size_(points.size()), kind_(Kind::optional) {}

  /// From memory where the coordinates of one point lie `stride` bytes behind those of the one before:
  /// columns of a table, or members of a struct. The stride may be negative.
  Points(const double* x, const double* y, const double* z, std::size_t count,
         std::ptrdiff_t stride = sizeof(double));
  Points(const float* x, const float* y, const float* z, std::size_t count,
         std::ptrdiff_t stride = sizeof(float));

  /// As above, without a z.
  Points(const double* x, const double* y, std::size_t count, std::ptrdiff_t stride = sizeof(double));
  Points(const float* x, const float* y, std::size_t count, std::ptrdiff_t stride = sizeof(float));

  /// The same points. A point whose byte is 0 is absent, and the others are present. `present` has size()
  /// bytes.
  Points marked(const std::uint8_t* present) const;

  /// The same points, weighted: the labels of an exact diagram are those of its power diagram (Laguerre,
  /// radical), and so are exact cells. A place belongs to the seed of the least |place - point|^2 - weight,
  /// so spheres have their squared radii as weights. Weights are in the units of the data squared; only
  /// differences count. `weights` has size() numbers; that of an absent point is not looked at.
  Points weighted(const double* weights) const;

  std::size_t size() const { return size_; }
  const double* weights() const { return weights_; }  ///< null if there are none
  bool is_present(std::size_t i) const {
    return (present_ == nullptr || present_[i] != 0) &&
           (kind_ != Kind::optional || static_cast<const std::optional<Point>*>(first_)[i].has_value());
  }

  /// The point of a seed that is present; its z is 0 if it has none.
  Point operator[](std::size_t i) const {
    if (kind_ == Kind::optional) return *static_cast<const std::optional<Point>*>(first_)[i];
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(i) * stride_;
    return kind_ == Kind::doubles ? point_at<double>(offset) : point_at<float>(offset);
  }

  /// Whether they have a z.
  bool have_z() const { return kind_ == Kind::optional || z_ != nullptr; }

 private:
  enum class Kind { doubles, floats, optional };

  Points(Kind kind, const void* x, const void* y, const void* z, std::size_t count, std::ptrdiff_t stride)
      : first_(x), y_(y), z_(z), size_(count), stride_(stride), kind_(kind) {}

  template <typename Real>
  Point point_at(std::ptrdiff_t offset) const {
    const auto coordinate = [offset](const void* first) {
      return static_cast<double>(*reinterpret_cast<const Real*>(static_cast<const char*>(first) + offset));
    };
    return {coordinate(first_), coordinate(y_), z_ == nullptr ? 0 : coordinate(z_)};
  }

  const void* first_;  // the first x, or the first optional point
  const void* y_ = nullptr;
  const void* z_ = nullptr;
  std::size_t size_;
  std::ptrdiff_t stride_ = sizeof(Point);
  Kind kind_;
  const std::uint8_t* present_ = nullptr;
  const double* weights_ = nullptr;
};

/// What a buffer of points holds for each: two numbers or, with a z, three, without gaps.
enum class PointFormat { floats_xy, doubles_xy, floats_xyz, doubles_xyz };

/// Points in the caller's buffer on the device, in the units of the data.
struct PointBuffer {
  /// `present` says which seeds there are: one byte per seed, 0 for a seed that is absent, whose point is not
  /// looked at; a null buffer says that all are there.
  PointBuffer(cl::Buffer points_of_seeds, std::size_t count_of_seeds,
              PointFormat format_of_points = PointFormat::floats_xy, cl::Buffer marks = cl::Buffer())
      : points(std::move(points_of_seeds)),
        count(count_of_seeds),
        format(format_of_points),
        present(std::move(marks)) {}

  cl::Buffer points;
  std::size_t count;
  PointFormat format;
  cl::Buffer present;
};

}  // namespace vorocl
