// Points of CSV files, with and without names of columns.
#include "formats/csv.hpp"

#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".csv");
  read_or_refuse([&] { require(!read_csv(path, std::nullopt).points.empty()); });
  read_or_refuse([&] { require(!read_csv_of_volume(path, std::nullopt).empty()); });
  read_or_refuse([&] {
    const CsvPoints read = read_csv(path, Columns{"x", "1"}, "v");
    require(!read.points.empty() && read.values.size() == read.points.size());
  });
  return 0;
}
