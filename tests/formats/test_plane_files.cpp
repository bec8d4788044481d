// Files of planes: every tile is where other readers look for it, and what was kept of a file is gone on
// with.
#define BOOST_TEST_MODULE plane_files
#include <sys/stat.h>
#include <tiffio.h>
#include <zlib.h>

#include <cstring>
#include <functional>
#include <numeric>
#include <random>

#include "fixture.hpp"
#include "formats/planes/plane_file.hpp"
#include "formats/raster_files.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

namespace fs = std::filesystem;

/// A label for each pixel of the plane, some of them as large as can be.
std::uint32_t label_at(std::int64_t x, std::int64_t y) {
  return (x + y) % 7 == 0 ? no_label - static_cast<std::uint32_t>(x % 3)
                          : static_cast<std::uint32_t>(x / 5 + 1000 * (y / 3));
}

std::vector<std::uint32_t> labels_of(const Window& tile) {
  std::vector<std::uint32_t> labels;
  for (std::int64_t y = tile.y(); y < tile.y() + tile.height(); ++y) {
    for (std::int64_t x = tile.x(); x < tile.x() + tile.width(); ++x) labels.push_back(label_at(x, y));
  }
  return labels;
}

WrittenTile write_tile(PlaneFile& file, const Tiling& tiling, std::uint64_t number) {
  const Window tile = tiling.tile(number);
  const std::vector<std::uint32_t> labels = labels_of(tile);
  // The same bits are distances: kinds of files differ in what they say of them.
  return file.write({number, tile, labels.data(), reinterpret_cast<const float*>(labels.data())});
}

std::vector<std::uint64_t> numbers_of(const Tiling& tiling) {
  std::vector<std::uint64_t> numbers(tiling.count());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

void write_whole(const std::string& path, const Tiling& tiling, const std::vector<std::uint64_t>& numbers,
                 PlaneValues values = PlaneValues::labels) {
  const auto file = plane_file(path, tiling, values);
  file->open();
  for (const std::uint64_t number : numbers) write_tile(*file, tiling, number);
  file->finish();
}

/// The contents of a file, or of those of a folder, by their names.
std::map<std::string, std::string> contents_of(const std::string& path) {
  if (!fs::is_directory(path)) return {{"", content_of(path)}};
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::directory_iterator(path)) {
    contents[entry.path().filename().string()] = content_of(entry.path().string());
  }
  return contents;
}

/// What a reader gives for each pixel of the window.
using Reader = std::function<std::uint32_t(std::int64_t x, std::int64_t y)>;

void check_labels(const Tiling& tiling, const Reader& read) {
  const Window& part = tiling.window();
  std::size_t wrong = 0;
  for (std::int64_t y = 0; y < part.height(); ++y) {
    for (std::int64_t x = 0; x < part.width(); ++x)
      wrong += read(x, y) != label_at(part.x() + x, part.y() + y);
  }
  BOOST_TEST(wrong == 0u);
}

const std::vector<Tiling>& tilings() {
  static const std::vector<Tiling> all = {
      Tiling(Grid(100, 70), 32),
      Tiling(Grid(64, 64), 32),
      Tiling(Grid(5, 3), 16),
      Tiling(Grid(1, 200), 16),
      Tiling(Grid(400, 3), 64),
      Tiling(Window(Grid(2147483647, 2147483647), 2000000000, 2147483600, 50, 40), 16)};
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(npy_files_hold_every_label) {
  for (const Tiling& tiling : tilings()) {
    const TemporaryFolder folder;
    write_whole(folder / "a.npy", tiling, numbers_of(tiling));
    const LabelImage image = read_labels(folder / "a.npy");
    BOOST_TEST(image.size.width() == tiling.window().width());
    BOOST_TEST(image.size.height() == tiling.window().height());
    check_labels(tiling, [&](std::int64_t x, std::int64_t y) {
      return image.labels[static_cast<std::size_t>(y * image.size.width() + x)];
    });
    BOOST_TEST((folder.names() == std::set<std::string>{"a.npy"}));
  }
}

BOOST_AUTO_TEST_CASE(zarr_folders_hold_every_label) {
  for (const Tiling& tiling : tilings()) {
    const TemporaryFolder folder;
    write_whole(folder / "a.zarr", tiling, numbers_of(tiling));
    const auto contents = contents_of(folder / "a.zarr");
    BOOST_TEST(contents.size() == tiling.count() + 1);
    // No chunk is larger than the array.
    const auto width = std::min<std::int64_t>(tiling.side(), tiling.window().width());
    const auto height = std::min<std::int64_t>(tiling.side(), tiling.window().height());
    const std::string shape = "\"chunks\": [" + std::to_string(height) + ", " + std::to_string(width) + "]";
    BOOST_TEST(contents.at(".zarray").find(shape) != std::string::npos, contents.at(".zarray"));
    const auto pixels = static_cast<std::size_t>(width * height);
    std::map<std::string, std::vector<std::uint32_t>> chunks;
    for (const auto& [name, content] : contents) {
      if (name == ".zarray") continue;
      std::vector<std::uint32_t>& chunk = chunks[name] = std::vector<std::uint32_t>(pixels);
      uLongf bytes = pixels * 4;
      BOOST_TEST(uncompress(reinterpret_cast<Bytef*>(chunk.data()), &bytes,
                            reinterpret_cast<const Bytef*>(content.data()), content.size()) == Z_OK);
      BOOST_TEST(bytes == pixels * 4);
    }
    check_labels(tiling, [&](std::int64_t x, std::int64_t y) {
      const std::string name = std::to_string(y / height) + "." + std::to_string(x / width);
      return chunks.at(name)[static_cast<std::size_t>(y % height * width + x % width)];
    });
    // Beyond the plane there is the value that the array is filled with.
    if (tiling.window().width() % width != 0) {
      const auto& last = chunks.at("0." + std::to_string(tiling.columns() - 1));
      BOOST_TEST(last[static_cast<std::size_t>(width - 1)] == no_label);
    }
  }
}

BOOST_AUTO_TEST_CASE(tiff_files_hold_every_label) {
  for (const Tiling& tiling : tilings()) {
    const TemporaryFolder folder;
    write_whole(folder / "a.tif", tiling, numbers_of(tiling));
    BOOST_TEST(content_of(folder / "a.tif").substr(0, 3) == "II+");
    TIFF* const file = TIFFOpen((folder / "a.tif").c_str(), "r");
    BOOST_REQUIRE(file != nullptr);
    std::uint32_t width = 0, height = 0, tile_width = 0, tile_height = 0;
    std::uint16_t format = 0;
    TIFFGetField(file, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(file, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetField(file, TIFFTAG_TILEWIDTH, &tile_width);
    TIFFGetField(file, TIFFTAG_TILELENGTH, &tile_height);
    TIFFGetField(file, TIFFTAG_SAMPLEFORMAT, &format);
    BOOST_TEST(width == tiling.window().width());
    BOOST_TEST(height == tiling.window().height());
    const auto side = static_cast<std::uint32_t>(tiling.side());
    BOOST_TEST(tile_width == std::min(side, (width + 15) / 16 * 16));
    BOOST_TEST(tile_height == std::min(side, (height + 15) / 16 * 16));
    BOOST_TEST(format == SAMPLEFORMAT_UINT);
    std::vector<std::vector<std::uint32_t>> tiles;
    for (std::uint32_t number = 0; number < tiling.count(); ++number) {
      tiles.emplace_back(tile_width * tile_height);
      BOOST_TEST(TIFFReadEncodedTile(file, number, tiles.back().data(), -1) ==
                 static_cast<tmsize_t>(tile_width * tile_height * 4));
    }
    TIFFClose(file);
    check_labels(tiling, [&](std::int64_t x, std::int64_t y) {
      const std::int64_t across = tile_width, down = tile_height;
      const auto number =
          static_cast<std::uint64_t>(y / down) * tiling.columns() + static_cast<std::uint64_t>(x / across);
      return tiles[number][static_cast<std::size_t>(y % down * across + x % across)];
    });
  }
}

BOOST_AUTO_TEST_CASE(files_of_distances_are_those_of_labels_with_another_type) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    BOOST_REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
  };
  for (const Tiling& tiling : tilings()) {
    const TemporaryFolder folder;
    for (const std::string end : {".npy", ".zarr", ".tif"}) {
      write_whole(folder / "l" + end, tiling, numbers_of(tiling));
      write_whole(folder / "d" + end, tiling, numbers_of(tiling), PlaneValues::distances);
    }
    BOOST_TEST((content_of(folder / "d.npy") == replaced(content_of(folder / "l.npy"), "<u4", "<f4")));
    BOOST_TEST(content_of(folder / "d.zarr/.zarray") ==
               replaced(replaced(content_of(folder / "l.zarr/.zarray"), "<u4", "<f4"), "4294967295",
                        "\"Infinity\""));
    if (tiling.window().width() % tiling.side() == 0)
      BOOST_TEST(content_of(folder / "d.zarr/0.0") == content_of(folder / "l.zarr/0.0"));
    TIFF* const file = TIFFOpen((folder / "d.tif").c_str(), "r");
    BOOST_REQUIRE(file != nullptr);
    std::uint16_t format = 0;
    TIFFGetField(file, TIFFTAG_SAMPLEFORMAT, &format);
    BOOST_TEST(format == SAMPLEFORMAT_IEEEFP);
    TIFFClose(file);
  }
}

BOOST_AUTO_TEST_CASE(the_order_of_tiles_does_not_matter) {
  const Tiling tiling(Grid(100, 70), 16);
  std::vector<std::uint64_t> numbers = numbers_of(tiling);
  const TemporaryFolder folder;
  for (const char* const name : {"a.npy", "a.zarr"}) write_whole(folder / name, tiling, numbers);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(1));
  for (const std::string end : {".npy", ".zarr"}) {
    write_whole(folder / "b" + end, tiling, numbers);
    BOOST_TEST((contents_of(folder / "a" + end) == contents_of(folder / "b" + end)), end);
  }
}

BOOST_AUTO_TEST_CASE(what_was_kept_is_gone_on_with) {
  const Tiling tiling(Grid(100, 70), 32);
  for (const std::string end : {".npy", ".zarr", ".tif"}) {
    const TemporaryFolder folder;
    write_whole(folder / "whole" + end, tiling, numbers_of(tiling));
    // A run for each tile that is kept before the next one; each ends in the middle of another tile.
    KeptTiles kept;
    for (std::uint64_t complete = 0; complete <= tiling.count(); ++complete) {
      const auto file = plane_file(folder / "a" + end, tiling);
      file->open_part(complete == 0 ? std::nullopt : std::optional(kept));
      if (complete == tiling.count()) {
        file->finish();
        break;
      }
      kept.tiles.push_back(write_tile(*file, tiling, complete));
      file->sync();
      if (complete + 1 < tiling.count()) write_tile(*file, tiling, complete + 1);
      BOOST_TEST(!fs::exists(folder / "a" + end));
      BOOST_TEST(fs::exists(file->part_path()));
    }
    BOOST_TEST((contents_of(folder / "a" + end) == contents_of(folder / "whole" + end)), end);
    BOOST_TEST(!fs::exists(folder / "a" + end + ".part"));

    // A run that ended when this file had its name, and others had not.
    kept.is_complete = true;
    const auto file = plane_file(folder / "a" + end, tiling);
    file->open_part(kept);
    file->finish();
    BOOST_TEST((contents_of(folder / "a" + end) == contents_of(folder / "whole" + end)), end);
    BOOST_TEST(folder.names().size() == 2u);
  }
}

BOOST_AUTO_TEST_CASE(files_replace_those_that_are_there) {
  const Tiling tiling(Grid(100, 70), 32), other(Grid(30, 20), 16);
  for (const std::string end : {".npy", ".zarr", ".tif"}) {
    const TemporaryFolder folder;
    write_whole(folder / "whole" + end, tiling, numbers_of(tiling));
    write_whole(folder / "a" + end, other, numbers_of(other));
    write_whole(folder / "a" + end, tiling, numbers_of(tiling));
    BOOST_TEST((contents_of(folder / "a" + end) == contents_of(folder / "whole" + end)), end);
    BOOST_TEST(folder.names().size() == 2u);
  }
}

BOOST_AUTO_TEST_CASE(links_lead_to_what_is_replaced) {
  const Tiling tiling(Grid(100, 70), 32), other(Grid(30, 20), 16);
  for (const std::string end : {".npy", ".zarr", ".tif"}) {
    for (const bool resumes : {false, true}) {
      const TemporaryFolder folder;
      fs::create_directory(folder / "disk");
      write_whole(folder / "whole" + end, tiling, numbers_of(tiling));
      write_whole(folder / "disk/a" + end, other, numbers_of(other));
      fs::create_symlink("disk/a" + end, folder / "link" + end);
      const auto file = plane_file(folder / "link" + end, tiling);
      resumes ? file->open_part(std::nullopt) : file->open();
      for (const std::uint64_t number : numbers_of(tiling)) write_tile(*file, tiling, number);
      file->finish();
      BOOST_TEST(fs::is_symlink(folder / "link" + end), end);
      BOOST_TEST((contents_of(folder / "disk/a" + end) == contents_of(folder / "whole" + end)), end);
      BOOST_TEST(std::distance(fs::directory_iterator(folder / "disk"), fs::directory_iterator()) == 1);
    }
  }
}

BOOST_AUTO_TEST_CASE(arrays_with_other_files_are_not_replaced) {
  const Tiling tiling(Grid(100, 70), 32);
  for (const std::string other : {".zattrs", "notes.txt", "1.x", "1"}) {
    const TemporaryFolder folder;
    write_whole(folder / "a.zarr", tiling, numbers_of(tiling));
    folder.file("a.zarr/" + other, "mine");
    BOOST_CHECK_EXCEPTION(plane_file(folder / "a.zarr", tiling), Error, [&](const Error& error) {
      return std::string(error.what()).find("has " + other + " beside") != std::string::npos;
    });
    BOOST_TEST(content_of(folder / ("a.zarr/" + other)) == "mine");
  }
}

BOOST_AUTO_TEST_CASE(nothing_stays_of_what_is_not_finished) {
  const Tiling tiling(Grid(100, 70), 32);
  const TemporaryFolder folder;
  for (const char* const name : {"a.npy", "a.zarr", "a.tif"}) {
    const auto file = plane_file(folder / name, tiling);
    BOOST_TEST(folder.names().empty());
    file->open();
    write_tile(*file, tiling, 3);
    BOOST_TEST(folder.names().size() == 1u);
  }
  BOOST_TEST(folder.names().empty());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_is_refused) {
  const Tiling tiling(Grid(100, 70), 32), odd(Grid(100, 70), 100), huge(Grid(1000000000, 1000000000), 32768);
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& name, const Tiling& of, const std::string& part) {
    BOOST_CHECK_EXCEPTION(plane_file(folder / name, of), Error, [&](const Error& error) {
      BOOST_TEST_MESSAGE(error.what());
      return std::string(error.what()).find(part) != std::string::npos;
    });
  };
  refuses("a.vti", tiling, "the name must end in one of .npy, .zarr, .tif, .tiff");
  refuses("a.tif", odd, "multiples of 16, not 100");
  refuses("a.tif", Tiling(huge.window(), 16), "at most 2^32 - 1 tiles");
  for (const char* const name : {"a.npy", "a.zarr", "a.tif"}) {
    refuses(name, huge, "of disk space at least");
    refuses(std::string("none/") + name, tiling, "none does not exist");
  }
  fs::create_directory(folder / "a.zarr");
  refuses("a.zarr", tiling, "remove it");
  fs::create_directory_symlink(folder / "nowhere.zarr", folder / "link.zarr");
  refuses("link.zarr", tiling, "a link that leads nowhere");
  fs::create_directory(folder / "a.npy");
  refuses("a.npy", tiling, "it is a folder");
  mkfifo((folder / "b.tif").c_str(), 0600);
  refuses("b.tif", tiling, "a TIFF file needs a file");
}

BOOST_AUTO_TEST_CASE(parts_that_are_not_those_that_were_kept_are_refused) {
  const Tiling tiling(Grid(100, 70), 32);
  for (const std::string end : {".npy", ".zarr", ".tif"}) {
    const TemporaryFolder folder;
    KeptTiles kept;
    {
      const auto file = plane_file(folder / "a" + end, tiling);
      file->open_part(std::nullopt);
      kept.tiles.push_back(write_tile(*file, tiling, 0));
    }
    const auto begin = [&] { plane_file(folder / "a" + end, tiling)->open_part(std::nullopt); };
    BOOST_CHECK_THROW(begin(), Error);
    const auto go_on = [&] { plane_file(folder / "a" + end, tiling)->open_part(kept); };
    BOOST_CHECK_NO_THROW(go_on());
    fs::remove_all(folder / "a" + end + ".part");
    BOOST_CHECK_THROW(go_on(), Error);
    folder.file("a" + end + ".part", "mine");
    BOOST_CHECK_THROW(go_on(), Error);
    BOOST_TEST(content_of(folder / "a" + end + ".part") == "mine");
  }
}
