// Label files: NPY and TIFF keep every value, are what other readers expect, and bad ones are refused.
#define BOOST_TEST_MODULE label_file
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "fixture.hpp"
#include "formats/files.hpp"
#include "formats/raster_files.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

/// 5 x 3 labels, among them all that a float or a signed integer would change.
const LabelImage example = {Size(5, 3),
                            {0, 1, 255, 256, 65535,                          //
                             65536, 16777215, 16777216, 16777217, 16777219,  //
                             2147483647u, 2147483648u, 2147483649u, 4294967294u, 4294967295u}};

}  // namespace

BOOST_AUTO_TEST_CASE(files_keep_every_label) {
  const TemporaryFolder folder;
  for (const char* name : {"a.npy", "a.tif", "a.TIFF"}) {
    write_labels(folder / name, example.size, example.labels);
    const LabelImage read = read_labels(folder / name);
    BOOST_TEST((read.size == example.size), name);
    BOOST_TEST(read.labels == example.labels, name);
  }
}

BOOST_AUTO_TEST_CASE(the_longest_sides_are_read) {
  const TemporaryFolder folder;
  for (const Size& size : {Size(32768, 1), Size(1, 32768)}) {
    for (const char* name : {"a.npy", "a.tif"}) {
      write_labels(folder / name, size, std::vector<std::uint32_t>(size.pixels(), 7));
      BOOST_TEST((read_labels(folder / name).size == size), name);
    }
  }
}

BOOST_AUTO_TEST_CASE(npy_files_are_what_numpy_writes) {
  const TemporaryFolder folder;
  write_labels(folder / "a.npy", example.size, example.labels);
  const std::string content = content_of(folder / "a.npy");
  // As numpy.save() of version 1.24 makes it, to the byte.
  std::string expected("\x93NUMPY\x01\x00v\x00", 10);
  expected += "{'descr': '<u4', 'fortran_order': False, 'shape': (3, 5), }";
  expected.resize(127, ' ');
  expected += '\n';
  BOOST_REQUIRE(content.size() == 128u + 60u);
  BOOST_TEST(content.substr(0, 128) == expected);
  BOOST_TEST(std::memcmp(content.data() + 128, example.labels.data(), 60) == 0);
}

BOOST_AUTO_TEST_CASE(opencv_reads_the_tiff_files) {
  const TemporaryFolder folder;
  write_labels(folder / "a.tif", example.size, example.labels);
  const cv::Mat image = cv::imread(folder / "a.tif", cv::IMREAD_UNCHANGED);
  BOOST_REQUIRE(image.type() == CV_32S);  // it has no unsigned type: the bits are the same
  BOOST_REQUIRE(image.size() == cv::Size(5, 3));
  BOOST_TEST(std::memcmp(image.data, example.labels.data(), 60) == 0);
}

BOOST_AUTO_TEST_CASE(tiff_files_of_others_are_read) {
  const TemporaryFolder folder;
  const cv::Mat image = (cv::Mat_<int>(2, 2) << 1, -1, 16777217, 7);
  cv::imwrite(folder / "a.tif", image, {cv::IMWRITE_TIFF_COMPRESSION, 5});  // LZW
  const std::vector<std::uint32_t> expected = {1, no_label, 16777217, 7};
  BOOST_TEST(read_labels(folder / "a.tif").labels == expected);

  // Unsigned samples: of our own file, with another value of the tag 339 (little-endian: tag, type, count,
  // value).
  write_labels(folder / "a.tif", example.size, example.labels);
  std::string content = content_of(folder / "a.tif");
  const auto tag = content.find(std::string("\x53\x01\x03\x00\x01\x00\x00\x00\x02\x00", 10));
  BOOST_REQUIRE(tag != std::string::npos);
  content[tag + 8] = 1;
  BOOST_TEST(read_labels(folder.file("a.tif", content)).labels == example.labels);
}

BOOST_AUTO_TEST_CASE(npy_files_of_other_whole_numbers_are_read) {
  const TemporaryFolder folder;
  write_labels(folder / "a.npy", example.size, example.labels);
  const std::string npy = content_of(folder / "a.npy"), values = npy.substr(128);
  const auto with_values = [&](const char* type, const std::string& bytes) {
    std::string content = npy.substr(0, 128);
    content.replace(content.find("<u4"), 3, type);
    return folder.file("b.npy", content + bytes);
  };
  std::string wide, turned;
  for (std::size_t at = 0; at < values.size(); at += 4) {
    wide += values.substr(at, 4) + std::string(4, '\0');
    turned += {values[at + 3], values[at + 2], values[at + 1], values[at]};
  }
  BOOST_TEST(read_labels(with_values("<i8", wide)).labels == example.labels);
  BOOST_TEST(read_labels(with_values("<i4", values)).labels == example.labels);  // -1 is no label
  BOOST_TEST(read_labels(with_values(">u4", turned)).labels == example.labels);
  wide[4] = 1;
  check_error([&] { read_labels(with_values("<i8", wide)); }, {"b.npy", "4294967296", "32 bits"});
}

BOOST_AUTO_TEST_CASE(bad_files_are_refused) {
  const TemporaryFolder folder;
  write_labels(folder / "a.npy", example.size, example.labels);
  write_labels(folder / "a.tif", example.size, example.labels);
  const std::string npy = content_of(folder / "a.npy"), tiff = content_of(folder / "a.tif");
  const auto refuses = [&](const std::string& name, const std::string& content,
                           std::initializer_list<std::string> parts) {
    folder.file(name, content);
    check_error([&] { read_labels(folder / name); }, parts);
  };
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string changed = npy;
    return changed.replace(npy.find(what), what.size(), by);
  };
  refuses("empty.npy", "", {"empty.npy", "no .npy array"});
  refuses("text.npy", "1,2,3,4,5,6,7,8,9,10,11,12", {"text.npy", "no .npy array"});
  refuses("header.npy", npy.substr(0, 50), {"header.npy", "header ends early"});
  refuses("short.npy", npy.substr(0, npy.size() - 1), {"short.npy", "ends early", "(3, 5)"});
  refuses("float.npy", replaced("<u4", "<f4"), {"float.npy", "no labels", "whole number"});
  refuses("line.npy", replaced("(3, 5)", "(15,) "), {"line.npy", "(15)", "(height, width)"});
  refuses("none.npy", replaced("(3, 5)", "(0, 5)"), {"none.npy", "(0, 5)"});
  refuses("huge.npy", replaced("(3, 5), }      ", "(30000, 30000)}"), {"huge.npy", "ends early"});
  refuses("text.tif", "labels", {"text.tif", "no image"});
  refuses("short.tif", tiff.substr(0, 40), {"short.tif", "damaged TIFF file"});
  cv::imwrite(folder / "colours.tif", cv::Mat(3, 3, CV_8UC3, cv::Scalar(1)));
  check_error([&] { read_labels(folder / "colours.tif"); }, {"colours.tif", "no labels"});
  write_pixels(folder / "float.tif", "float", Size(1, 1), std::vector<float>{1});
  check_error([&] { read_labels(folder / "float.tif"); }, {"float.tif", "no labels"});
  check_error([&] { read_labels(folder / "missing.npy"); }, {"missing.npy", "No such file"});
  check_error([&] { read_labels(folder / "missing.tif"); }, {"missing.tif", "No such file"});
  check_error([&] { write_labels(folder / "labels.png", Size(1, 1), {0}); }, {"labels.png", ".npy, .tif"});
}

BOOST_AUTO_TEST_CASE(a_file_appears_whole_or_not_at_all) {
  const TemporaryFolder folder;
  folder.file("a.txt", "old");
  const OutputFile output(folder / "a.txt");
  BOOST_TEST((folder.names() == std::set<std::string>{"a.txt"}));  // the check leaves nothing behind
  {
    GrowingFile half(output);
    half << "half";
    BOOST_TEST(content_of(folder / "a.txt") == "old");
  }
  BOOST_TEST((folder.names() == std::set<std::string>{"a.txt"}));
  BOOST_TEST(content_of(folder / "a.txt") == "old");
  GrowingFile whole(output);
  whole << "new";
  whole.finish();
  BOOST_TEST((folder.names() == std::set<std::string>{"a.txt"}));
  BOOST_TEST(content_of(folder / "a.txt") == "new");
}

BOOST_AUTO_TEST_CASE(outputs_that_cannot_be_written_are_refused_at_once) {
  const TemporaryFolder folder;
  check_error([&] { OutputFile(folder / "missing/a.png"); }, {"missing/a.png", "does not exist"});
  check_error([&] { OutputFile(folder / ""); }, {"it is a folder"});
  check_error([&] { OutputFile("/proc/a.png"); }, {"/proc/a.png", "no file can be made"});
}
