// Points of CSV and NPY files, and of masks.
#define BOOST_TEST_MODULE points
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "fixture.hpp"
#include "formats/csv.hpp"
#include "formats/images/pictures.hpp"
#include "formats/npy.hpp"
#include "formats/point_files.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

using Pairs = std::vector<std::pair<double, double>>;

Pairs pairs_of(const std::vector<Point>& points) {
  return transformed(points, [](const Point& point) { return std::pair(point.x, point.y); });
}

Pairs csv(const std::string& content, const std::optional<Columns>& columns = std::nullopt) {
  const TemporaryFolder folder;
  return pairs_of(read_csv(folder.file("p.csv", content), columns).points);
}

void refuses_csv(const std::string& content, std::initializer_list<std::string> parts,
                 const std::optional<Columns>& columns = std::nullopt) {
  check_error([&] { csv(content, columns); }, parts);
}

/// A .npy file of format version 1.
template <typename T>
std::string npy(const std::string& type, const std::string& shape, const std::vector<T>& values) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  const std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return std::string("\x93NUMPY\x01\x00v\x00", 10) + header + "\n" + bytes;
}

const Pairs two = {{1.5, -2}, {300, 0.25}};

}  // namespace

BOOST_AUTO_TEST_CASE(csv_files_are_read_in_all_their_variants) {
  BOOST_TEST((csv("x,y\n1.5,-2\n300,0.25\n") == two));
  BOOST_TEST((csv("1.5,-2\n300,0.25") == two));  // no header, no last line end
  BOOST_TEST((csv("\xef\xbb\xbfX , Y\r\n 1.5 ,\t-2\r\n\r\n+3e2,.25\r\n\r\n") == two));
  BOOST_TEST((csv("id,y,name,x\n1,-2,\"a, \"\"b\"\"\",1.5\n2,\"0.25\",c,300\n") == two));
  BOOST_TEST((csv("lon,lat\n1.5,-2\n300,0.25\n", Columns{"lon", "lat"}) == two));
  BOOST_TEST((csv("LON,lat\n1.5,-2\n300,0.25\n", Columns{"lon", "lat"}) == two));
  BOOST_TEST((csv("a,b,c\n-2,9,1.5\n0.25,9,300\n", Columns{"2", "0"}) == two));
  BOOST_TEST((csv("-2,9,1.5\n0.25,9,300\n", Columns{"2", "0"}) == two));
  BOOST_TEST((csv("1,0\n-2,1.5\n0.25,300\n", Columns{"1", "0"}) == Pairs{{0, 1}, {1.5, -2}, {300, 0.25}}));
}

BOOST_AUTO_TEST_CASE(the_world_s_cities_are_read) {
  const std::vector<Point> cities = read_csv(VOROCL_SAMPLES "/cities-5000.csv", std::nullopt).points;
  BOOST_REQUIRE(cities.size() == 5000u);
  BOOST_TEST(cities[0].x == 181.5665);
  BOOST_TEST(cities[0].y == 47.4682);
}

BOOST_AUTO_TEST_CASE(bad_csv_lines_are_named) {
  refuses_csv("x,y\n1,2\n\n3,abc\n", {"p.csv:4", "\"abc\" is not a number", "3,abc"});
  refuses_csv("1,2\n3,4 5\n", {"p.csv:2", "\"4 5\"", "3,4 5"});
  refuses_csv("1,2\n3\n", {"p.csv:2", "no column 1", "the line ends before it", ": 3"});
  refuses_csv("1,2\nnan,3\n", {"p.csv:2", "\"nan\" is not finite"});
  refuses_csv("x,y\n1,-inf\n", {"p.csv:2", "\"-inf\" is not finite"});
  // Commas at a line's end are no fields too many.
  BOOST_TEST((csv("x,y\n1,2,\n3,4,,\n") == Pairs{{1, 2}, {3, 4}}));
  // Decimal commas, which make other points of numbers.
  const std::string decimals = "decimals have a point, not a comma";
  refuses_csv("x,y\n1,5,2,5\n", {"p.csv:2", "4 fields where the first line has 2", decimals, ": 1,5,2,5"});
  refuses_csv("1,2\n1,5,2\n", {"p.csv:2", "3 fields where the first line has 2", decimals});
  refuses_csv("1,5,2,5\n3,1,4,2\n",
              {"p.csv:1", "4 columns without names", "--columns", decimals, ": 1,5,2,5"});
  BOOST_TEST((csv("1,2,\n3,4,\n") == Pairs{{1, 2}, {3, 4}}));
  refuses_csv("x,y\n\"1,5\",\"2,5\"\n", {"p.csv:2", "\"1,5\" is not a number", decimals});
  refuses_csv("x;y\n1,5;2,5\n", {"p.csv:1", "no column x; there are x;y", "separated by commas"});
  refuses_csv("1,2\n3,\n", {"p.csv:2", "\"\" is not a number"});
  refuses_csv("1,2\n3,\"4\n", {"p.csv:2", "quote"});
  refuses_csv("1,2\n3,1e999\n", {"p.csv:2", "1e999"});
  refuses_csv("lon,lat\n1,2\n", {"p.csv:1", "no column x", "lon,lat", "--columns"});
  refuses_csv("x,y\n1,2\n", {"p.csv:1", "no column 2"}, Columns{"x", "2"});
  refuses_csv("1,2\n", {"p.csv:1", "no column x"}, Columns{"x", "y"});
  refuses_csv("1,2\n" + std::string(1000, '\x01') + "\n", {"p.csv:2", std::string(80, '?')});
  refuses_csv("", {"p.csv", "no points"});
  refuses_csv("x,y\n\n", {"p.csv", "no points"});
  const TemporaryFolder folder;
  check_error([&] { read_csv(folder / "missing.csv", std::nullopt); }, {"missing.csv", "No such file"});
  check_error([&] { read_csv(folder / "", std::nullopt); }, {"it is a folder"});
}

BOOST_AUTO_TEST_CASE(csv_files_may_have_a_column_of_values) {
  const TemporaryFolder folder;
  const auto values = [&](const std::string& content, const std::string& column) {
    return read_csv(folder.file("p.csv", content), std::nullopt, column).values;
  };
  const std::string table = "x,name,y,Height\n1,a,2,-1.5\n3,b,4,\n5,c,6,nan\n7,d,8,+2e3\n";
  for (const char* column : {"Height", "height", "3"}) {
    const std::vector<double> found = values(table, column);
    BOOST_REQUIRE(found.size() == 4u);
    BOOST_TEST((found[0] == -1.5 && std::isnan(found[1]) && std::isnan(found[2]) && found[3] == 2000));
  }
  BOOST_TEST((values("1,2,3\n4,5,6\n", "2") == std::vector<double>{3, 6}));
  check_error([&] { values("1,5,2,5\n", "3"); }, {"p.csv:1", "4 columns without names"});
  BOOST_TEST((values("x,y\n4,5\n", "y") == std::vector<double>{5}));
  BOOST_TEST(values(table, "").empty());
  check_error([&] { values(table, "depth"); }, {"p.csv:1", "no column depth", "x, name, y, Height"});
  check_error([&] { values("1,2,3\n", "depth"); }, {"p.csv:1", "no column depth", "0, 1, 2"});
  check_error([&] { values(table, "name"); }, {"p.csv:2", "\"a\" is not a number"});
  check_error([&] { values("x,y,z\n1,2,3\n4,5\n", "z"); }, {"p.csv:3", "no column 2"});
}

BOOST_AUTO_TEST_CASE(columns_are_two) {
  BOOST_TEST(parse_columns(" a , b c").x == "a");
  BOOST_TEST(parse_columns(" a , b c").y == "b c");
  for (const char* bad : {"", "x", "x,", ",y", "x,y,z"})
    check_error([&] { parse_columns(bad); }, {"two columns"});
}

BOOST_AUTO_TEST_CASE(npy_files_of_many_types_are_read) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& content) {
    return pairs_of(read_npy_points(folder.file("p.npy", content)));
  };
  const Pairs whole = {{1, 2}, {100, 4}};
  BOOST_TEST((read(npy<double>("<f8", "(2, 2)", {1.5, -2, 300, 0.25})) == two));
  BOOST_TEST((read(npy<float>("<f4", "(2, 2)", {1.5f, -2, 300, 0.25f})) == two));
  BOOST_TEST((read(npy<std::int8_t>("|i1", "(2, 2)", {1, 2, 100, 4})) == whole));
  BOOST_TEST((read(npy<std::uint8_t>("|u1", "(2, 2)", {1, 2, 100, 4})) == whole));
  BOOST_TEST((read(npy<std::int16_t>("<i2", "(2, 2)", {1, 2, 100, 4})) == whole));
  BOOST_TEST((read(npy<std::uint16_t>("<u2", "(2, 2)", {1, 2, 100, 4})) == whole));
  BOOST_TEST((read(npy<std::int32_t>("<i4", "(2, 2)", {1, 2, 100, 4})) == whole));
  BOOST_TEST((read(npy<std::uint32_t>("<u4", "(1, 2)", {4294967295u, 0})) == Pairs{{4294967295.0, 0}}));
  BOOST_TEST((read(npy<std::int64_t>("<i8", "(1, 2)", {-1, 1ll << 40})) == Pairs{{-1, 1099511627776.0}}));
  BOOST_TEST((read(npy<std::uint64_t>("<u8", "(2, 2)", {1, 2, 100, 4})) == whole));
  std::string second = npy<double>("<f8", "(2, 2)", {1.5, -2, 300, 0.25});
  second.replace(6, 4, std::string("\x02\x00v\x00\x00\x00", 6));  // format version 2: four bytes of length
  BOOST_TEST((read(second) == two));
}

BOOST_AUTO_TEST_CASE(bad_npy_files_are_refused) {
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& content, std::initializer_list<std::string> parts) {
    folder.file("p.npy", content);
    check_error([&] { read_npy_points(folder / "p.npy"); }, parts);
  };
  const std::vector<double> values = {1, 2, 3, 4};
  refuses("", {"p.npy", "no .npy array"});
  refuses("x,y\n1,2\n3,4\n", {"p.npy", "no .npy array"});
  refuses(npy("<f8", "(3, 2)", values), {"p.npy", "ends early", "(3, 2)"});
  refuses(npy("<f8", "(4, 1)", values), {"p.npy", "(4, 1)", "(N, 2)"});
  refuses(npy("<f8", "(4,)", values), {"p.npy", "(4)", "(N, 2)"});
  refuses(npy("<f8", "(2, x)", values), {"p.npy", "shape"});
  refuses(npy("<f8", "(0, 2)", values), {"p.npy", "no points"});
  refuses(npy("<f8", "(1000000000, 2)", values), {"p.npy", "ends early"});
  refuses(npy("<f8", "(5000000000, 2)", values), {"p.npy", "5000000000 points", "1073741824"});
  refuses(npy(">f8", "(2, 2)", values), {"p.npy", ">f8", "little-endian"});
  refuses(npy("<c16", "(1, 2)", values), {"p.npy", "<c16"});
  check_error([&] { read_npy_points(folder / "missing.npy"); }, {"missing.npy", "No such file"});
}

BOOST_AUTO_TEST_CASE(files_are_read_in_blocks_that_are_the_whole) {
  const TemporaryFolder folder;
  std::vector<Point> points(150000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {static_cast<double>(i) / 8, 1e6 - static_cast<double>(i)};
  }
  for (const char* const name : {"p.csv", "p.npy"}) {
    write_points(folder / name, points, {});
    for (const std::uint64_t parts : {1u, 2u, 5u}) {
      std::vector<Point> read(points.size());
      std::size_t blocks = 0;
      for (std::uint64_t part = 0; part < parts; ++part) {
        read_in_blocks(folder / name, std::nullopt, {part, parts},
                       [&](std::uint64_t first, const std::vector<Point>& block) {
                         std::copy(block.begin(), block.end(),
                                   read.begin() + static_cast<std::ptrdiff_t>(first));
                         ++blocks;
                       });
      }
      BOOST_TEST((pairs_of(read) == pairs_of(points)), name);
      BOOST_TEST(blocks == 3u);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_file_that_changes_while_it_is_read_is_refused) {
  const TemporaryFolder folder;
  for (const std::string name : {"p.csv", "p.npy"}) {
    write_points(folder / name, {{1, 2}, {3, 4}}, {});
    const auto append = [&](std::uint64_t, const std::vector<Point>&) {
      std::ofstream(folder / name, std::ios::app) << "5,6,7\n";
    };
    check_error([&] { read_in_blocks(folder / name, std::nullopt, {}, append); },
                {name, "changed while it was read"});
  }
  mkfifo((folder / "f.csv").c_str(), 0600);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> writer(std::fopen((folder / "f.csv").c_str(), "r+"),
                                                               std::fclose);
  check_error([&] { read_in_blocks(folder / "f.csv", std::nullopt, {}, [](std::uint64_t, const auto&) {}); },
              {"it is a pipe"});
}

BOOST_AUTO_TEST_CASE(masks_count_every_colour_but_not_alpha) {
  const TemporaryFolder folder;
  cv::Mat image(2, 3, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  image.at<cv::Vec4b>(0, 2) = {1, 0, 0, 255};  // faint blue: grey 0.1
  image.at<cv::Vec4b>(1, 0) = {0, 0, 200, 0};
  cv::imwrite(folder / "m.png", image);
  const Mask mask = read_mask(folder / "m.png");
  BOOST_TEST((mask.size == Size(3, 2)));
  std::vector<bool> set;
  for (const std::uint8_t value : mask.pixels) set.push_back(value != 0);
  BOOST_TEST((set == std::vector<bool>{false, false, true, true, false, false}));

  cv::Mat deep(1, 2, CV_16U, cv::Scalar(0));
  deep.at<std::uint16_t>(0, 1) = 1;
  cv::imwrite(folder / "deep.png", deep);
  BOOST_TEST(read_mask(folder / "deep.png").pixels[1] != 0);
  BOOST_TEST(read_mask(folder / "deep.png").pixels[0] == 0);
}

BOOST_AUTO_TEST_CASE(bad_masks_are_refused) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "black.png", cv::Mat(3, 3, CV_8U, cv::Scalar(0)));
  check_error([&] { read_mask(folder / "black.png"); }, {"black.png", "no seed"});
  const std::string png = content_of(folder / "black.png");
  folder.file("cut.png", png.substr(0, png.size() / 2));
  check_error([&] { read_mask(folder / "cut.png"); }, {"cut.png", "no image"});
  folder.file("text.png", "x,y\n1,2\n");
  check_error([&] { read_mask(folder / "text.png"); }, {"text.png", "no image"});
  check_error([&] { read_mask(folder / "missing.png"); }, {"missing.png", "No such file"});
}

/// A TIFF file of two pixels in a row, each of three bands of 16 bits that it calls grey.
std::string tiff_of_bands(const std::array<std::uint16_t, 6>& values) {
  std::string bytes = "II*";
  const auto add_16 = [&bytes](unsigned value) {
    bytes += static_cast<char>(value & 255u);
    bytes += static_cast<char>(value >> 8);
  };
  const auto add_32 = [&add_16](unsigned value) {
    add_16(value & 0xffffu);
    add_16(value >> 16);
  };
  bytes += '\0';
  add_32(8);
  constexpr unsigned entries = 9, behind = 8 + 2 + 12 * entries + 4, bits_of_bands = 6;
  add_16(entries);
  const auto add_entry = [&](unsigned tag, unsigned count, unsigned value) {
    add_16(tag);
    add_16(3);  // of 16 bits
    add_32(count);
    add_32(value);
  };
  add_entry(256, 1, 2);       // width
  add_entry(257, 1, 1);       // height
  add_entry(258, 3, behind);  // where the bits of the bands stand
  add_entry(259, 1, 1);       // not compressed
  add_entry(262, 1, 1);       // grey, 0 is black
  add_entry(273, 1, behind + bits_of_bands);
  add_entry(277, 1, 3);  // bands
  add_entry(278, 1, 1);  // rows of a strip
  add_entry(279, 1, 12);
  add_32(0);
  for (int band = 0; band < 3; ++band) add_16(16);
  for (const std::uint16_t value : values) add_16(value);
  return bytes;
}

BOOST_AUTO_TEST_CASE(bands_that_are_called_grey_all_count) {
  const TemporaryFolder folder;
  folder.file("bands.tif", tiff_of_bands({0, 0, 0, 0, 0, 1}));
  const Mask mask = read_mask(folder / "bands.tif");
  BOOST_TEST(mask.pixels[0] == 0);
  BOOST_TEST(mask.pixels[1] != 0);
}
