// Files of one value per pixel, by the extension of their name: .npy, .tif or .tiff, and .vti, which ParaView
// opens and which is only written. Labels are such values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/images/pictures.hpp"
#include "formats/output_file.hpp"
#include "formats/raster.hpp"

namespace vorocl::command {

/// The extensions of files that labels can be read from, and written to.
inline const std::vector<std::string> readable_label_extensions = {".npy", ".tif", ".tiff"};
inline const std::vector<std::string> label_extensions = {".npy", ".tif", ".tiff", ".vti"};

/// Whole numbers of any type that fit in 32 bits; negative ones, such as -1 for no_label, have the bits of
/// one with a sign. Those of a volume from .npy alone. Throws Error if the file cannot be read or holds
/// something else, or its name ends in no such extension.
LabelImage read_labels(const std::string& path);

/// The extensions of files that values of a volume can be written to.
inline const std::vector<std::string> volume_extensions = {".npy", ".vti"};

/// Throws Error if the name ends in no such extension, or the file cannot be written.
void write_labels(const OutputFile& file, const Raster& raster, const std::vector<std::uint32_t>& labels);

/// Values (uint8, uint32 or float), row-major, slice after slice; a .vti file calls them by the name, and
/// with .tif files knows where the raster lies. Throws Error if the extension is none of these, or for
/// volumes none of volume_extensions, or the file cannot be written.
template <typename T>
void write_pixels(const OutputFile& file, const std::string& name, const Raster& raster,
                  const std::vector<T>& values);

/// Whether a file that starts like this is a TIFF, in either byte order, a BigTIFF too.
bool is_tiff(const std::vector<std::uint8_t>& bytes);

/// Throws Error if the file is something else or damaged.
ImageHeader read_tiff_header(const std::string& path);

/// One value per pixel, float or uint32, row-major. The bits of a uint32 are written as a signed integer, for
/// some readers (OpenCV 4) refuse unsigned ones: labels from 2^31 on, and no_label, look negative there.
/// Uncompressed; a BigTIFF where the file would pass 4 GiB; a GeoTIFF where the raster lies in the data, in
/// which no_label and infinity are no data. Throws Error if the file cannot be written, or is a pipe.
template <typename T>
void write_tiff(const OutputFile& file, const Raster& raster, const std::vector<T>& values);

/// One value per pixel (uint8, uint32 or float), row-major, slice after slice, as the cell data `name` of an
/// image whose cells are the pixels: what is at (x, y, z) in the data, or in pixels, is there. The values are
/// raw bytes at the file's end, in the host's byte order. Throws Error if the file cannot be written.
template <typename T>
void write_vti(const OutputFile& file, const std::string& name, const Raster& raster,
               const std::vector<T>& values);

/// Writes what a file of VTK has before its raw bytes: it is of such a kind, with attributes, and has a piece
/// with such attributes and elements.
void begin_vtk(GrowingFile& file, const std::string& kind, const std::string& attributes,
               const std::string& piece, const std::string& elements);
/// And behind them.
constexpr const char* end_of_vtk = "\n  </AppendedData>\n</VTKFile>\n";

/// A text as an attribute of XML.
std::string escaped(const std::string& text);

/// A file of a collection and the time that it shows.
struct TimedFile {
  std::int64_t time;
  std::string name;  // relative to the collection's folder
};

/// Throws Error if the file cannot be written.
void write_pvd(const OutputFile& file, const std::vector<TimedFile>& files);

}  // namespace vorocl::command
