// A file whose size is known before it is written, in pieces that have their places.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"

namespace vorocl::command {

/// Its functions are those that PlaneFile has of these names.
class PlacedFile {
 public:
  /// Throws Error as OutputFile, for a pipe or a device, and if the disk has too little space.
  PlacedFile(const std::string& path, std::uint64_t bytes);

  void open();
  void open_part(const std::optional<KeptTiles>& kept);
  std::string part_path() const { return output_.part_path(); }
  void join();
  void write(std::uint64_t place, const void* bytes, std::size_t count);
  void read(std::uint64_t place, void* bytes, std::size_t count);
  void sync();
  void finish();

 private:
  /// Takes all the space, so that a full disk is noticed now.
  void reserve();

  OutputFile output_;
  std::uint64_t bytes_;
  std::unique_ptr<GrowingFile> file_;
};

}  // namespace vorocl::command
