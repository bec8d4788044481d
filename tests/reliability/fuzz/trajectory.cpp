// Trajectories: LAMMPS text dumps and XYZ files, with and without values of a column.
#include "formats/trajectory/trajectory.hpp"

#include <algorithm>

#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

void read_all(const std::string& path, const std::string& column) {
  const auto reader = open_trajectory(path, column), boxes = open_trajectory(path, column, Wanted::box);
  for (Frame frame, other; reader->next(frame);) {
    require(boxes->next(other) && frame.box.has_value() == other.box.has_value());
    if (frame.box) require(frame.box->x0 == other.box->x0 && frame.box->y1 == other.box->y1);
    require(frame.positions.size() == frame.ids.size());
    require(frame.values.numbers.size() == (column.empty() ? 0 : frame.ids.size()));
    require(std::is_sorted(frame.ids.begin(), frame.ids.end()));
    if (frame.box) require(frame.box->x0 < frame.box->x1 && frame.box->y0 < frame.box->y1);
  }
}

void read_volumes(const std::string& path) {
  const auto reader = open_trajectory(path, "", Wanted::volume);
  for (Frame frame; reader->next(frame);) {
    require(frame.z.size() == frame.ids.size() && frame.positions.size() == frame.ids.size());
    for (const double z : frame.z) require(!frame.box || (z >= frame.box->z0 && z <= frame.box->z1));
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".xyz");
  for (const char* const column : {"", "vx", "v[2]"}) read_or_refuse([&] { read_all(path, column); });
  read_or_refuse([&] { read_volumes(path); });
  return 0;
}
