// bench/peers/record.h - the table as a file and as text, and two of them beside each other.
//
// A record is JSON, "sinew.peers/1": the machine, the command, and each row with its spread. Only
// ratios of one run mean something, so two records are compared by their ratios.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/peers/row.h"

namespace sinew::bench {

nlohmann::ordered_json record(const std::vector<Row>& rows, const std::string& command);

// A line per row for people.
std::string table(const std::vector<Row>& rows);

// A row that has changed between two records.
struct Change {
  enum class Kind { slower, faster, gone };
  Kind kind = Kind::slower;
  std::string name;
  double before = 0, after = 0;  // medians
};

// Returns the rows that are worse or better by more than both spreads, from 5 to 95 %, and those
// that the newer record lacks of the parts that it has. Times of single programs say what a
// computer did that day and are left out. Throws std::runtime_error where one of them is no record.
std::vector<Change> compare(const nlohmann::ordered_json& older,
                            const nlohmann::ordered_json& newer);

std::string text(const std::vector<Change>& changes);

}  // namespace sinew::bench
