#include "formats/npy.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include "formats/files.hpp"
#include "formats/image_rows.hpp"
#include "formats/numbers.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

/// What a file says of its array.
struct NpyHeader {
  std::string type;  // such as "f8", without the order of bytes
  std::vector<std::size_t> shape;
  bool is_big_endian = false;
  bool is_fortran = false;  // the first index changes fastest

  std::size_t count() const {
    return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  }
};

namespace {

const char magic[] = "\x93NUMPY";
constexpr std::size_t magic_size = sizeof magic - 1;

/// Of numbers without a sign, and of floats: "<f4".
template <typename T>
std::string npy_type() {
  const char* const kind = std::is_floating_point_v<T> ? "f" : "u";
  return (sizeof(T) == 1 ? "|" : "<") + (kind + std::to_string(sizeof(T)));
}

/// The text behind "'key':" in the header, a Python dictionary that NumPy writes in one line.
std::string header_value(const std::string& header, const std::string& key, const std::string& path) {
  const auto found = header.find("'" + key + "':");
  if (found == std::string::npos) throw Error(path + " is no .npy array: its header has no " + key);
  return std::string(trimmed(header.substr(found + key.size() + 3)));
}

std::vector<std::size_t> parse_shape(const std::string& text, const std::string& path) {
  std::vector<std::size_t> shape;
  const auto end = text.find(')');
  for (std::size_t begin = 1; text[0] == '(' && end != std::string::npos && begin < end;) {
    const auto comma = std::min(text.find(',', begin), end);
    const std::string item = text.substr(begin, comma - begin);
    begin = comma + 1;
    if (trimmed(item).empty()) continue;  // behind the last comma, as in (5,)
    const auto side = parse_number<std::size_t>(item);
    if (!side) throw Error(path + " is no .npy array: its header's shape is " + text.substr(0, end + 1));
    shape.push_back(*side);
  }
  return shape;
}

std::string to_string(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t side : shape) text += (text.empty() ? "" : ", ") + std::to_string(side);
  return "(" + text + ")";
}

std::string read_header_text(std::ifstream& file, const std::string& path) {
  char start[magic_size + 2] = {};
  file.read(start, sizeof start);
  const auto version = static_cast<unsigned char>(start[magic_size]);
  if (!file || std::memcmp(start, magic, magic_size) != 0 || version < 1 || version > 3) {
    throw Error(path + " is no .npy array of format version 1 to 3");
  }
  std::uint32_t length = 0;
  file.read(reinterpret_cast<char*>(&length), version == 1 ? 2 : 4);
  std::string text(file && length < (1u << 20) ? length : 0, ' ');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file || text.empty()) throw Error(path + " is no .npy array: its header ends early");
  return text;
}

NpyHeader read_header(std::ifstream& file, const std::string& path) {
  const std::string text = read_header_text(file, path);
  const std::string descr = header_value(text, "descr", path);  // a list where values are records
  const std::string type = descr[0] == '\'' ? descr.substr(1, descr.find('\'', 1) - 1) : "record";
  const auto size = type.size() == 3 ? parse_number<std::size_t>(type.substr(2)) : std::nullopt;
  if (!size || number_type(type[1], *size) == nullptr) {
    throw Error(path + " holds values of type " + type +
                "; booleans, and integers and floating-point numbers of at most 8 bytes, can be read");
  }
  return {type.substr(1), parse_shape(header_value(text, "shape", path), path), type[0] == '>',
          header_value(text, "fortran_order", path).compare(0, 4, "True") == 0};
}

}  // namespace

/// The numbers of an array file, as if it were in C order.
class NpyArray {
 public:
  explicit NpyArray(const std::string& path)
      : path_(path), file_(open_to_read(path)), header_(read_header(file_, path)) {}

  const NpyHeader& header() const { return header_; }

  /// Throws Error unless the file has all values of the shape. Compared before any memory is taken: a damaged
  /// header may promise anything.
  void require_all() {
    begin_ = file_.tellg();
    const auto there_is = static_cast<std::uint64_t>(file_.seekg(0, std::ios::end).tellg() - begin_);
    if (there_is / type().size < header_.count()) {
      throw Error(path_ + " ends early: its shape is " + to_string(header_.shape));
    }
  }

  void read(std::uint64_t first, std::size_t count, double* numbers) {
    if (!header_.is_fortran) return read_stored(first, count, numbers);
    if (whole_.empty()) {  // a row is spread over all of it
      whole_.resize(header_.count());
      read_stored(0, whole_.size(), whole_.data());
    }
    for (std::size_t i = 0; i < count; ++i) numbers[i] = whole_[place_of(first + i)];
  }

 private:
  const NumberType& type() const {
    return *number_type(header_.type[0], static_cast<std::size_t>(header_.type[1] - '0'));
  }

  /// Of the number that has this place in C order.
  std::size_t place_of(std::uint64_t place) const {
    std::size_t stored = 0;
    for (auto side = header_.shape.rbegin(); side != header_.shape.rend(); place /= *side++)
      stored += static_cast<std::size_t>(place % *side) *
                std::accumulate(side + 1, header_.shape.rend(), std::size_t{1}, std::multiplies<>());
    return stored;
  }

  void read_stored(std::uint64_t first, std::size_t count, double* numbers) {
    const std::size_t size = type().size;
    bytes_.resize(count * size);
    file_.seekg(begin_ + static_cast<std::streamoff>(first * size));
    file_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    if (!file_) throw Error("reading " + path_ + " failed");
    for (auto at = bytes_.begin(); header_.is_big_endian && at != bytes_.end();) {
      const auto value = at;
      std::reverse(value, at += static_cast<std::ptrdiff_t>(size));
    }
    type().read(bytes_.data(), count, numbers);
  }

  std::string path_;
  std::ifstream file_;
  NpyHeader header_;
  std::streampos begin_;
  std::vector<char> bytes_;
  std::vector<double> whole_;  // of an array in Fortran order
};

namespace {

template <typename T>
void write_array(const OutputFile& file, const std::vector<std::size_t>& shape,
                 const std::vector<T>& values) {
  GrowingFile array(file);
  array << npy_header<T>(shape);
  array.write(values.data(), values.size() * sizeof(T));
  array.finish();
}

}  // namespace

NpyPoints::NpyPoints(const std::string& path, std::uint64_t most, bool has_z)
    : dimensions_(has_z ? 3 : 2), array_(std::make_unique<NpyArray>(path)) {
  const std::vector<std::size_t>& shape = array_->header().shape;
  if (shape.size() != 2 || shape[1] != dimensions_) {
    throw Error(path + " has the shape " + to_string(shape) + "; points of a plane need (N, 2), and " +
                "those of a volume, which --size WxHxD or --exact asks for, (N, 3)");
  }
  size_ = shape[0];
  if (size_ == 0) throw Error(path + " holds no points");
  if (size_ > most) {
    throw Error(path + " holds " + std::to_string(size_) + " points; at most " + std::to_string(most) +
                " can be seeds");
  }
  array_->require_all();
}

NpyPoints::~NpyPoints() = default;

std::vector<Point> NpyPoints::read(std::uint64_t first, std::size_t count) {
  std::vector<double> values(count * dimensions_);
  array_->read(first * dimensions_, values.size(), values.data());
  std::vector<Point> points;
  points.reserve(count);
  for (const double* at = values.data(); points.size() < count; at += dimensions_) {
    points.push_back({at[0], at[1], dimensions_ == 3 ? at[2] : 0});
  }
  return points;
}

bool holds_points_of_volume(const std::string& path) {
  const NpyArray array(path);
  const std::vector<std::size_t>& shape = array.header().shape;
  return shape.size() == 2 && shape[1] == 3;
}

std::vector<Point> read_npy_points(const std::string& path, bool has_z) {
  NpyPoints points(path, Window::max_pixels, has_z);
  return points.read(0, points.size());
}

namespace {

class NpyRows : public ImageRows {
 public:
  NpyRows(const ImageInfo& info, std::unique_ptr<NpyArray> array)
      : ImageRows(info), array_(std::move(array)) {}

  void next(std::vector<double>& row) override {
    row.resize(static_cast<std::size_t>(info().width));
    array_->read(first_, row.size(), row.data());
    first_ += row.size();
  }

 private:
  std::unique_ptr<NpyArray> array_;
  std::uint64_t first_ = 0;
};

}  // namespace

std::unique_ptr<ImageRows> open_npy_image(const std::string& path) {
  auto array = std::make_unique<NpyArray>(path);
  const std::vector<std::size_t>& shape = array->header().shape;
  const auto fits = [](std::size_t side, std::int64_t most) {
    return side >= 1 && side <= static_cast<std::size_t>(most);
  };
  const std::size_t skipped = shape.size() == 3 ? 1 : 0;
  if (shape.size() != skipped + 2 || !fits(shape[skipped], Axis::max_pixels) ||
      !fits(shape[skipped + 1], Axis::max_pixels) ||
      (skipped > 0 && !fits(shape[0], Window::max_side_of_volume))) {
    throw Error(path + " has the shape " + to_string(shape) +
                "; images have (height, width), with sides from 1 to " + std::to_string(Axis::max_pixels) +
                ", and labels of a volume (depth, height, width)");
  }
  ImageInfo info;
  info.width = static_cast<std::int64_t>(shape[skipped + 1]);
  info.height = static_cast<std::int64_t>(shape[skipped]);
  if (skipped > 0) info.depth = static_cast<std::int64_t>(shape[0]);
  info.type = array->header().type;
  array->require_all();
  return std::make_unique<NpyRows>(info, std::move(array));
}

template <typename T>
void write_npy(const OutputFile& file, const Raster& raster, const std::vector<T>& values) {
  std::vector<std::size_t> shape = {static_cast<std::size_t>(raster.size.height()),
                                    static_cast<std::size_t>(raster.size.width())};
  if (raster.is_volume()) shape.insert(shape.begin(), static_cast<std::size_t>(raster.depth));
  write_array(file, shape, values);
}

template void write_npy(const OutputFile&, const Raster&, const std::vector<std::uint8_t>&);
template void write_npy(const OutputFile&, const Raster&, const std::vector<std::uint32_t>&);
template void write_npy(const OutputFile&, const Raster&, const std::vector<float>&);

template <typename T>
std::string npy_header(const std::vector<std::size_t>& shape) {
  std::string header = std::string("{'descr': '") + npy_type<T>() +
                       "', 'fortran_order': False, 'shape': " + to_string(shape) + ", }";
  // The values start at a multiple of 64 bytes: behind magic, version (2 bytes), length (2 bytes) and header.
  header.resize((magic_size + 4 + header.size() + 64) / 64 * 64 - magic_size - 5, ' ');
  header += '\n';
  const auto low = static_cast<char>(header.size() % 256), high = static_cast<char>(header.size() / 256);
  return std::string(magic, magic_size) + '\x01' + '\0' + low + high + header;
}

template std::string npy_header<std::uint32_t>(const std::vector<std::size_t>&);
template std::string npy_header<float>(const std::vector<std::size_t>&);

void write_npy_points(const OutputFile& file, const std::vector<Point>& points) {
  std::vector<double> values;
  values.reserve(2 * points.size());
  for (const Point& point : points) values.insert(values.end(), {point.x, point.y});
  write_array(file, {points.size(), 2}, values);
}

}  // namespace vorocl::command
