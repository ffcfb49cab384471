// design/design.h - result of a design calculation, in the form that all calculations share: its
// numbers, tables and plots, as text, as JSON and as a page.
//
// The command line and Python use results through this struct alone. All numbers are in SI.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sinew/config/shown_units.h"
#include "sinew/json/json.h"
#include "sinew/report/page/plot.h"

namespace sinew::design {

// A number of the result, and the interval that contains it where one is known.
struct Value {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string key;   // in JSON, with its unit: "moment_arm_m"
  std::string name;  // in text and on the page: "moment arm"
  double number = 0;
  std::string unit;  // SI, "Pa gauge"; "1": a plain number
  double low = unknown, high = unknown;
  std::string note = "";      // source or meaning of the number
  std::string shown_in = "";  // unit in text and on the page, "min"; empty: the chosen set's
};

// A table, such as all feasible designs. A cell is a number, NaN if unknown, or a text.
struct Column {
  std::string key, name;
  std::string unit = "1";
  std::string shown_in = "";  // as of a value
};
using Cell = std::variant<double, std::string>;
struct Table {
  std::string key, title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::size_t shown = 12;  // rows in text; the others are in JSON and on the page
};

struct Result {
  std::string method;                 // "joint"
  std::string title;                  // one line: what was designed
  std::vector<Value> values;          // numbers of the design
  std::vector<Table> tables;          // lists, such as all feasible designs
  std::vector<report::Plot> plots;    // drawn on the page
  std::vector<std::string> notes;     // assumptions, and reasons of a choice
  std::vector<std::string> warnings;  // for stderr
  std::vector<std::string> unseen;    // sentences on what the result does not include
  std::string refused;                // why no design is possible; empty: a design is possible
  // Returns the text of the robot file that the design makes. Relative paths in it are for a file
  // at `out`. Null if the design makes no file.
  std::function<std::string(const std::string& out)> file;

  // Returns the value of a key. Throws std::out_of_range if the result lacks it.
  const Value& of(const std::string& key) const;
};

// Returns the result as text in the chosen units.
std::string text_of(const Result& result, const config::TextOptions& how = {});

// Returns the result as JSON: each value by its key, its interval by the key with `_low` and
// `_high`, each table as a list of objects; a number that is not finite is null.
Json to_json(const Result& result);

// Returns the page as HTML; `version` is that of the program. Gauge pressures refer to
// `atmosphere` [Pa]. Throws std::runtime_error if the library was built without its page.
std::string page_of(const Result& result, double atmosphere, const std::string& version);

}  // namespace sinew::design
