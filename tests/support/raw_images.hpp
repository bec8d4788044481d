// Straight parsers of the images that the command writes: .npy and .vti files of one value per pixel.
#pragma once

#include <boost/test/unit_test.hpp>
#include <cstring>
#include <regex>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace vorocl {

/// The first group of the pattern in the text.
inline std::string found_in(const std::string& text, const std::string& pattern) {
  std::smatch match;
  BOOST_TEST_REQUIRE(std::regex_search(text, match, std::regex(pattern)), pattern << " is not in " << text);
  return match[1];
}

template <typename T>
struct RawImage {
  std::string type;
  std::string name;  // none in .npy
  std::size_t width = 0, height = 0;
  std::vector<T> values;  // row-major, the first row on top
};

template <typename T>
std::vector<T> values_at(const std::string& content, std::size_t begin, std::size_t count) {
  BOOST_TEST_REQUIRE(content.size() >= begin + count * sizeof(T));
  std::vector<T> values(count);
  std::memcpy(values.data(), content.data() + begin, count * sizeof(T));
  return values;
}

template <typename T>
RawImage<T> read_raw_npy(const std::string& path) {
  const std::string content = content_of(path);
  BOOST_TEST_REQUIRE(content.size() > 128u, path);
  const std::string header = content.substr(0, content.find('\n') + 1);
  RawImage<T> image;
  image.type = found_in(header, "'descr': '([^']*)'");
  image.height = std::stoul(found_in(header, "\\(([0-9]+), [0-9]+\\)"));
  image.width = std::stoul(found_in(header, "\\([0-9]+, ([0-9]+)\\)"));
  image.values = values_at<T>(content, header.size(), image.width * image.height);
  BOOST_TEST(content.size() == header.size() + image.values.size() * sizeof(T));
  return image;
}

template <typename T>
RawImage<T> read_raw_vti(const std::string& path) {
  const std::string content = content_of(path);
  const std::size_t appended = content.find("<AppendedData encoding=\"raw\">");
  BOOST_TEST_REQUIRE(appended != std::string::npos, path);
  const std::string header = content.substr(0, appended);
  BOOST_TEST(found_in(header, "<VTKFile type=\"ImageData\"[^>]*byte_order=\"([^\"]*)\"") == "LittleEndian");
  BOOST_TEST(found_in(header, "header_type=\"([^\"]*)\"") == "UInt64");
  BOOST_TEST(found_in(header, "Origin=\"([^\"]*)\"") == "0 0 0");
  BOOST_TEST(found_in(header, "Spacing=\"([^\"]*)\"") == "1 1 1");
  BOOST_TEST(found_in(header, "format=\"([^\"]*)\"") == "appended");
  BOOST_TEST(found_in(header, "offset=\"([^\"]*)\"") == "0");
  const std::string extent = found_in(header, "<ImageData WholeExtent=\"([^\"]*)\"");
  BOOST_TEST(found_in(header, "<Piece Extent=\"([^\"]*)\"") == extent);
  RawImage<T> image;
  image.width = std::stoul(found_in(extent, "^0 ([0-9]+) 0 [0-9]+ 0 0$"));
  image.height = std::stoul(found_in(extent, "^0 [0-9]+ 0 ([0-9]+) 0 0$"));
  image.type = found_in(header, "<CellData[^>]*>\\s*<DataArray type=\"([^\"]*)\"");
  image.name = found_in(header, "<DataArray[^>]*Name=\"([^\"]*)\"");
  const std::size_t count = image.width * image.height, begin = content.find('_', appended) + 1;
  BOOST_TEST_REQUIRE(values_at<std::uint64_t>(content, begin, 1).front() == count * sizeof(T));
  image.values = values_at<T>(content, begin + 8, count);
  BOOST_TEST(content.substr(begin + 8 + count * sizeof(T)) == "\n  </AppendedData>\n</VTKFile>\n");
  return image;
}

}  // namespace vorocl
