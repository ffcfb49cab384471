// A table of measurements that is read has a finite number in every row, within the range of such a
// measurement, and written in SI it is read back with the same bits. All of its columns together
// have a value or a gap in every row, and times that do not decrease.
#include <fmt/format.h>

#include <cmath>

#include "sinew/recording/measured.h"
#include "sinew/recording/raw_table.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {
namespace {

using recording::ColumnSpec;
using recording::Measured;

constexpr std::pair<std::string_view, double> words[] = {{"fill", 1}, {"vent", -1}};
constexpr ColumnSpec wanted[] = {
    {.name = "time", .unit = "s", .optional = true, .doc = "since the start"},
    {.name = "length", .unit = "m", .least = 5e-3, .most = 5, .optional = true, .doc = "of it"},
    {.name = "phase", .unit = "1", .optional = true, .doc = "what it does", .words = words},
    {.name = "pressure", .unit = "Pa gauge", .least = 1e3, .most = 2e6, .doc = "inside"},
    {.name = "force", .unit = "N", .least = 1, .most = 1e5, .doc = "it pulls with"}};

Measured read(std::string_view text, const std::string& name) {
  return recording::parse_measured(text, {.path = name}, wanted);
}

std::string written(const Measured& m) {
  std::string text;
  for (const recording::Column& c : m.columns)
    text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", c.name, c.unit);
  text += '\n';
  for (std::size_t row = 0; row < m.rows(); ++row) {
    for (std::size_t c = 0; c < m.columns.size(); ++c)
      text += fmt::format("{}{}", c == 0 ? "" : ",", m.columns[c].values[row]);
    text += '\n';
  }
  return text;
}

// Reads the same bytes as a table without any description of its columns.
void all_columns(std::string_view input) {
  recording::RawTable table;
  try {
    table = recording::read_table({.path = "a.csv", .text = std::string(input)});
  } catch (const config::Error& error) {
    return law_of_refusal(error, "a.csv");
  }
  law(table.time.empty() || table.time.size() == table.rows(), "a time for each row");
  for (std::size_t i = 1; i < table.time.size(); ++i)
    law(table.time[i] > table.time[i - 1], "times that rise");
  for (const recording::RawColumn& c : table.columns) {
    law(c.values.size() == table.rows(), "a value for each row: " + c.name);
    std::size_t missing = 0;
    for (const double v : c.values) missing += std::isnan(v) ? 1 : 0;
    law(missing == c.missing, "gaps are counted: " + c.name);
  }
}

}  // namespace

void csv(std::string_view input) {
  all_columns(input);
  Measured m;
  try {
    m = read(input, "a.csv");
  } catch (const config::Error& error) {
    return law_of_refusal(error, "a.csv");
  }
  for (const recording::Column& c : m.columns) {
    law(c.values.size() == m.rows(), "a value for each row: " + c.name);
    for (const double v : c.values) law(std::isfinite(v), "a number: " + c.name);
  }
  const std::string text = written(m);
  try {
    const Measured again = read(text, "written.csv");
    law(again.columns.size() == m.columns.size(), "columns are kept:\n" + text);
    for (std::size_t c = 0; c < m.columns.size(); ++c)
      law(again[m.columns[c].name] == m.columns[c].values, "values are kept:\n" + text);
  } catch (const config::Error& error) {
    law(false, std::string("what is written can be read: ") + error.what() + "\n" + text);
  }
}

}  // namespace sinew::fuzz
