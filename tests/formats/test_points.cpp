// Points of CSV and NPY files, and of masks.
#define BOOST_TEST_MODULE points
#include <sys/stat.h>
#include <tiffio.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "fixture.hpp"
#include "formats/csv.hpp"
#include "formats/images/pictures.hpp"
#include "formats/npy.hpp"
#include "formats/point_files.hpp"
#include "formats/raster_files.hpp"
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
  return pairs_of(read_csv(folder.file("p.csv", content), {columns}).points);
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
  for (const char* x : {"lon", "lng", "Long", "longitude"}) {
    for (const char* y : {"lat", "Latitude"}) {
      const std::string text = std::string("x,y,") + x + "," + y + "\n1.5,-2,7,8\n300,0.25,9,9\n";
      BOOST_TEST((csv(text.substr(4, text.find('\n') - 3) + "1.5,-2\n300,0.25\n") == two));
      BOOST_TEST((csv(text) == two));  // on the globe degrees come first
      const TemporaryFolder folder;
      CsvOptions globe;
      globe.on_globe = true;
      BOOST_TEST((pairs_of(read_csv(folder.file("p.csv", text), globe).points) == Pairs{{7, 8}, {9, 9}}));
    }
  }
  BOOST_TEST((csv("a,b,c\n-2,9,1.5\n0.25,9,300\n", Columns{"2", "0"}) == two));
  BOOST_TEST((csv("-2,9,1.5\n0.25,9,300\n", Columns{"2", "0"}) == two));
  BOOST_TEST((csv("1,0\n-2,1.5\n0.25,300\n", Columns{"1", "0"}) == Pairs{{0, 1}, {1.5, -2}, {300, 0.25}}));
}

BOOST_AUTO_TEST_CASE(csv_files_of_other_programs_are_read) {
  BOOST_TEST(
      (csv("name,x,y\n5\" pipe,1.5,-2\n\"a\n\"\"b\"\",\",300,0.25\n") == two));  // pandas, QGIS; RFC 4180
  BOOST_TEST((csv("x,y\n1.5,-2\n,\n300,0.25\n,\n,\n") == two));                  // Excel's empty rows
  BOOST_TEST((csv("# of R\nx,y\n1.5,-2\n#300,1\n300,0.25\n") == two));
  BOOST_TEST((csv("#,x,y\n1,1.5,-2\n2,300,0.25\n") == two));
  BOOST_TEST((csv("x\ty\tz\n1.5\t-2\t\n300\t0.25\t7\n", Columns{"x", "y"}) == two));
  BOOST_TEST((csv("x;y\n1.5;-2\n300;0.25\n") == two));
  BOOST_TEST((csv("sep=|\nx|y\n1.5|-2\n300|0.25\n") == two));
  for (const char* const names : {"lon,lat", "Longitude,Latitude", "LNG,LAT", "X_COORD,Y_COORD", "long,lat"})
    BOOST_TEST((csv(names + std::string("\n1.5,-2\n300,0.25\n")) == two), names);
  const TemporaryFolder folder;
  const auto with_commas = [&](const std::string& content) {
    return pairs_of(read_csv(folder.file("p.csv", content), {{}, "", true}).points);
  };
  BOOST_TEST((with_commas("x;y\n1,5;-2\n300;0,25\n") == two));
  BOOST_TEST((with_commas("1,5\t-2\n300\t0,25\n") == two));
}

BOOST_AUTO_TEST_CASE(first_rows_that_name_columns_are_headers) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& content, const std::optional<Columns>& columns = std::nullopt) {
    return read_csv(folder.file("p.csv", content), {columns});
  };
  const std::string year = "name,x,y,1990\na,1.5,-2,5\nb,300,0.25,7\n";
  for (const std::optional<Columns>& columns :
       {std::optional<Columns>(), std::optional<Columns>({"x", "y"}), std::optional<Columns>({"1", "2"})}) {
    const CsvPoints points = read(year, columns);
    BOOST_TEST((pairs_of(points.points) == two));
    BOOST_TEST(points.notes.empty());
  }
  refuses_csv("a,b,nan\n1,2,3\n", {"p.csv:1", "no column x", "a, b, nan"});
  BOOST_TEST((pairs_of(read("nan,nan\n1.5,-2\n300,0.25\n").points) == two));
  BOOST_TEST((pairs_of(read("nan,x,inf,y\n0,1.5,0,-2\n0,300,0,0.25\n").points) == two));
  const CsvPoints of_years = read("1990,2000\n1.5,-2\n300,0.25\n", Columns{"1990", "2000"});
  BOOST_TEST((pairs_of(of_years.points) == two));
  BOOST_REQUIRE(of_years.notes.size() == 1u);
  BOOST_TEST(of_years.notes[0].find("1990,2000") != std::string::npos);
  for (const std::optional<Columns>& columns :
       {std::optional<Columns>(), std::optional<Columns>({"0", "1"})}) {
    const CsvPoints of_pandas = read("0,1\n1.5,-2\n300,0.25\n", columns);
    BOOST_TEST((pairs_of(of_pandas.points) == two));
    BOOST_REQUIRE(of_pandas.notes.size() == 1u);
    BOOST_TEST(of_pandas.notes[0].find("first row, 0,1,") != std::string::npos);
  }
  BOOST_TEST((pairs_of(read("NA,2\n1.5,-2\n300,0.25\n", Columns{"0", "1"}).points) == two));
}

BOOST_AUTO_TEST_CASE(rows_without_a_coordinate_are_absent_and_the_others_keep_their_numbers) {
  const TemporaryFolder folder;
  const CsvPoints read =
      read_csv(folder.file("p.csv", "x,y,v\nNA,1,2\n1.5,-2,NA\nnan,nan,3\n,null,4\n300,0.25,5\n"), {{}, "v"});
  BOOST_TEST((pairs_of(read.points) == two));
  BOOST_TEST((read.ids == std::vector<std::uint32_t>{1, 4}));
  BOOST_TEST((std::isnan(read.values.numbers[0]) && read.values.numbers[1] == 5));
  BOOST_REQUIRE(read.notes.size() == 1u);
  BOOST_TEST(read.notes[0].find("3 of 5 rows") != std::string::npos);
  refuses_csv("x,y\nNA,NA\n", {"p.csv", "no points", "coordinate"});
}

BOOST_AUTO_TEST_CASE(a_column_of_ids_names_the_points) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& content) {
    return read_csv(folder.file("p.csv", content), {{}, "v", false, {"name", "v"}});
  };
  const CsvPoints by_id = read("name,ID,x,y,v\n\"a, b\",90,300,0.25,1\nc,70,1.5,-2,2\nd,80,NA,1,3\n");
  BOOST_TEST((pairs_of(by_id.points) == two));
  BOOST_TEST((by_id.ids == std::vector<std::uint32_t>{70, 90}));
  BOOST_TEST((by_id.values.numbers == std::vector<double>{2, 1}));
  BOOST_TEST((by_id.kept == std::vector<CsvFields>{{"c", "2"}, {"a, b", "1"}}));
  BOOST_TEST((by_id.kept_names == CsvFields{"name", "v"}));
  for (const char* const bad : {"70", "a", "-1", "4294967295", "1.5", ""}) {
    const CsvPoints by_row = read("name,id,x,y,v\na,70,1.5,-2,1\nb," + std::string(bad) + ",300,0.25,2\n");
    BOOST_TEST(by_row.ids.empty(), bad);
    BOOST_TEST((pairs_of(by_row.points) == two), bad);
    BOOST_REQUIRE(by_row.notes.size() == 1u);
    BOOST_TEST(by_row.notes[0].find("number the rows") != std::string::npos);
  }
  const CsvPoints all = read_csv(folder.file("p.csv", "x,a,y,,b\n1,2,3,4,5\n"), {{}, "", false, {"all"}});
  BOOST_TEST((all.kept_names == CsvFields{"a", "b"}));  // besides those that say where it is
  BOOST_TEST((all.kept == std::vector<CsvFields>{{"2", "5"}}));
  check_error([&] { read("x,y,v\n1,2,3\n"); }, {"no column name"});
}

BOOST_AUTO_TEST_CASE(the_world_s_cities_are_read) {
  const std::vector<Point> cities = read_csv(VOROCL_SAMPLES "/cities-5000.csv", {}).points;
  BOOST_REQUIRE(cities.size() == 5000u);
  BOOST_TEST(cities[0].x == 1.5665);
  BOOST_TEST(cities[0].y == 42.5318);
}

BOOST_AUTO_TEST_CASE(bad_csv_lines_are_named) {
  refuses_csv("x,y\n1,2\n\n3,abc\n", {"p.csv:4", "\"abc\" is not a number", "3,abc"});
  refuses_csv("1,2\n3,4 5\n", {"p.csv:2", "\"4 5\"", "3,4 5"});
  refuses_csv("1,2\n3\n", {"p.csv:2", "no column 1", "the line ends before it", ": 3"});
  refuses_csv("x,y\n1,-inf\n", {"p.csv:2", "\"-inf\" is not finite"});
  // Commas at a line's end are no fields too many.
  BOOST_TEST((csv("x,y\n1,2,\n3,4,,\n") == Pairs{{1, 2}, {3, 4}}));
  // Decimal commas, which make other points of numbers.
  const std::string decimals = "decimals have a point, or with --decimal , a comma";
  refuses_csv("x,y\n1,5,2,5\n", {"p.csv:2", "4 fields where the first line has 2", decimals, ": 1,5,2,5"});
  refuses_csv("1,2\n1,5,2\n", {"p.csv:2", "3 fields where the first line has 2", decimals});
  refuses_csv("1,5,2,5\n3,1,4,2\n",
              {"p.csv:1", "4 columns without names", "--columns", decimals, ": 1,5,2,5"});
  BOOST_TEST((csv("1,2,\n3,4,\n") == Pairs{{1, 2}, {3, 4}}));
  refuses_csv("x,y\n\"1,5\",\"2,5\"\n", {"p.csv:2", "\"1,5\" is not a number", decimals});
  refuses_csv("x;y\n1,5;2,5\n", {"p.csv:2", "\"1,5\" is not a number", decimals});
  refuses_csv("1,2\n3,\"4\n", {"p.csv:2", "quote"});
  refuses_csv("1,2\n3,\"4\n" + std::string(2000, '\n'), {"p.csv:2", "quote"});
  refuses_csv("1,2\n3,1e999\n", {"p.csv:2", "1e999"});
  refuses_csv("a,lat\n1,2\n", {"p.csv:1", "no column x", "a,lat", "--columns"});
  refuses_csv("x,y\n1,2\n", {"p.csv:1", "no column 2"}, Columns{"x", "2"});
  refuses_csv("1,2\n", {"p.csv:1", "no column x"}, Columns{"x", "y"});
  refuses_csv("1,2\n" + std::string(1000, '\x01') + "\n", {"p.csv:2", std::string(80, '?')});
  refuses_csv("", {"p.csv", "no points"});
  refuses_csv("x,y\n\n", {"p.csv", "no points"});
  const TemporaryFolder folder;
  check_error([&] { read_csv(folder / "missing.csv", {}); }, {"missing.csv", "No such file"});
  check_error([&] { read_csv(folder / "", {}); }, {"it is a folder"});
}

BOOST_AUTO_TEST_CASE(csv_files_may_have_a_column_of_values) {
  const TemporaryFolder folder;
  const auto values = [&](const std::string& content, const std::string& column) {
    return read_csv(folder.file("p.csv", content), {{}, column}).values.numbers;
  };
  const std::string table = "x,name,y,Height\n1,a,2,-1.5\n3,b,4,\n5,c,6,nan\n7,d,8,+2e3\n";
  for (const char* column : {"Height", "height", "3"}) {
    const std::vector<double> found = values(table, column);
    BOOST_REQUIRE(found.size() == 4u);
    BOOST_TEST((found[0] == -1.5 && std::isnan(found[1]) && std::isnan(found[2]) && found[3] == 2000));
  }
  BOOST_TEST((values("1,2,3\n4,5,6\n", "2") == std::vector<double>{3, 6}));
  check_error([&] { read_csv(folder.file("p.csv", "1,2,3\n"), {}); },
              {"choose two", "three with --exact", "WxHxD"});
  check_error([&] { values("1,5,2,5\n", "3"); }, {"p.csv:1", "4 columns without names"});
  BOOST_TEST((values("x,y\n4,5\n", "y") == std::vector<double>{5}));
  BOOST_TEST(values(table, "").empty());
  check_error([&] { values(table, "depth"); }, {"p.csv:1", "no column depth", "x, name, y, Height"});
  check_error([&] { values("1,2,3\n", "depth"); }, {"p.csv:1", "no column depth", "0, 1, 2"});
  BOOST_TEST((values("x,y,name\n1,2,b\n3,4,a\n5,6,b\n", "name") == std::vector<double>{1, 0, 1}));
  BOOST_TEST((values("x,y,v\n1,2,1e400\n3,4,-1e400\n5,6,1e-400\n", "v") ==
              std::vector<double>{HUGE_VAL, -HUGE_VAL, 0}));
  refuses_csv("x,y\n1,1e400\n", {"p.csv:2", "\"1e400\" is not finite"});
  check_error(
      [&] {
        read_csv(folder.file("p.csv", table), {{}, "", false, {"name", "1"}});
      },
      {"p.csv:1", "column 1 is to be kept twice"});
  check_error([&] { values("x,y,name\n1,2,3\n3,4,a\n", "name"); }, {"p.csv:3", "\"a\" is not a number"});
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
  // Big endian, and in Fortran order: all x, then all y.
  BOOST_TEST((read(npy<std::uint16_t>(">u2", "(2, 2)", {0x0100, 0x0200, 0x6400, 0x0400})) == whole));
  std::string columns = npy<double>("<f8", "(3, 2)", {1, 2, 3, 4, 5, 6});
  columns.replace(columns.find("False"), 5, "True ");
  BOOST_TEST((read(columns) == Pairs{{1, 4}, {2, 5}, {3, 6}}));
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
        read_in_blocks(folder / name, {}, {part, parts}, [&](std::uint64_t first, const Block& block) {
          for (const std::optional<Point>& point : block) read[first++] = point.value();
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
    const auto append = [&](std::uint64_t, const Block&) {
      std::ofstream(folder / name, std::ios::app) << "5,6,7\n";
    };
    check_error([&] { read_in_blocks(folder / name, {}, {}, append); }, {name, "changed while it was read"});
  }
  mkfifo((folder / "f.csv").c_str(), 0600);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> writer(std::fopen((folder / "f.csv").c_str(), "r+"),
                                                               std::fclose);
  check_error([&] { read_in_blocks(folder / "f.csv", {}, {}, [](std::uint64_t, const auto&) {}); },
              {"it is a pipe"});
}

BOOST_AUTO_TEST_CASE(masks_count_every_colour_where_it_is_not_transparent) {
  const TemporaryFolder folder;
  cv::Mat image(2, 3, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  image.at<cv::Vec4b>(0, 2) = {1, 0, 0, 255};  // faint blue: grey 0.1
  image.at<cv::Vec4b>(1, 0) = {0, 0, 200, 1};
  image.at<cv::Vec4b>(1, 1) = {0, 0, 200, 0};
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

namespace {

using Pixels = std::vector<std::uint8_t>;

Pixels pixels_of(const std::string& path, std::optional<double> threshold = std::nullopt) {
  return read_mask(path, threshold).pixels;
}

/// A TIFF file by its library, of these samples; `set` sets other tags than those of the size and the type.
template <typename T>
std::string write_samples(const std::string& path, std::uint32_t width, std::uint32_t height,
                          std::vector<T> samples, const std::function<void(TIFF*)>& set = {}) {
  TIFF* const file = TIFFOpen(path.c_str(), "w");
  const bool is_float = std::is_floating_point_v<T>;
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(T));
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (set) set(file);
  const std::size_t row = samples.size() / height;
  for (std::uint32_t y = 0; y < height; ++y) TIFFWriteScanline(file, &samples[y * row], y, 0);
  TIFFClose(file);
  return path;
}

void set_no_data(TIFF* file, const char* text) {
  static char name[] = "GDALNoData";
  static const TIFFFieldInfo tag = {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, name};
  TIFFMergeFieldInfo(file, &tag, 1);
  TIFFSetField(file, 42113, text);
}

}  // namespace

BOOST_AUTO_TEST_CASE(nan_is_no_data_of_masks_of_every_width) {
  const TemporaryFolder folder;
  for (const int width : {1, 3, 8, 16, 17, 32, 40}) {
    std::vector<float> values(static_cast<std::size_t>(width) * 5, std::nanf(""));
    Pixels expected(values.size(), 0);
    values[2 * static_cast<std::size_t>(width)] = 0.25F;
    expected[2 * static_cast<std::size_t>(width)] = 1;
    values.back() = -2;
    expected.back() = 1;
    write_pixels(folder / "m.tif", "m", Size(width, 5), values);
    write_pixels(folder / "m.npy", "m", Size(width, 5), values);
    for (const char* const name : {"m.tif", "m.npy"}) BOOST_TEST(pixels_of(folder / name) == expected, name);
  }
}

BOOST_AUTO_TEST_CASE(masks_leave_out_what_the_file_says_is_no_data) {
  const TemporaryFolder folder;
  const std::string of_floats = write_samples<float>(folder / "f.tif", 3, 2, {-9999, 0, 1, 0.5F, -9999, -1},
                                                     [](TIFF* file) { set_no_data(file, "-9999"); });
  BOOST_TEST((pixels_of(of_floats) == Pixels{0, 0, 1, 1, 0, 1}));
  BOOST_TEST((pixels_of(of_floats, -2.0) == Pixels{0, 1, 1, 1, 0, 1}));
  const std::string rounded =
      write_samples<float>(folder / "r.tif", 2, 1, {-3.4028235e+38F, 1},
                           [](TIFF* file) { set_no_data(file, "-3.402823466e+38 "); });
  BOOST_TEST((pixels_of(rounded) == Pixels{0, 1}));
  const std::string of_bytes = write_samples<std::uint8_t>(folder / "b.tif", 3, 1, {255, 0, 7},
                                                           [](TIFF* file) { set_no_data(file, "255"); });
  BOOST_TEST((pixels_of(of_bytes) == Pixels{0, 0, 1}));
  BOOST_TEST((read_density(of_bytes).values == std::vector<float>{0, 255, 248}));
}

BOOST_AUTO_TEST_CASE(tiff_masks_have_the_stored_numbers_of_every_type) {
  const TemporaryFolder folder;
  const Pixels two_of_six = {0, 1, 0, 0, 0, 1};
  BOOST_TEST((pixels_of(write_samples<std::uint32_t>(folder / "a.tif", 3, 2, {0, 70000, 0, 0, 0, 1})) ==
              two_of_six));
  BOOST_TEST((pixels_of(write_samples<std::uint64_t>(folder / "a.tif", 3, 2, {0, 1ull << 40, 0, 0, 0, 1})) ==
              two_of_six));
  BOOST_TEST(
      (pixels_of(write_samples<double>(folder / "a.tif", 3, 2, {0, 1e-300, 0, 0, -0.0, 1})) == two_of_six));
  const auto invert = [](TIFF* file) { TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISWHITE); };
  const Mask inverted =
      read_mask(write_samples<std::uint8_t>(folder / "a.tif", 3, 2, {0, 255, 0, 0, 0, 255}, invert));
  BOOST_TEST(inverted.pixels == two_of_six);
  BOOST_REQUIRE(inverted.notes.size() == 1u);
  BOOST_TEST(inverted.notes[0].find("0 is shown as white") != std::string::npos);
  BOOST_TEST((read_density(folder / "a.tif").values == std::vector<float>{0, 255, 0, 0, 0, 255}));
  const auto complex = [](TIFF* file) {
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_COMPLEXIEEEFP);
  };
  const std::string of_complex =
      write_samples<std::uint64_t>(folder / "a.tif", 3, 2, {0, 1, 0, 0, 0, 1}, complex);
  BOOST_CHECK_THROW(read_mask(of_complex), Error);
  const auto bits = [](TIFF* file) { TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 1); };
  const Pixels of_bits = pixels_of(write_samples<std::uint8_t>(folder / "a.tif", 10, 1, {0x81, 0x40}, bits));
  BOOST_TEST((of_bits == Pixels{1, 0, 0, 0, 0, 0, 0, 1, 0, 1}));
}

BOOST_AUTO_TEST_CASE(tiff_bands_may_stand_apart_in_tiles_and_be_alpha) {
  const TemporaryFolder folder;
  const auto in_planes = [](TIFF* file) {
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 2);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_SEPARATE);
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 1);
    const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &alpha);
  };
  TIFF* file = TIFFOpen((folder / "planes.tif").c_str(), "w");
  for (const auto& [tag, value] : {std::pair(TIFFTAG_IMAGEWIDTH, 3), std::pair(TIFFTAG_IMAGELENGTH, 2),
                                   std::pair(TIFFTAG_BITSPERSAMPLE, 8)}) {
    TIFFSetField(file, static_cast<std::uint32_t>(tag), value);
  }
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  in_planes(file);
  std::uint8_t grey[] = {9, 0, 9, 0, 9, 0}, alpha[] = {0, 255, 255, 0, 51, 255};
  for (std::uint32_t y = 0; y < 2; ++y) {
    TIFFWriteScanline(file, grey + 3 * y, y, 0);
    TIFFWriteScanline(file, alpha + 3 * y, y, 1);
  }
  TIFFClose(file);
  BOOST_TEST((pixels_of(folder / "planes.tif") == Pixels{0, 0, 1, 0, 1, 0}));
  const std::vector<float> weights = read_density(folder / "planes.tif").values;
  BOOST_TEST((weights[0] == 0 && weights[1] == 255 && weights[2] == 246));
  BOOST_TEST(weights[4] == 246 / 5.0F, boost::test_tools::tolerance(1e-6F));

  file = TIFFOpen((folder / "tiles.tif").c_str(), "w");
  constexpr std::uint32_t width = 37, height = 21, side = 16;
  for (const auto& [tag, value] :
       {std::pair(TIFFTAG_IMAGEWIDTH, width), std::pair(TIFFTAG_IMAGELENGTH, height),
        std::pair(TIFFTAG_TILEWIDTH, side), std::pair(TIFFTAG_TILELENGTH, side)}) {
    TIFFSetField(file, static_cast<std::uint32_t>(tag), value);
  }
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 16);
  TIFFSetField(file, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
  for (std::uint32_t y = 0; y < height; y += side) {
    for (std::uint32_t x = 0; x < width; x += side) {
      std::vector<std::uint16_t> tile;
      for (std::uint32_t i = 0; i < side * side; ++i)
        tile.push_back(static_cast<std::uint16_t>(1000 * (y + i / side) + x + i % side));
      TIFFWriteTile(file, tile.data(), x, y, 0, 0);
    }
  }
  TIFFClose(file);
  const LabelImage image = read_labels(folder / "tiles.tif");
  BOOST_TEST((image.size == Size(width, height)));
  for (std::uint32_t i = 0; i < width * height; ++i)
    BOOST_REQUIRE(image.labels[i] == 1000 * (i / width) + i % width);
}

BOOST_AUTO_TEST_CASE(what_is_dropped_of_a_mask_or_spoilt_is_said) {
  const TemporaryFolder folder;
  TIFF* const file = TIFFOpen((folder / "pages.tif").c_str(), "w");
  for (std::uint8_t page = 0; page < 3; ++page) {
    for (const auto& [tag, value] : {std::pair(TIFFTAG_IMAGEWIDTH, 1), std::pair(TIFFTAG_IMAGELENGTH, 1),
                                     std::pair(TIFFTAG_BITSPERSAMPLE, 8)}) {
      TIFFSetField(file, static_cast<std::uint32_t>(tag), value);
    }
    // The last is a smaller copy of another, which is nothing that is left out.
    TIFFSetField(file, TIFFTAG_SUBFILETYPE, page == 2 ? FILETYPE_REDUCEDIMAGE : 0);
    std::uint8_t value = 1;
    TIFFWriteScanline(file, &value, 0, 0);
    TIFFWriteDirectory(file);
  }
  TIFFClose(file);
  const Mask mask = read_mask(folder / "pages.tif");
  BOOST_REQUIRE(mask.notes.size() == 1u);
  BOOST_TEST(mask.notes[0].find("of 2 pages the first") != std::string::npos);

  cv::Mat dots(40, 40, CV_8U, cv::Scalar(0));
  dots(cv::Rect(8, 9, 10, 10)) = 255;
  cv::imwrite(folder / "dots.jpg", dots, {cv::IMWRITE_JPEG_QUALITY, 60});
  const Mask spoilt = read_mask(folder / "dots.jpg"), clear = read_mask(folder / "dots.jpg", 127.0);
  BOOST_TEST(std::count(spoilt.pixels.begin(), spoilt.pixels.end(), 0) < 1500);
  BOOST_TEST(std::count(clear.pixels.begin(), clear.pixels.end(), 0) == 1500);
  BOOST_REQUIRE(spoilt.notes.size() == 1u);
  BOOST_TEST(spoilt.notes[0].find("--threshold") != std::string::npos);
  BOOST_TEST(clear.notes.empty());

  // A JPEG that ends early, one that is closed there, and one with other bytes.
  cv::RNG random(1);
  cv::Mat noise(64, 64, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (const int is_progressive : {0, 1}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", noise, bytes, {cv::IMWRITE_JPEG_PROGRESSIVE, is_progressive});
    const std::string whole(bytes.begin(), bytes.end());
    folder.file("whole.jpg", whole + "and what a camera adds");
    BOOST_TEST(read_mask(folder / "whole.jpg", 127.0).notes.empty());
    for (std::size_t end = whole.size() - 1; end > 3; end -= std::min<std::size_t>(end, 97)) {
      folder.file("cut.jpg", whole.substr(0, end));
      check_error([&] { read_mask(folder / "cut.jpg", 127.0); }, {"cut.jpg", "its end is missing"});
    }
    folder.file("closed.jpg", whole.substr(0, whole.size() / 2) + "\xff\xd9");
    if (is_progressive == 0) check_error([&] { read_mask(folder / "closed.jpg", 127.0); }, {"is damaged"});
    folder.file("bad.jpg", std::string(whole).replace(whole.size() / 2, 40, 40, '\0'));
    check_error([&] { read_mask(folder / "bad.jpg", 127.0); }, {"bad.jpg", "is damaged"});
  }

  const auto seven = [](TIFF* of) { TIFFSetField(of, TIFFTAG_SAMPLESPERPIXEL, 7); };
  write_samples<std::uint8_t>(folder / "bands.tif", 1, 1, Pixels(7, 1), seven);
  check_error([&] { read_mask(folder / "bands.tif"); }, {"bands.tif", "7 bands"});
}

BOOST_AUTO_TEST_CASE(masks_are_read_from_arrays_of_every_type) {
  const TemporaryFolder folder;
  const Pixels expected = {0, 1, 0, 1, 1, 0};
  const auto read = [&](const std::string& content) { return pixels_of(folder.file("m.npy", content)); };
  BOOST_TEST((read(npy<std::uint8_t>("|b1", "(2, 3)", {0, 1, 0, 1, 1, 0})) == expected));
  BOOST_TEST((read(npy<std::int64_t>("<i8", "(2, 3)", {0, -1, 0, 1ll << 40, 5, 0})) == expected));
  std::string columns = npy<std::uint8_t>("|u1", "(2, 3)", {0, 1, 1, 1, 0, 0});
  columns.replace(columns.find("False"), 5, "True ");
  BOOST_TEST((read(columns) == expected));
  check_error([&] { read(npy<std::uint8_t>("|u1", "(2, 1, 3)", {1, 1, 1, 1, 1, 1})); }, {"volume"});
}
