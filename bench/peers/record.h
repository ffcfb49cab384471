// bench/peers/record.h - the table as a file and as text, and comparison of two tables.
//
// A record is JSON, "sinew.peers/1": the computer, the command, and each row with its spread. Only
// ratios within one run are meaningful, so two records are compared by their ratios.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/peers/row.h"

namespace sinew::bench {

nlohmann::ordered_json record(const std::vector<Row>& rows, const std::string& command);

// Returns the table as text, one line per row.
std::string table(const std::vector<Row>& rows);

// Row that differs between two records.
struct Change {
  enum class Kind { slower, faster, gone };
  Kind kind = Kind::slower;
  std::string name;
  double before = 0, after = 0;  // medians
};

// Returns the rows that are worse or better by more than both spreads, from 5 to 95 %, and rows
// that are missing in the newer record although it has their part. Absolute times are omitted,
// since they depend on the state of the computer. Throws std::runtime_error if one of the two is
// not a record.
std::vector<Change> compare(const nlohmann::ordered_json& older,
                            const nlohmann::ordered_json& newer);

std::string text(const std::vector<Change>& changes);

}  // namespace sinew::bench
