// The rows of tables: numbers as {fmt} writes them, and rows in order, whichever thread made them.
#define BOOST_TEST_MODULE table_rows
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "app/outputs/table_rows.hpp"
#include "fixture.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

BOOST_AUTO_TEST_CASE(numbers_are_written_as_fmt_does) {
  std::vector<double> numbers = {0, -0.0, 1, -1, 0.1, -2.5, 4294967295, 1e14, 1e15, -1e15, 1e16, 1e17, 1e300};
  for (const double number : {1e15, 9007199254740992.0}) {
    for (const double next : {0.0, 1e300}) numbers.push_back(std::nextafter(number, next));
  }
  numbers.push_back(std::numeric_limits<double>::infinity());
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    numbers.push_back(number);
    numbers.push_back(static_cast<double>(static_cast<std::int64_t>(bits) >> random() % 64));
  }
  for (const double number : numbers) {
    if (std::isnan(number)) continue;
    RowText text("");
    text.add(number);
    BOOST_TEST_REQUIRE(text.text() == fmt::format("{},", number));
  }
}

BOOST_AUTO_TEST_CASE(a_value_that_is_unknown_is_empty) {
  RowText text("7,");
  for (const double value : {2.5, RowText::unknown}) {
    text.begin_row();
    text.add(value);
    text.add(RowText::unknown, 1);
    text.end_row();
  }
  BOOST_TEST(text.text() == "7,2.5,,1\n7,,,1\n");
}

BOOST_AUTO_TEST_CASE(rows_keep_their_order) {
  const TemporaryFolder folder;
  std::vector<int> items(100000);
  std::iota(items.begin(), items.end(), 0);
  GrowingFile table(OutputFile(folder / "t.csv"));
  std::string expected;
  for (const int item : items) expected += fmt::format("of all,{}\n", item);
  add_rows(table, "of all,", items, [](RowText& text, int item) { text.add(item); });
  table.finish();
  BOOST_TEST((content_of(folder / "t.csv") == expected));
}
