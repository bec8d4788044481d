// A file whose size is known before it is written, in pieces that have their places.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"

namespace vorocl::command {

class PlacedFile : public PlaneFile {
 public:
  /// A file that begins with a header, of so many bytes in all. Throws Error as OutputFile, for a pipe or a
  /// device, and if the disk has too little space.
  PlacedFile(const std::string& path, std::uint64_t bytes, std::string header = "");

  void open() override;
  void open_part(const std::optional<KeptTiles>& kept) override;
  std::string part_path() const override { return output_.part_path(); }
  void join() override;
  void sync() override { file_->sync(); }
  void finish() override { file_->finish(); }

 protected:
  const OutputFile& output() const { return output_; }
  std::size_t header_bytes() const { return header_.size(); }
  void write_at(std::uint64_t place, const void* bytes, std::size_t count);
  void read_at(std::uint64_t place, void* bytes, std::size_t count);

 private:
  /// Takes all the space, so that a full disk is noticed now, and writes the header.
  void begin();

  OutputFile output_;
  std::uint64_t bytes_;
  std::string header_;
  std::unique_ptr<GrowingFile> file_;
};

}  // namespace vorocl::command
