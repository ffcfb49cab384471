#include "sinew/identify/valve/valve.h"

#include <fmt/format.h>

#include <array>

#include "sinew/config/write/writer.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

constexpr std::array columns{
    ColumnSpec{
        .name = "time", .unit = "s", .most = 1e5, .optional = true, .doc = "since any instant"},
    ColumnSpec{.name = "pressure",
               .unit = "Pa abs",
               .least = 5e4,
               .most = 5e6,
               .optional = true,
               .doc = "in the chamber"},
    ColumnSpec{.name = "command", .unit = "1", .most = 100, .optional = true, .doc = "1: coil on"},
    ColumnSpec{.name = "current",
               .unit = "A",
               .least = 1e-3,
               .most = 50,
               .optional = true,
               .doc = "through the coil"},
    ColumnSpec{.name = "upstream",
               .unit = "Pa abs",
               .least = 5e4,
               .most = 5e6,
               .optional = true,
               .doc = "pressure before the valve"},
    ColumnSpec{.name = "downstream",
               .unit = "Pa abs",
               .least = 1e3,
               .most = 5e6,
               .optional = true,
               .doc = "pressure behind it; the atmosphere without such a column"},
    ColumnSpec{.name = "flow",
               .unit = "m3/s",
               .least = 1e-8,
               .most = 1,
               .optional = true,
               .doc = "volume of reference air (ANR)"},
    ColumnSpec{.name = "mass_flow",
               .unit = "kg/s",
               .least = 1e-8,
               .most = 1,
               .optional = true,
               .doc = "in place of flow"},
    ColumnSpec{.name = "duty",
               .unit = "1",
               .least = 0.02,
               .most = 1,
               .optional = true,
               .doc = "commanded share of the period"},
    ColumnSpec{.name = "delivered",
               .unit = "1",
               .most = 1.05,
               .optional = true,
               .doc = "share of the period that the valve is open"},
    ColumnSpec{.name = "frequency",
               .unit = "Hz",
               .least = 0.1,
               .most = 1e4,
               .optional = true,
               .doc = "of the pulses"},
    ColumnSpec{
        .name = "added_volume",
        .unit = "m3",
        .most = 1000,
        .optional = true,
        .doc = "known volume that was joined to the chamber; the same in all rows of a file"}};

}  // namespace

std::span<const ColumnSpec> valve_columns() { return columns; }

namespace {

bool has_columns_of(ValveData kind, const Measured& data) {
  const auto has = [&](std::string_view name) { return data.has(name); };
  const bool flow = has("flow") || has("mass_flow");
  switch (kind) {
    case ValveData::duty:
      return has("duty") && (has("delivered") || flow);
    case ValveData::chart:
      return has("upstream") && flow;
    case ValveData::coil:
      return has("time") && has("current");
    case ValveData::pulses:
      return has("time") && has("pressure") && has("command");
    case ValveData::fill:
      break;
  }
  return has("time") && has("pressure");
}

}  // namespace

ValveData valve_data(const Measured& data, std::optional<ValveData> wanted) {
  for (const ValveData kind :
       {ValveData::duty, ValveData::chart, ValveData::coil, ValveData::pulses, ValveData::fill})
    if (has_columns_of(kind, data) && kind == wanted.value_or(kind)) return kind;
  std::string found;
  for (const Column& c : data.columns) found += (found.empty() ? "" : ", ") + c.name;
  throw Refusal(data.file,
                found.empty() ? "none of the columns" : "the columns " + found + " alone",
                "upstream and flow; time and pressure; time, pressure and command; time and "
                "current; or duty and delivered or flow",
                "names.pressure=NAME, where the file calls them otherwise");
}

ValveResult before(const ValveOptions& options) {
  ValveResult out{.valve = options.valve, .provenance = options.provenance};
  out.valve.name = options.name;
  return out;
}

void replace_flow(gas::Flow::Law law, const std::string& source, ValveResult& result) {
  gas::Flow& flow = result.valve.flow;
  flow = {.law = law, .linear_below = flow.linear_below};
  const std::string path = "valve." + result.valve.name + ".flow.";
  for (const char* key :
       {"law", "area", "efficiency", "sonic_conductance", "critical_pressure_ratio"})
    result.provenance.given(path + key, source);
  for (const Estimate& e : result.report.best().parameters) {
    double* const value = e.name == "area"                      ? &flow.area
                          : e.name == "sonic_conductance"       ? &flow.sonic_conductance
                          : e.name == "critical_pressure_ratio" ? &flow.critical_pressure_ratio
                                                                : nullptr;
    if (!value) continue;
    *value = e.value;
    result.provenance.fitted(path + e.name, e, source);
  }
  result.flow_known = true;
}

std::string valve_file(gas::Valve valve, const Provenance& provenance) {
  const std::string name = valve.name;
  config::Writer writer(&provenance.origins());
  writer.format("valves");
  std::vector<gas::Valve> one{std::move(valve)};
  gas::fields(writer, one);

  // Values without a source of their own were not identified.
  config::Node root = writer.root();
  config::Node* table = root.find("valve")->find(name);
  table->put(config::make_text("source", provenance.elsewhere()));
  for (config::Node& child : table->children)
    if (child.is_table() && !child.is_value_table())
      child.put(config::make_text("source", provenance.elsewhere()));
  return config::to_toml(root);
}

}  // namespace sinew::identify
