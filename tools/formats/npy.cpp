#include "formats/npy.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "formats/files.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

const char magic[] = "\x93NUMPY";
constexpr std::size_t magic_size = sizeof magic - 1;

struct Header {
  std::string type;  // such as "<f8"
  std::vector<std::size_t> shape;
};

/// The size of a type's values and how to read one; bytes are taken as they are, so the host must be
/// little-endian.
struct Type {
  std::size_t size;
  double (*read)(const char* bytes);
};

template <typename T>
Type type_of() {
  return {sizeof(T), [](const char* bytes) {
            T value;
            std::memcpy(&value, bytes, sizeof value);
            return static_cast<double>(value);
          }};
}

/// A float of 16 bits (IEEE 754): a sign, 5 bits of an exponent, 10 of a fraction.
double read_half(const char* bytes) {
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double size = exponent == 31  ? (fraction == 0 ? HUGE_VAL : NAN)
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024 + fraction, exponent - 25);
  return (bits >> 15) != 0 ? -size : size;
}

const std::map<std::string, Type>& types() {
  static const std::map<std::string, Type> all = {
      {"|b1", type_of<std::uint8_t>()},  {"<f2", {2, read_half}},           {"|i1", type_of<std::int8_t>()},
      {"|u1", type_of<std::uint8_t>()},  {"<i2", type_of<std::int16_t>()},  {"<u2", type_of<std::uint16_t>()},
      {"<i4", type_of<std::int32_t>()},  {"<u4", type_of<std::uint32_t>()}, {"<i8", type_of<std::int64_t>()},
      {"<u8", type_of<std::uint64_t>()}, {"<f4", type_of<float>()},         {"<f8", type_of<double>()}};
  return all;
}

template <typename T>
constexpr const char* type_name = nullptr;
template <>
constexpr const char* type_name<std::uint8_t> = "|u1";
template <>
constexpr const char* type_name<std::uint32_t> = "<u4";
template <>
constexpr const char* type_name<float> = "<f4";
template <>
constexpr const char* type_name<double> = "<f8";

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

Header read_header(std::ifstream& file, const std::string& path) {
  const std::string text = read_header_text(file, path);
  const std::string type = header_value(text, "descr", path);  // a list where values are records
  Header header{type[0] == '\'' ? type.substr(1, type.find('\'', 1) - 1) : "record",
                parse_shape(header_value(text, "shape", path), path)};
  if (types().count(header.type) == 0) {
    throw Error(
        path + " holds values of type " + header.type +
        "; booleans, and little-endian integers and floating-point numbers of at most 8 bytes, can be read");
  }
  if (header_value(text, "fortran_order", path).compare(0, 5, "False") != 0) {
    throw Error(path + " is in Fortran order; save it with numpy.ascontiguousarray()");
  }
  return header;
}

/// Where the values begin, which must be `count` of them at least. The file is there then.
std::uint64_t find_values(std::ifstream& file, const Header& header, std::uint64_t count,
                          const std::string& path) {
  const auto begin = file.tellg();
  const auto there_is = static_cast<std::uint64_t>(file.seekg(0, std::ios::end).tellg() - begin);
  // Compared before any memory is taken: a damaged header may promise anything.
  if (there_is / types().at(header.type).size < count) {
    throw Error(path + " ends early: its shape is " + to_string(header.shape));
  }
  file.seekg(begin);
  return static_cast<std::uint64_t>(begin);
}

void read_bytes(std::ifstream& file, void* bytes, std::size_t count, const std::string& path) {
  file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
  if (!file) throw Error("reading " + path + " failed");
}

template <typename T>
void write_array(const OutputFile& file, const std::vector<std::size_t>& shape,
                 const std::vector<T>& values) {
  GrowingFile array(file);
  array << npy_header<T>(shape);
  array.write(values.data(), values.size() * sizeof(T));
  array.finish();
}

}  // namespace

NpyPoints::NpyPoints(const std::string& path, std::uint64_t most, std::size_t dimensions)
    : path_(path), file_(open_to_read(path)), dimensions_(dimensions) {
  const Header header = read_header(file_, path);
  if (header.shape.size() != 2 || header.shape[1] != dimensions) {
    throw Error(path + " has the shape " + to_string(header.shape) + "; points of a plane need (N, 2), and " +
                "those of a volume, which --size WxHxD asks for, (N, 3)");
  }
  size_ = header.shape[0];
  if (size_ == 0) throw Error(path + " holds no points");
  if (size_ > most) {
    throw Error(path + " holds " + std::to_string(size_) + " points; at most " + std::to_string(most) +
                " can be seeds");
  }
  begin_ = find_values(file_, header, dimensions * size_, path);
  type_ = header.type;
}

std::vector<double> NpyPoints::read_values(std::uint64_t first, std::size_t count) {
  const Type& type = types().at(type_);
  const std::size_t bytes_per_point = dimensions_ * type.size;
  std::vector<char> bytes(count * bytes_per_point);
  file_.seekg(static_cast<std::streamoff>(begin_ + first * bytes_per_point));
  read_bytes(file_, bytes.data(), bytes.size(), path_);
  std::vector<double> values(count * dimensions_);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = type.read(&bytes[i * type.size]);
  return values;
}

std::vector<Point> NpyPoints::read(std::uint64_t first, std::size_t count) {
  const std::vector<double> values = read_values(first, count);
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {values[2 * i], values[2 * i + 1]};
  return points;
}

std::vector<Point3> NpyPoints::read_of_volume(std::uint64_t first, std::size_t count) {
  const std::vector<double> values = read_values(first, count);
  std::vector<Point3> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return points;
}

std::vector<Point> read_npy_points(const std::string& path) {
  NpyPoints points(path, Window::max_pixels);
  return points.read(0, points.size());
}

std::vector<Point3> read_npy_points_of_volume(const std::string& path) {
  NpyPoints points(path, Window::max_pixels, 3);
  return points.read_of_volume(0, points.size());
}

namespace {

/// The size of an image that a header names. Throws Error if it is none, and says what it had to be.
/// Of the sides behind the first `skipped` ones.
Size size_of_image(const Header& header, bool has_type, const std::string& path, const std::string& wanted,
                   std::size_t skipped = 0) {
  const auto& shape = header.shape;
  const auto fits = [](std::size_t side) { return side >= 1 && side <= Size::max_side; };
  if (!has_type || shape.size() != skipped + 2 || !fits(shape[skipped]) || !fits(shape[skipped + 1])) {
    throw Error(path + " holds " + header.type + " of shape " + to_string(shape) + "; " + wanted +
                (skipped > 0 ? " of shape (depth, height, width)" : " of shape (height, width)") +
                ", with sides from 1 to " + std::to_string(Size::max_side));
  }
  return {static_cast<int>(shape[skipped + 1]), static_cast<int>(shape[skipped])};
}

}  // namespace

LabelImage read_npy_labels(const std::string& path) {
  std::ifstream file = open_to_read(path);
  const Header header = read_header(file, path);
  const auto& shape = header.shape;
  const bool is_volume = shape.size() == 3 && shape[0] >= 1 && shape[0] <= Window::max_side_of_volume;
  LabelImage image{
      size_of_image(header, header.type == "<u4", path, "labels are uint32 (<u4)", is_volume ? 1 : 0), {}, 1};
  if (is_volume) image.depth = static_cast<std::int64_t>(shape[0]);
  const std::size_t count = image.size.pixels() * static_cast<std::size_t>(image.depth);
  find_values(file, header, count, path);
  image.labels.resize(count);
  read_bytes(file, image.labels.data(), count * sizeof no_label, path);
  return image;
}

DensityImage read_npy_density(const std::string& path) {
  std::ifstream file = open_to_read(path);
  const Header header = read_header(file, path);
  DensityImage image{size_of_image(header, true, path, "a density has numbers"), {}};
  find_values(file, header, image.size.pixels(), path);
  const Type& type = types().at(header.type);
  std::vector<char> row(static_cast<std::size_t>(image.size.width()) * type.size);
  image.values.reserve(image.size.pixels());
  for (int y = 0; y < image.size.height(); ++y) {
    read_bytes(file, row.data(), row.size(), path);
    for (std::size_t at = 0; at < row.size(); at += type.size) {
      const auto value = static_cast<float>(type.read(&row[at]));
      if (!(value >= 0 && std::isfinite(value))) {
        throw Error(path + " holds " + std::to_string(value) + " at pixel (" +
                    std::to_string(at / type.size) + ", " + std::to_string(y) +
                    "); a density has finite numbers of at least 0");
      }
      image.values.push_back(value);
    }
  }
  return image;
}

template <typename T>
void write_npy(const OutputFile& file, const Size& size, const std::vector<T>& values) {
  const auto height = static_cast<std::size_t>(size.height()), width = static_cast<std::size_t>(size.width());
  write_array(file, {height, width}, values);
}

template void write_npy(const OutputFile&, const Size&, const std::vector<std::uint8_t>&);
template void write_npy(const OutputFile&, const Size&, const std::vector<std::uint32_t>&);
template void write_npy(const OutputFile&, const Size&, const std::vector<float>&);

template <typename T>
void write_npy_volume(const OutputFile& file, const VolumeSize& size, const std::vector<T>& values) {
  const auto side = [](std::int64_t voxels) { return static_cast<std::size_t>(voxels); };
  write_array(file, {side(size.depth), side(size.height), side(size.width)}, values);
}

template void write_npy_volume(const OutputFile&, const VolumeSize&, const std::vector<std::uint32_t>&);
template void write_npy_volume(const OutputFile&, const VolumeSize&, const std::vector<float>&);

template <typename T>
std::string npy_header(const std::vector<std::size_t>& shape) {
  std::string header = std::string("{'descr': '") + type_name<T> +
                       "', 'fortran_order': False, 'shape': " + to_string(shape) + ", }";
  // The values start at a multiple of 64 bytes: behind magic, version (2 bytes), length (2 bytes) and header.
  header.resize((magic_size + 4 + header.size() + 64) / 64 * 64 - magic_size - 5, ' ');
  header += '\n';
  const auto low = static_cast<char>(header.size() % 256), high = static_cast<char>(header.size() / 256);
  return std::string(magic, magic_size) + '\x01' + '\0' + low + high + header;
}

template std::string npy_header<std::uint32_t>(const std::vector<std::size_t>&);

void write_npy_points(const OutputFile& file, const std::vector<Point>& points) {
  std::vector<double> values;
  values.reserve(2 * points.size());
  for (const Point& point : points) values.insert(values.end(), {point.x, point.y});
  write_array(file, {points.size(), 2}, values);
}

}  // namespace vorocl::command
