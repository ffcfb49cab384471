// The listed inputs match the methods: each example is read, and without a required column it is
// refused.
#include "sinew/identify/task/inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/sensor/readings.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/json/json.h"
#include "sinew/units/quantity.h"

namespace sinew::identify::inputs_test {
namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool contains(const Json& list, const std::string& text) {
  return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one == text; });
}

// Reads a table as the method does before a fit; returns the number of rows.
std::size_t rows_read(const MethodInputs& inputs, const TableKind& kind, const std::string& text) {
  const Source source{.path = "template.csv", .text = text};
  if (inputs.method == "sensor") return read_sensor_data(source, {}).known.size();
  const std::vector<ColumnSpec> columns = inputs.columns;
  const Measured data = read_measured(source, columns);
  StaticData points;
  const bool of_points =
      inputs.method == "static" || inputs.method == "check" || inputs.method == "plan";
  if (of_points) add_points(data, {}, points);
  if (inputs.method == "valve") {
    EXPECT_EQ(valve_data(data), valve_data(data, valve_data(data)));
    if (kind.name == "chart") {
      EXPECT_EQ(valve_data(data), ValveData::chart);
    }
    if (kind.name == "pulses") {
      EXPECT_EQ(valve_data(data), ValveData::pulses);
    }
  }
  return data.rows();
}

// Returns the example's text without some of its columns.
std::string without(const TableKind& kind, const std::vector<std::string>& names) {
  std::vector<bool> keep;
  std::string out;
  for (const std::string& heading : config::at_commas(std::string(kind.header))) {
    const std::string name = heading.substr(0, heading.find(" ["));
    keep.push_back(std::ranges::find(names, name) == names.end());
    if (keep.back()) out += (out.empty() ? "" : ",") + heading;
  }
  std::istringstream lines{std::string(kind.rows)};
  for (std::string line; std::getline(lines, line);) {
    std::string row;
    const std::vector<std::string> cells = config::at_commas(line);
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (keep[i]) row += (row.empty() ? "" : ",") + cells[i];
    out += "\n" + row;
  }
  return out + "\n";
}

TEST(Inputs, TheTemplateOfEveryMethodAndKindIsReadAsItIs) {
  for (const MethodInputs& inputs : method_inputs())
    for (const TableKind& kind : inputs.kinds) {
      const std::string text = template_of(inputs, kind.name);
      std::size_t rows = 0;
      EXPECT_NO_THROW(rows = rows_read(inputs, kind, text)) << inputs.method << "\n" << text;
      EXPECT_EQ(rows, static_cast<std::size_t>(std::ranges::count(kind.rows, '\n')))
          << inputs.method << " " << kind.name;
    }
}

// One column of a group is enough, so all of them are removed.
TEST(Inputs, WithoutAColumnThatIsNeededAMethodDoesNotReadItsTable) {
  for (const MethodInputs& inputs : method_inputs())
    for (const TableKind& kind : inputs.kinds)
      for (const std::string& group : config::at_commas(std::string(kind.needed))) {
        std::vector<std::string> names;
        std::istringstream in(group);
        for (std::string name; std::getline(in, name, '|');) names.push_back(name);
        // A table without its time is one of points; a joint's pressures may be missing one by one,
        // and pulses without a command are a filling.
        if (inputs.method == "joint" && names.size() > 1) continue;
        if (kind.name == "recording" && group == "time") continue;
        if (kind.name == "pulses" && group == "command") continue;
        // Both kinds of a pair's tables have one list of columns: pair_record() checks which is
        // complete.
        if (inputs.method == "pair" && group != "time") continue;
        EXPECT_ANY_THROW(rows_read(inputs, kind, without(kind, names)))
            << inputs.method << " " << kind.name << " without " << group;
      }
}

TEST(Inputs, EveryColumnOfATemplateIsOneThatTheMethodWants) {
  for (const MethodInputs& inputs : method_inputs()) {
    if (inputs.method == "sensor") continue;  // its column names are free
    const std::vector<ColumnSpec> columns = inputs.columns;
    for (const TableKind& kind : inputs.kinds)
      for (const std::string& heading : config::at_commas(std::string(kind.header)))
        EXPECT_TRUE(std::ranges::any_of(
            columns,
            [&](const ColumnSpec& w) { return w.name == heading.substr(0, heading.find(" [")); }))
            << inputs.method << ": " << heading;
  }
}

// Every listed unit is accepted.
TEST(Inputs, AcceptedUnitsConvert) {
  for (const MethodInputs& inputs : method_inputs())
    for (const ColumnSpec& w : inputs.columns) {
      const std::vector<std::string> accepted = accepted_units(w);
      EXPECT_EQ(accepted.empty(), !w.words.empty()) << w.name;
      for (const std::string& unit : accepted)
        EXPECT_FALSE(units::parse_quantity("1 " + (unit == "1" ? "" : unit), w.unit).mistake)
            << w.name << " in " << unit;
    }
}

TEST(Inputs, ReportWhatIsNeededAndWhatFor) {
  const MethodInputs& law = inputs_of("static");
  EXPECT_EQ(need_of(inputs_of("valve"), "time"), "required for fill, pulses, coil");
  EXPECT_EQ(need_of(law, "pressure"), "required");
  EXPECT_EQ(need_of(law, "force"), "required, or load");
  EXPECT_EQ(need_of(law, "time"), "required for recording");
  EXPECT_EQ(need_of(law, "rest_length"), "optional");
  EXPECT_EQ(need_of(inputs_of("valve"), "flow"),
            "required for chart, or mass_flow; for duty, or delivered or mass_flow");
  for (const MethodInputs& inputs : method_inputs())
    for (const ColumnSpec& w : inputs.columns) {
      EXPECT_FALSE(w.doc.empty()) << inputs.method << " " << w.name;
      if (!w.optional && inputs.method != "sensor") {
        EXPECT_TRUE(says(need_of(inputs, w.name), "required")) << inputs.method << w.name;
      }
    }
}

TEST(Inputs, AreReportedAsJson) {
  const auto json = to_json(inputs_of("static"));
  EXPECT_EQ(json["method"], "static");
  const auto named = [&](const std::string& name) {
    for (const auto& column : json["columns"])
      if (column["name"] == name) return column;
    return Json();
  };
  EXPECT_TRUE(contains(named("rest_length")["units"], "mm"));
  EXPECT_TRUE(contains(named("pressure")["units"], "psi gauge"));
  EXPECT_EQ(named("branch")["words"], (Json{"fill", "vent", "auf", "ab"}));
  EXPECT_EQ(named("time")["quantity"], "time");
}

TEST(Inputs, AnUnknownMethodOrKindIsReported) {
  EXPECT_THROW(inputs_of("statik"), config::Error);
  try {
    (void)template_of(inputs_of("valve"), "chrat");
    FAIL();
  } catch (const config::Error& error) {
    EXPECT_TRUE(says(error.what(),
                     "kind: found \"chrat\"; expected fill, chart, pulses, coil or duty; try "
                     "\"chart\""))
        << error.what();
  }
}

}  // namespace
}  // namespace sinew::identify::inputs_test
