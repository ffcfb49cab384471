#include "sinew/identify/valve/valve.h"

#include "sinew/config/write/writer.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

constexpr ColumnSpec columns[] = {
    {"time", "s", 0, 1e5, optional_column, "since any instant"},
    {"pressure", "Pa abs", 5e4, 5e6, optional_column, "in the chamber"},
    {"command", "1", 0, 100, optional_column, "1: coil on"},
    {"current", "A", 1e-3, 50, optional_column, "through the coil"},
    {"upstream", "Pa abs", 5e4, 5e6, optional_column, "pressure before the valve"},
    {"downstream", "Pa abs", 1e3, 5e6, optional_column,
     "pressure behind it; the atmosphere without such a column"},
    {"flow", "m3/s", 1e-8, 1, optional_column, "volume of reference air (ANR)"},
    {"mass_flow", "kg/s", 1e-8, 1, optional_column, "in place of flow"},
    {"duty", "1", 0.02, 1, optional_column, "commanded share of the period"},
    {"delivered", "1", 0, 1.05, optional_column, "share of the period that the valve is open"},
    {"frequency", "Hz", 0.1, 1e4, optional_column, "of the pulses"},
    {"added_volume", "m3", 0, 1000, optional_column,
     "known volume that was joined to the chamber; the same in all rows of a file"},
};

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
