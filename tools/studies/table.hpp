// The tables of evaluation and ablation: CSV rows, each of which starts with its origin.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/csv.hpp"
#include "studies/evaluation.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

/// What all rows of a file share, by column: version, device, settings.
using Origin = std::vector<std::pair<std::string, std::string>>;

Origin origin_of(const Device& device, const EvaluationSettings& settings);

/// "2026-01-31T12:00:00Z"
std::string utc_now();

/// The number in as few digits as tell it from all others.
std::string text(double value);

/// A column, and what it holds of what a row is made from.
template <typename Row>
struct Column {
  const char* name;
  std::string (*value)(const Row& row);
};

template <typename Row, std::size_t count>
std::string header_of(const Origin& origin, const Column<Row> (&columns)[count]) {
  CsvFields names;
  for (const auto& shared : origin) names.push_back(shared.first);
  for (const Column<Row>& column : columns) names.emplace_back(column.name);
  return to_csv(names);
}

template <typename Row, std::size_t count>
std::string line_of(const Origin& origin, const Column<Row> (&columns)[count], const Row& row) {
  CsvFields fields;
  for (const auto& shared : origin) fields.push_back(shared.second);
  for (const Column<Row>& column : columns) fields.push_back(column.value(row));
  return to_csv(fields);
}

}  // namespace vorocl::command
