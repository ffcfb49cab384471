// Input tables of the methods, one row for each method, and an example of each kind of table.
#include "sinew/identify/task/inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/actuator/creep.h"
#include "sinew/identify/actuator/geometry.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/identify/motion/swing.h"
#include "sinew/identify/pair/pair_record.h"
#include "sinew/identify/sensor/readings.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"
#include "sinew/units/unit.h"

namespace sinew::identify {

namespace {

constexpr std::array point_tables{
    TableKind{"points", "a muscle at rest: held at a length, filled to a pressure",
              "pressure,force|load",
              "length [mm],pressure [kPa gauge],force [N],branch,rest_length [mm]",
              "250,200,155,fill,250\n250,400,352,fill,250\n250,400,361,vent,250\n"
              "230,200,41,fill,250\n230,400,182,fill,250\n230,400,190,vent,250\n"
              "210,200,2,fill,250\n210,400,96,fill,250\n210,400,103,vent,250\n"},
    TableKind{"recording", "a sample of a muscle at one length, from vented to filled and back",
              "time,pressure,force|load", "time [s],length [mm],pressure [kPa gauge],force [N]",
              "0,250,0,0.2\n0.1,250,1,0.1\n0.2,250,40,12\n0.3,250,180,133\n0.4,250,290,240\n"
              "0.5,250,301,252\n0.6,250,302,253\n0.7,250,160,120\n0.8,250,20,4\n"}};

constexpr std::array swing_tables{
    TableKind{"", "a sample of a mass that hangs on the muscle and swings", "time,length",
              "time [s],length [mm],pressure [kPa gauge]",
              "0,212.0,301\n0.01,211.2,303\n0.02,209.6,306\n0.03,208.1,309\n0.04,207.5,310\n"}};

constexpr std::array hold_tables{
    TableKind{"", "a sample at one length, from before the pressure rises on",
              "time,force,pressure", "time [s],force [N],pressure [kPa gauge]",
              "0,0.1,0\n0.5,60,310\n1,118,600\n10,131,612\n60,137,612\n"}};

constexpr std::array mesh_tables{TableKind{
    "", "the mesh without pressure, pulled or pushed to another length", "length,diameter",
    "length [mm],diameter [mm]", "210,16.9\n225,15.4\n240,13.5\n255,11.2\n"}};

constexpr std::array pose_tables{
    TableKind{"", "the joint at rest", "angle,flexor_pressure|extensor_pressure",
              "angle [deg],flexor_pressure [kPa gauge],extensor_pressure [kPa gauge],load [kg]",
              "-20,150,300,0\n0,200,250,0\n0,260,250,1\n20,300,150,0\n20,370,150,1\n"}};

constexpr std::array pair_tables{
    TableKind{"slide", "a sample of two sealed muscles on a slide that is moved",
              "time,force,displacement",
              "time [s],force [N],displacement [mm],pressure_1 [kPa gauge],pressure_2 [kPa gauge]",
              "0,0.2,0,350,351\n0.001,1.1,0.02,350,351\n0.002,2.3,0.05,349,352\n"},
    TableKind{"joint", "a sample of two sealed muscles on a joint that is turned",
              "time,torque,angle",
              "time [s],torque [N m],angle [deg],pressure_1 [kPa gauge],pressure_2 [kPa gauge]",
              "0,0.01,0,350,351\n0.001,0.05,0.1,350,351\n0.002,0.11,0.3,349,352\n"}};

constexpr std::array calibration_tables{
    TableKind{"force", "a known load, and the sensors' readings", "load|force|tension",
              "load [kg],gage_1 [V],gage_2 [V]",
              "0,0.52,0.49\n2,1.10,1.06\n4,1.69,1.64\n2,1.11,1.07\n0,0.52,0.49\n"},
    TableKind{"angle", "a known angle, and the converter's counts", "angle",
              "angle [deg],hip_angle [count]", "-40,612\n-20,1130\n0,1648\n20,2166\n40,2684\n"},
    TableKind{"pressure", "a known pressure, and the sensor's reading", "pressure",
              "pressure [kPa gauge],pressure_1 [V]", "0,0.50\n200,1.30\n400,2.11\n600,2.91\n"}};

constexpr std::array valve_tables{
    TableKind{"fill", "a sample of a chamber that the valve fills or vents", "time,pressure",
              "time [s],pressure [kPa gauge],added_volume [L]",
              "0,0,0\n0.01,0,0\n0.02,31,0\n0.03,64,0\n0.04,97,0\n0.05,129,0\n"},
    TableKind{"chart", "a flow at two pressures", "upstream,flow|mass_flow",
              "upstream [bar abs],downstream [bar abs],flow [L/min]",
              "7,1,1260\n7,3,1245\n7,4,1186\n7,5,1065\n7,6,838\n"},
    TableKind{"pulses", "a sample of a chamber while the valve is pulsed", "time,pressure,command",
              "time [s],pressure [kPa gauge],command",
              "0,0,0\n0.001,0,1\n0.002,0,1\n0.003,4,1\n0.004,9,0\n0.005,12,0\n"},
    TableKind{"coil", "a sample of the coil's current as it is switched on", "time,current",
              "time [s],current [A],command",
              "0,0,0\n0.0005,0.04,1\n0.001,0.09,1\n0.0015,0.12,1\n0.002,0.11,1\n0.0025,0.14,1\n"},
    TableKind{"duty", "a duty that was commanded, and what was delivered",
              "duty,delivered|flow|mass_flow", "duty [%],delivered [%],frequency [Hz]",
              "5,0,25\n10,1.2,25\n20,11.1,25\n50,41,25\n90,81.2,25\n98,100,25\n"}};

constexpr std::string_view advice_of_length =
    "length may be missing where one holds for the whole file: values.length=\"250 mm\", or where "
    "the table has contraction and a rest length is given.";
constexpr std::string_view advice_of_rest =
    "rest_length is needed where a file holds several muscles; else give rest_length=\"250 mm\", "
    "or the longest length is taken for it.";
constexpr std::string_view advice_of_time =
    "A column time makes a table a recording: its rows follow each other, begin vented, and stay "
    "at "
    "one length.";

// --- one row per method ---

MethodInputs row(std::string_view method, std::span<const ColumnSpec> columns,
                 std::span<const TableKind> kinds, std::vector<std::string_view> advice) {
  return {method, {columns.begin(), columns.end()}, kinds, std::move(advice)};
}

const std::array all_inputs{
    row("geometry", geometry_columns(), mesh_tables,
        {"Counted trapezoids need no table: trapezoids=37,16."}),
    row("sensor", sensor_columns(), calibration_tables,
        {"One known column; every other column in V or count is a sensor."}),
    row("dynamic", decay_columns(), swing_tables,
        {"Without a column pressure, give pressure=\"60 psi gauge\"."}),
    row("joint", joint_columns(true), pose_tables,
        {"Where one load hangs all the time, give load=\"1 kg\"."}),
    row("pair", pair_columns(), pair_tables,
        {"A recording has at least 100 samples, which follow each other."}),
    row("valve", valve_columns(), valve_tables,
        {"Rows of several valves in one table: where=\"valve=inlet\" takes those of one.",
         "added_volume is the same in all rows of a file: two fillings with different ones "
         "separate "
         "conductance and volume."}),
    row("static", static_columns(), point_tables,
        {advice_of_length, advice_of_rest, advice_of_time}),
    row("creep", creep_columns(), hold_tables, {}),
    row("check", static_columns(), point_tables,
        {advice_of_length, advice_of_rest, advice_of_time}),
    row("plan", static_columns(), point_tables,
        {"A table is not needed: with one, the plan is what to measure next.", advice_of_length,
         advice_of_rest, advice_of_time})};

// --- text output ---

// Units of compound quantities that instruments print.
constexpr std::string_view compound_units[] = {"L/min", "L/s", "g/s",    "g/min",
                                               "deg/s", "N m", "lbf in", "lbf ft"};

// Returns the reference suffixes of a pressure unit: both gauge and absolute are accepted.
std::vector<std::string> pressure_references(std::string_view unit) {
  if (unit.ends_with(" gauge")) return {" gauge", " abs"};
  if (unit.ends_with(" abs")) return {" abs", " gauge"};
  return {""};
}

units::Dimension dimension_of_column(std::string_view unit) {
  return units::read_unit(units::unit_and_reference(unit)[0]).unit.dimension;
}

// Splits alternative columns at bars: "force|load".
std::vector<std::string> alternatives_in(const std::string& group) {
  std::vector<std::string> out{""};
  for (const char c : group) {
    if (c == '|')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

// Returns the alternatives among which a kind of table requires the column; empty: optional.
std::vector<std::string> needed_group_of(const TableKind& kind, std::string_view column) {
  for (const std::string& group : config::at_commas(std::string(kind.needed))) {
    const std::vector<std::string> names = alternatives_in(group);
    if (std::ranges::find(names, column) != names.end()) return names;
  }
  return {};
}

const TableKind& table_kind_called(const MethodInputs& inputs, std::string_view name) {
  if (name.empty()) return inputs.kinds.front();
  const std::vector<std::string_view> names = config::names_of(inputs.kinds);
  for (const TableKind& kind : inputs.kinds)
    if (kind.name == name) return kind;
  config::fail({"kind", 0, 0}, "", config::in_quotes(name),
               inputs.kinds.size() == 1
                   ? fmt::format("none: {} takes one kind of table", inputs.method)
                   : config::either(names),
               config::closest_in_quotes(name, names));
}

Json json_of_column(const MethodInputs& inputs, const ColumnSpec& w) {
  Json out{{"name", w.name},
           {"quantity", quantity_of(w)},
           {"si_unit", w.unit},
           {"units", accepted_units(w)},
           {"needed", need_of(inputs, w.name)},
           {"meaning", w.doc}};
  if (w.most > 0) out["largest_value"] = {{"least", w.least}, {"most", w.most}};
  for (const auto& [word, value] : w.words) out["words"].push_back(word);
  return out;
}

// Returns the name in a header field such as "length [mm]".
std::string name_in_heading(const std::string& heading) {
  return heading.substr(0, std::min(heading.find(" ["), heading.size()));
}

}  // namespace

std::span<const MethodInputs> method_inputs() { return all_inputs; }

const MethodInputs& inputs_of(std::string_view method) {
  std::vector<std::string_view> names;
  for (const MethodInputs& inputs : all_inputs) {
    if (inputs.method == method) return inputs;
    names.push_back(inputs.method);
  }
  config::fail({"method", 0, 0}, "", config::in_quotes(method), config::either(names),
               config::closest_in_quotes(method, names));
}

std::vector<std::string> accepted_units(const ColumnSpec& w) {
  std::vector<std::string> out;
  if (!w.words.empty()) return out;
  const units::Dimension dimension = dimension_of_column(w.unit);
  const auto add = [&](std::string_view unit) {
    const std::string name(unit);
    if (std::ranges::find(out, name) == out.end()) out.push_back(name);
  };
  if (w.unit == "1") add("1");
  for (const std::string& reference : pressure_references(w.unit))
    for (const units::Unit& u : units::known_units)
      if (u.dimension == dimension) add(std::string(u.name) + reference);
  for (const std::string_view unit : compound_units)
    if (dimension_of_column(unit) == dimension) add(unit);
  for (const std::string& unit : units::usual_units(w.unit)) add(unit);
  return out;
}

std::string quantity_of(const ColumnSpec& w) {
  if (!w.words.empty()) return "word";
  if (w.unit == "1") return "number";
  if (w.unit == "m3/s") return "volume flow";
  if (w.unit == "kg/s") return "mass flow";
  for (const units::DimensionName& name : units::dimension_names)
    if (name.dimension == dimension_of_column(w.unit)) return std::string(name.word);
  return std::string(w.unit);
}

std::string need_of(const MethodInputs& inputs, std::string_view column) {
  // Alternative columns, with the kinds of table for which they apply.
  std::vector<std::pair<std::string, std::vector<std::string_view>>> parts;
  for (const TableKind& kind : inputs.kinds) {
    std::vector<std::string> others = needed_group_of(kind, column);
    if (others.empty()) continue;
    std::erase(others, column);
    const std::string instead =
        others.empty() ? "" : fmt::format(", or {}", fmt::join(others, " or "));
    if (parts.empty() || parts.back().first != instead) parts.push_back({instead, {}});
    parts.back().second.push_back(kind.name);
  }
  if (parts.empty()) return "optional";
  if (parts.front().second.size() == inputs.kinds.size()) return "required" + parts.front().first;
  std::string out = "required";
  for (const auto& [instead, kinds] : parts)
    out +=
        fmt::format("{} for {}{}", out == "required" ? "" : ";", fmt::join(kinds, ", "), instead);
  return out;
}

Json to_json(const MethodInputs& inputs) {
  Json out{{"format", "sinew.columns/1"}, {"method", inputs.method}};
  out["columns"] = Json::array();
  for (const ColumnSpec& w : inputs.columns) out["columns"].push_back(json_of_column(inputs, w));
  for (const TableKind& kind : inputs.kinds) {
    Json one{{"row", kind.row}};
    if (!kind.name.empty()) one["name"] = kind.name;
    for (const std::string& group : config::at_commas(std::string(kind.needed)))
      one["needed"].push_back(alternatives_in(group));
    one["header"] = kind.header;
    out["tables"].push_back(one);
  }
  out["advice"] = inputs.advice;
  return out;
}

std::string template_of(const MethodInputs& inputs, std::string_view kind_name) {
  const TableKind& kind = table_kind_called(inputs, kind_name);
  std::string out = fmt::format(
      "# For `sinew identify {}`. A row is {}.\n"
      "# Units may be changed here; the rows are examples: put yours in their place.\n",
      inputs.method, kind.row);
  const std::vector<ColumnSpec>& columns = inputs.columns;
  for (const std::string& heading : config::at_commas(std::string(kind.header))) {
    const std::string name = name_in_heading(heading);
    const auto spec = std::ranges::find(columns, name, &ColumnSpec::name);
    const bool known = spec != columns.end();
    out += fmt::format("# {}: {} ({})\n", name, known ? spec->doc : "of a sensor",
                       known ? need_of(inputs, name) : "name it as you like");
  }
  return out + fmt::format("{}\n{}", kind.header, kind.rows);
}

namespace {

constexpr std::size_t shown_units = 5;

// Returns the first units of a column; --json has all.
std::string units_of(const ColumnSpec& column) {
  std::string words;
  for (const auto& [word, value] : column.words)
    words += fmt::format("{}{}", words.empty() ? "" : " or ", word);
  if (!words.empty()) return words;
  std::vector<std::string> units = accepted_units(column);
  if (quantity_of(column) == "pressure") {
    // Each of them exists as gauge and as absolute pressure.
    std::erase_if(units, [](const std::string& unit) { return !unit.ends_with(" gauge"); });
    for (std::string& unit : units) unit.resize(unit.size() - std::string_view(" gauge").size());
    return fmt::format("{}; gauge or abs", fmt::join(units, ", "));
  }
  const bool more = units.size() > shown_units;
  if (more) units.resize(shown_units);
  return fmt::format("{}{}", fmt::join(units, ", "), more ? ", ..." : "");
}

}  // namespace

std::string text_of(const MethodInputs& inputs) {
  report::TextTable table({"column", "quantity", "needed", "units", "meaning"},
                          std::vector(5, report::TextTable::Align::left));
  for (const ColumnSpec& w : inputs.columns)
    table.add({std::string(w.name), quantity_of(w), need_of(inputs, w.name), units_of(w),
               std::string(w.doc)});
  std::string out = table.text() + "\n";
  for (const TableKind& kind : inputs.kinds)
    out +=
        fmt::format("{}a row: {}\n  {}\n", kind.name.empty() ? "" : fmt::format("{}, ", kind.name),
                    kind.row, kind.header);
  for (const std::string_view sentence : inputs.advice) out += fmt::format("{}\n", sentence);
  return out;
}

}  // namespace sinew::identify
