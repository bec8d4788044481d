// Small files that claim to be large, or to be what they are not: refused, before memory is taken for them.
#define BOOST_TEST_MODULE large_claims
#include <sys/resource.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>

#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "run_command.hpp"

using namespace vorocl;

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string little_endian(std::uint32_t value, int size = 4) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

/// A TIFF file of one strip with these tags and four bytes of pixels.
std::string tiff(std::uint32_t side, std::uint32_t bits, std::uint32_t compression) {
  const std::pair<std::uint32_t, std::uint32_t> tags[] = {
      {256, side}, {257, side}, {258, bits}, {259, compression}, {262, 1},
      {273, 8},    {277, 1},    {278, side}, {279, 4},           {339, 1}};
  std::string file = std::string("II*\0", 4) + little_endian(12) + "abcd" + little_endian(10, 2);
  for (const auto& [tag, value] : tags)
    file += little_endian(tag, 2) + little_endian(4, 2) + little_endian(1) + little_endian(value);
  return file + little_endian(0);
}

/// A PNG file whose header says this, and that has no pixels. (OpenCV does not look at the sums of chunks
/// here.)
std::string png(std::uint32_t width, std::uint32_t height, char depth) {
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + big_endian(width) + big_endian(height) + depth +
         std::string(4, '\0') + big_endian(0) + big_endian(0) + "IEND" + big_endian(0xae426082);
}

std::string bmp(std::uint32_t width, std::uint32_t height) {
  return "BM" + little_endian(54) + little_endian(0) + little_endian(54) + little_endian(40) +
         little_endian(width) + little_endian(height) + little_endian(1, 2) + little_endian(24, 2) +
         std::string(24, '\0');
}

/// The most memory, in MiB, that any command has had so far.
long most_memory() {
  struct rusage usage = {};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss / 1024;
}

const std::string mask_options = " --method jfa --labels a.npy";

}  // namespace

BOOST_AUTO_TEST_CASE(small_files_take_little_memory) {
  const TemporaryFolder folder;
  const auto refuses_mask = [&](const std::string& name, const std::string& content,
                                std::initializer_list<std::string> parts) {
    folder.file(name, content);
    refuses(folder, "render --mask " + name + mask_options, failure, parts);
  };
  refuses_mask("a.png", png(32768, 32768, 8), {"a.png", "cannot hold 32768 x 32768 pixels"});
  refuses_mask("b.png", png(30000, 30000, 1), {"b.png", "cannot hold"});
  refuses_mask("c.png", png(32769, 32768, 8), {"c.png", "32769", "32768"});
  refuses_mask("d.png", png(2000000, 3, 8), {"d.png", "2000000"});
  refuses_mask("a.ppm", "P6\n# a comment\n30000 30000\n255\nabc", {"a.ppm", "cannot hold 30000 x 30000"});
  refuses_mask("a.pbm", "P4 30000 30000\nabc", {"a.pbm", "cannot hold"});
  refuses_mask("b.pbm", "P1 30000 30000\n1 0 1", {"b.pbm", "cannot hold"});
  refuses_mask("c.pgm", "P2 99999999999 3 255 1", {"c.pgm", "32768"});
  refuses_mask("a.bmp", bmp(30000, 30000), {"a.bmp", "cannot hold"});
  refuses_mask("b.bmp", bmp(30000, static_cast<std::uint32_t>(-30000)), {"b.bmp", "cannot hold"});
  refuses_mask("a.jpg",
               "\xff\xd8\xff\xc0" + std::string("\0\x0b\x08\x75\x30\x75\x30\x01\x01\x11\0", 11) +
                   std::string("\xff\xda\0\x02pixels\xff\xd9", 12),
               {"a.jpg", "cannot hold 30000 x 30000"});
  for (const std::uint32_t compression : {1u, 5u, 8u}) {
    refuses_mask("a.tif", tiff(30000, 8, compression), {"a.tif", "cannot hold 30000 x 30000"});
    folder.file("l.tif", tiff(32768, 32, compression));
    refuses(folder, "compare l.tif l.tif", failure, {"l.tif", "cannot hold 32768 x 32768"});
  }
  std::string properties = "Properties=pos:R:3";
  for (int i = 0; i < 1000; ++i) properties += ":a:R:65535";
  folder.file("a.xyz", "1\n" + properties + "\n1 2 3\n");
  refuses(folder, "render --trajectory a.xyz --size 9x9" + mask_options, failure,
          {"a.xyz:3", "3 fields where"});
  refuses(folder, "render --trajectory a.xyz --size 9x9 --color column:no --method jfa -o a.png", failure,
          {"a.xyz:2", "no column \"no\"", "pos[1], pos[2], pos[3], a[1]"});
  folder.file("commas.csv", "x,y\n1,2" + std::string(20 << 20, ',') + "\n");
  refuses(folder, "render --points commas.csv --size 9x9" + mask_options, failure,
          {"commas.csv:2", "mebibyte"});
  folder.file("columns.csv", std::string(1 << 19, ',') + "lat\n");
  refuses(folder, "render --points columns.csv --size 9x9" + mask_options, failure,
          {"columns.csv:1", "no column x"});
#ifndef __SANITIZE_ADDRESS__
  BOOST_TEST(most_memory() < 250);  // some 130 of them are libraries and the driver
#endif
}

BOOST_AUTO_TEST_CASE(files_of_an_unknown_kind_do_not_get_to_the_image_library) {
  const TemporaryFolder folder;
  for (const std::string& content :
       {std::string(128, '\0') + "DICM", std::string("GIF89a"), std::string("P8 1 1\n1"),
        std::string("RIFF    WEBPVP8 "), std::string(), std::string(1, '\xff')}) {
    folder.file("mask.png", content);
    refuses(folder, "render --mask mask.png" + mask_options, failure,
            {"mask.png", "no image", "neither a PNG"});
  }
}

BOOST_AUTO_TEST_CASE(headers_say_what_opencv_decodes) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.tif", "a.pbm", "a.pgm", "a.ppm"}) {
    for (const int type : {CV_8U, CV_8UC3, CV_16U}) {
      cv::Mat image(37, 1021, type, cv::Scalar::all(200));
      image.at<std::uint8_t>(20, 7) = 3;
      try {
        if (!cv::imwrite(folder / name, image)) continue;
      } catch (const cv::Exception&) {
        continue;  // no such pixels in this format
      }
      const std::string content = content_of(folder / name);
      const std::vector<std::uint8_t> bytes(content.begin(), content.end());
      const command::ImageHeader header = command::read_image_header(folder / name, bytes);
      const cv::Mat decoded = cv::imread(folder / name, cv::IMREAD_UNCHANGED);
      BOOST_TEST_CONTEXT(name << " of type " << type) {
        BOOST_TEST(header.width == decoded.cols);
        BOOST_TEST(header.height == decoded.rows);
        BOOST_TEST((command::diagram_size(name, header.width, header.height) == command::Size(1021, 37)));
        BOOST_CHECK_NO_THROW(command::check_pixels(name, header, bytes.size()));
        if (!header.is_compressed) {
          BOOST_TEST(header.bits_per_pixel * 1021 * 37 / 8 <= bytes.size());
          BOOST_TEST(header.bits_per_pixel * 1021 * 37 / 8 > bytes.size() * 9 / 10);
        }
      }
    }
  }
}

// The most that a PNG file of this size can hold: every pixel the same.
BOOST_AUTO_TEST_CASE(masks_that_are_packed_well_are_read) {
  const TemporaryFolder folder;
  cv::Mat mask(6000, 6000, CV_8U, cv::Scalar(0));
  mask.at<std::uint8_t>(0, 0) = 255;
  cv::imwrite(folder / "a.png", mask, {cv::IMWRITE_PNG_BILEVEL, 1, cv::IMWRITE_PNG_COMPRESSION, 9});
  cv::imwrite(folder / "b.png", mask, {cv::IMWRITE_PNG_COMPRESSION, 9});
  cv::imwrite(folder / "a.tif", mask, {cv::IMWRITE_TIFF_COMPRESSION, 8});
  for (const char* name : {"a.png", "b.png", "a.tif"}) {
    succeeds(folder, std::string("render --mask ") + name + " --method exact --labels a.npy");
  }
}

/// The most memory, in bytes, that this process has had.
std::size_t most_memory_here() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

BOOST_AUTO_TEST_CASE(grey_masks_take_two_bytes_per_pixel) {
  const TemporaryFolder folder;
  constexpr int side = 10000;
  {
    cv::Mat mask(side, side, CV_8U, cv::Scalar(0));
    mask.at<std::uint8_t>(side - 1, 7) = 1;
    cv::imwrite(folder / "a.png", mask);
    cv::imwrite(folder / "a.tif", mask, {cv::IMWRITE_TIFF_COMPRESSION, 8});
  }
  command::read_mask(folder / "a.png");  // what else it loads
  for (const char* name : {"a.png", "a.tif"}) {
    std::ofstream("/proc/self/clear_refs") << 5;  // counts the greatest memory anew
    const std::size_t before = most_memory_here();
    const command::Mask mask = command::read_mask(folder / name);
    BOOST_TEST(std::count(mask.pixels.begin(), mask.pixels.end(), 0) == side * side - 1);
    BOOST_TEST(mask.pixels[std::size_t{side - 1} * side + 7] != 0);
#ifndef __SANITIZE_ADDRESS__
    BOOST_TEST((most_memory_here() - before) / side / side < 3u, name);
#endif
  }
}

BOOST_AUTO_TEST_CASE(points_too_far_apart_or_too_near_to_compute_with_are_refused) {
  const TemporaryFolder folder;
  folder.file("far.csv", "-1e308,-1e308\n1e308,1e308\n");
  folder.file("half.csv", "0,0\n1e308,1\n");
  folder.file("near.csv", "0,0\n1e-320,1e-320\n");
  folder.file("far.xyz", "2\n\nAr -1e308 -1e308 0\nAr 1e308 1e308 0\n");
  for (const char* size : {" --size 9x9", " --width 9"}) {
    for (const char* input :
         {"--points far.csv", "--points half.csv", "--points near.csv", "--trajectory far.xyz"}) {
      refuses(folder, std::string("render ") + input + size + mask_options, failure, {"compute with"});
    }
  }
  folder.file("p.csv", "1,1\n");
  refuses(folder, "render --points p.csv --size 9x9 --bounds -1e308,-1e308,1e308,1e308" + mask_options,
          failure, {"compute with"});
}
