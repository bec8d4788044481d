// Points of CSV files, with and without names of columns.
#include "formats/csv.hpp"

#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".csv");
  const CsvOptions all[] = {{}, {Columns{"x", "1"}, "v", false, {"all"}}, {{}, "", true, {"0"}}};
  for (const CsvOptions& options : all) {
    for (const bool has_z : {false, true}) {
      read_or_refuse([&] {
        const CsvPoints read = read_csv(path, options, has_z);
        const auto is_whole = [&](std::size_t size, bool is_there) {
          return size == (is_there ? read.points.size() : 0);
        };
        require(!read.points.empty() && is_whole(read.values.numbers.size(), !options.value_column.empty()) &&
                is_whole(read.kept.size(), !options.keep.empty()));
      });
    }
  }
  return 0;
}
