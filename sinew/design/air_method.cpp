// design/air_method.cpp - `sinew design air`: the duration of a store of air, and its cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/design/air.h"
#include "sinew/design/air_use.h"
#include "sinew/design/methods.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

// Store and compressor of the settings.
struct Supply {
  std::optional<AirStore> store;
  double store_mass = Value::unknown, compressor_mass = Value::unknown;  // [kg]
  double line = 0;                                                       // absolute [Pa]
  std::optional<double> lowest;  // in the line, if it is given; absolute [Pa]
  std::vector<gas::CompressorPoint> compressor;
};

std::string gauge_bar(double pressure, const gas::Air& air) {
  return fmt::format("{:.3g} bar gauge", (pressure - air.atmosphere) / 1e5);
}

gas::CompressorPoint point_of(const std::string& text, double atmosphere) {
  const std::vector<std::string> parts = config::at_commas(text);
  const bool bare = std::ranges::any_of(parts, [](const std::string& part) {
    return units::split_number(part).unit.empty();  // the rest of a number with a decimal comma
  });
  if (parts.size() < 2 || parts.size() > 3 || bare)
    config::fail(
        {"compressor", 0, 0}, "", config::in_quotes(text),
        "pressure, free flow and power, each with its unit, commas between and decimal points",
        R"(compressor="100 psi gauge, 6.2 L/min, 120 W")");
  const auto part = [&](std::size_t i, const char* unit, const config::Range& range) {
    return config::quantity_setting("compressor", parts[i], unit, atmosphere, range);
  };
  gas::CompressorPoint out;
  out.gauge_pressure =
      part(0, "Pa gauge", config::from_zero(config::greatest_pressure, "of a compressor"));
  out.free_flow = part(1, "m3/s", config::from_zero(1, "of a compressor on a robot"));
  if (parts.size() == 3)
    out.power = part(2, "W", config::above_zero(1e5, "of a compressor on a robot"));
  return out;
}

Supply supply_of(const AirSettings& s, const AirUses& uses) {
  const double atmosphere = uses.air.atmosphere;
  const config::SettingValues values(s, atmosphere);
  const auto absolute = [&](const char* name, const std::string& member) {
    const double pressure = atmosphere + values.of(member);
    if (!(pressure <= gas::highest_stored_pressure))
      config::refuse_setting(name, config::in_quotes(member),
                             "at most " +
                                 units::format_quantity(gas::highest_stored_pressure - atmosphere,
                                                        "Pa gauge", "bar gauge") +
                                 ": compressibilities are known up to it");
    return pressure;
  };
  Supply out{.store_mass = values.given(s.mass).value_or(Value::unknown),
             .compressor_mass = values.given(s.compressor_mass).value_or(Value::unknown)};
  for (const std::string& text : s.compressor) {
    const gas::CompressorPoint point = point_of(text, atmosphere);
    constexpr double rounding = 1;  // error of a pressure in another unit [Pa]
    const auto is_equal = [&](const gas::CompressorPoint& other) {
      return std::abs(other.gauge_pressure - point.gauge_pressure) < rounding;
    };
    if (std::ranges::any_of(out.compressor, is_equal))
      config::refuse_setting("compressor", config::in_quotes(text) + ", a second point there",
                             "one point for each pressure");
    out.compressor.push_back(point);
  }
  std::ranges::sort(out.compressor, {}, &gas::CompressorPoint::gauge_pressure);
  out.line = s.line.empty() ? uses.line : absolute("line", s.line);
  if (!std::isfinite(out.line))
    config::fail({"line", 0, 0}, "", "nothing",
                 "the set pressure of the regulator, which a table does not have",
                 R"(line="100 psi gauge")");
  if (s.volume.empty() != s.pressure.empty())
    config::fail({s.volume.empty() ? "volume" : "pressure", 0, 0}, "", "nothing",
                 "volume and pressure of the store", R"(volume="1 L" pressure="200 bar gauge")");
  if (s.volume.empty() && s.compressor.empty())
    config::fail({"volume", 0, 0}, "", "nothing", "a store or a compressor",
                 R"(volume="1 L" pressure="200 bar gauge")");
  if (s.droop.empty() != s.droop_flow.empty())
    config::fail({s.droop.empty() ? "droop" : "droop_flow", 0, 0}, "", "nothing",
                 "the fall of pressure and the flow at which it was measured",
                 R"(droop="1 bar diff" droop_flow="150 L/min")");
  if (!s.lowest.empty()) {
    constexpr double rounding = 1 + 1e-9;
    out.lowest = absolute("lowest", s.lowest);
    if (*out.lowest > out.line * rounding)
      config::refuse_setting(
          "lowest", config::in_quotes(s.lowest),
          "at most the set pressure of the line, " + gauge_bar(out.line, uses.air));
  }
  if (!s.volume.empty())
    out.store = AirStore{values.of(s.volume), absolute("pressure", s.pressure),
                         std::min(out.line, out.lowest.value_or(out.line))};
  return out;
}

// Numbers of all runs in one limit, and their quantiles.
struct Durations {
  std::vector<double> times, steps, distances;
};

Durations durations_of(double air, const AirUses& uses, double compressor_flow) {
  Durations out;
  for (const AirUse& use : uses.runs) {
    const Lasting one = lasting(air, use, compressor_flow);
    out.times.push_back(one.time);
    out.steps.push_back(one.steps);
    out.distances.push_back(one.distance);
  }
  return out;
}

double middle(const std::vector<double>& numbers) { return quantile(numbers, 0.5); }

// Returns the consumption whose numbers are the middle ones of all runs.
AirUse middle_use(const AirUses& uses) {
  const auto of = [&](double AirUse::*member) {
    std::vector<double> numbers;
    for (const AirUse& use : uses.runs) numbers.push_back(use.*member);
    return middle(numbers);
  };
  return {of(&AirUse::per_second), of(&AirUse::per_step), of(&AirUse::per_metre),
          of(&AirUse::filling)};
}

void add(Result& out, Value value) {
  if (!std::isnan(value.number)) out.values.push_back(std::move(value));
}

// Adds the consumption, with 5 and 95 % of the runs.
void add_use(Result& out, const AirUses& uses) {
  const auto of = [&](const char* key, const char* name, const char* unit, double AirUse::*member) {
    std::vector<double> numbers;
    for (const AirUse& use : uses.runs) numbers.push_back(use.*member);
    const bool many = uses.runs.size() > 1;
    add(out,
        {key, name, middle(numbers), unit, many ? quantile(numbers, 0.05) : Value::unknown,
         many ? quantile(numbers, 0.95) : Value::unknown, many ? "5 to 95 % of the runs" : ""});
  };
  of("air_use_kg_per_s", "consumption", "kg/s", &AirUse::per_second);
  of("air_use_per_step_kg", "consumption per step", "kg", &AirUse::per_step);
  of("air_use_kg_per_m", "consumption per distance", "kg/m", &AirUse::per_metre);
}

// Adds the durations: the middle is that of warm walls, the interval covers both limits.
void add_durations(Result& out, const Durations& warm, const Durations& cold,
                   const std::string& note) {
  const auto of = [&](const char* key, const char* name, const char* unit, const char* shown_in,
                      std::vector<double> Durations::*member) {
    add(out, {key, name, middle(warm.*member), unit, quantile(cold.*member, 0.05),
              quantile(warm.*member, 0.95), note, shown_in});
  };
  of("time_s", "time", "s", "min", &Durations::times);
  of("steps", "steps", "1", "", &Durations::steps);
  of("distance_m", "distance", "m", "m", &Durations::distances);
}

Table limits_table(const Yield& warm, const Yield& cold, const Durations& of_warm,
                   const Durations& of_cold) {
  Table out{"limits",
            "Limits of the heat that the walls pass",
            {{"walls", "walls"},
             {"usable_air_kg", "usable", "kg"},
             {"air_left_kg", "left", "kg"},
             {"temperature_K", "coldest", "K"},
             {"time_s", "time", "s", "min"},
             {"steps", "steps"},
             {"distance_m", "distance", "m", "m"}},
            {}};
  const auto row = [&](const char* name, const Yield& yield, const Durations& of) {
    out.rows.push_back({name, yield.air, yield.left.mass, yield.left.temperature, middle(of.times),
                        middle(of.steps), middle(of.distances)});
  };
  row("at the room's temperature", warm, of_warm);
  row("without heat", cold, of_cold);
  return out;
}

// Returns the store's pressure over time at the middle consumption, for both limits.
report::Plot pressure_plot(const AirStore& store, const gas::Air& air, const AirUse& use,
                           double net) {
  report::Plot out{.name = "pressure",
                   .title = "Pressure in the store",
                   .x = {"time", "s"},
                   .y = {"pressure", "Pa gauge", 0}};
  report::Curve warm{.label = "walls at the room's temperature", .bold = true},
      cold{.label = "walls that pass no heat"};
  const double full = gas::stored_mass(air, store.volume, store.pressure);
  const double filling = std::isfinite(use.filling) ? use.filling : 0.0;
  constexpr int steps = 80;
  for (int i = 0; i <= steps; ++i) {
    const double p = store.pressure + (store.lowest - store.pressure) * i / steps;
    const auto put = [&](report::Curve& curve, double left) {
      const double time = (full - left - filling) / net;
      if (time < 0) return;
      curve.xs.push_back(time), curve.ys.push_back(p - air.atmosphere);
    };
    put(warm, gas::stored_mass(air, store.volume, p));
    put(cold, gas::left_without_heat(air, store.volume, store.pressure, p).mass);
  }
  out.curves = {warm, cold};
  return out;
}

void add_store(Result& out, const AirStore& store, const Supply& supply, const gas::Air& air,
               const Yield& warm, const Yield& cold) {
  const double exergy = gas::stored_exergy(air, store.volume, store.pressure);
  const double mass = gas::stored_mass(air, store.volume, store.pressure);
  add(out, {"stored_air_kg", "air in the full store", mass, "kg", Value::unknown, Value::unknown,
            fmt::format("{:.3g} L of free air", 1e3 * mass / gas::density_at_atmosphere(air))});
  add(out, {"usable_air_kg", "usable air", warm.air, "kg", cold.air, warm.air,
            "down to the lowest pressure in the line"});
  add(out, {"air_left_kg", "air left", warm.left.mass, "kg", warm.left.mass, cold.left.mass});
  add(out,
      {"exergy_J", "exergy of the store", exergy, "J", Value::unknown, Value::unknown, "", "J"});
  add(out,
      {"line_exergy_J", "exergy of the usable air in the line",
       warm.air * gas::stream_exergy(air, supply.line), "J",
       cold.air * gas::stream_exergy(air, supply.line),
       warm.air * gas::stream_exergy(air, supply.line), "the regulator destroys the rest", "J"});
  add(out, {"specific_exergy_J_per_kg", "exergy per mass of the full store",
            exergy / (mass + supply.store_mass), "J/kg"});
}

// Adds what the compressor does in the line. Returns its mass flow [kg/s].
double add_compressor(Result& out, const Supply& supply, const AirUse& use, const gas::Air& air) {
  if (supply.compressor.empty()) return 0;
  const gas::CompressorPoint at =
      gas::compressor_at(supply.compressor, supply.line - air.atmosphere);
  const double flow = gas::mass_of_free_air(air, at.free_flow);
  add(out, {"compressor_flow_kg_per_s", "flow of the compressor", flow, "kg/s", Value::unknown,
            Value::unknown,
            fmt::format("{:.3g} L/min of free air at the line's pressure", 6e4 * at.free_flow)});
  if (at.power > 0) {
    const double share = std::min(use.per_second / flow, 1.0);
    add(out, {"compressor_power_W", "mean electrical power", share * at.power, "W", Value::unknown,
              Value::unknown, fmt::format("on for {:.3g} % of the time", 100 * share)});
    const double efficiency = flow * gas::stream_exergy(air, supply.line) / at.power;
    add(out, {"isothermal_efficiency", "isothermal efficiency", efficiency, "1", Value::unknown,
              Value::unknown, "exergy of the compressed air, of the electrical energy"});
    if (efficiency > 1)
      out.warnings.push_back(fmt::format(
          "the compressor has an isothermal efficiency of {:.4g}, and none is above 1: check its "
          "flow and its power",
          efficiency));
    add(out, {"compressor_exergy_W_per_kg", "exergy flow per mass of the compressor",
              flow * gas::stream_exergy(air, supply.line) / supply.compressor_mass, "W/kg"});
  }
  return flow;
}

// Adds what one more muscle like the mean one takes.
void add_one_more(Result& out, const AirUses& uses, const AirUse& use, double usable,
                  double compressor_flow) {
  if (uses.muscles == 0 || !std::isfinite(use.per_second)) return;
  const double share = 1.0 / uses.muscles;
  AirUse more = use;
  for (double AirUse::*member :
       {&AirUse::per_second, &AirUse::per_step, &AirUse::per_metre, &AirUse::filling})
    more.*member *= 1 + share;
  add(out, {"one_more_muscle_kg_per_s", "one more muscle takes", use.per_second * share, "kg/s",
            Value::unknown, Value::unknown, fmt::format("as the mean of {} does", uses.muscles)});
  if (!(usable > 0)) return;
  const double before = lasting(usable, use, compressor_flow).time,
               after = lasting(usable, more, compressor_flow).time;
  if (std::isfinite(before))
    add(out, {"one_more_muscle_time_s", "and changes the time by", after - before, "s",
              Value::unknown, Value::unknown, "", "min"});
}

// Adds the pressure in the line at the consumption, and a warning if it is below a lowest one that
// is given.
void add_droop(Result& out, const AirSettings& s, const Supply& supply, const AirUse& use,
               const gas::Air& air) {
  if (s.droop.empty() || !std::isfinite(use.per_second)) return;
  const config::SettingValues values(s, air.atmosphere);
  const double flow = use.per_second / gas::density_at_atmosphere(air);
  const double line =
      gas::drooped_pressure(supply.line, values.of(s.droop) / values.of(s.droop_flow), flow);
  add(out, {"drooped_line_Pa", "pressure in the line at the mean flow", line - air.atmosphere,
            "Pa gauge", Value::unknown, Value::unknown,
            fmt::format("{:.3g} L/min of free air", 6e4 * flow)});
  if (supply.lowest && line < *supply.lowest)
    out.warnings.push_back(
        "at the mean flow the regulator's pressure is below the lowest pressure in the line: a "
        "larger regulator, or a lower one");
}

std::string title_of(const Result& result, const AirUses& uses) {
  std::string out = "air for " + uses.title;
  const auto known = [&](const char* key) {
    const auto at = std::ranges::find(result.values, std::string(key), &Value::key);
    return at == result.values.end() || !std::isfinite(at->number) ? Value::unknown : at->number;
  };
  const double time = known("time_s"), steps = known("steps"), distance = known("distance_m");
  if (std::isfinite(time)) out += fmt::format(", {:.3g} min", time / 60);
  if (std::isfinite(steps)) out += fmt::format(", {:.3g} steps", steps);
  if (std::isfinite(distance)) out += fmt::format(", {:.3g} m", distance);
  return out;
}

}  // namespace

Result design(const AirSettings& s) {
  const config::SettingValues checked(s);  // a missing setting is refused before a file is read
  const AirUses uses = air_uses(s);
  const Supply supply = supply_of(s, uses);
  const AirUse use = middle_use(uses);
  Result out{.method = "air", .notes = uses.notes, .warnings = uses.warnings};
  out.unseen = {
      "Peaks of the flow: a regulator or a compressor that is too small for them lets the "
      "line fall; see `sinew design valve`.",
      "Masses of hoses, fittings and batteries; what the robot walks like with the added "
      "weight."};
  add_use(out, uses);
  const double compressor = add_compressor(out, supply, use, uses.air);
  if (compressor > 0 && !std::isfinite(use.per_second))
    config::fail({"compressor", 0, 0}, "", "a consumption without a duration",
                 "one in time, as the compressor's flow is",
                 "columns steps and sequence_duration_s in the table");
  if (!supply.compressor.empty() && compressor == 0)
    out.warnings.push_back("the compressor's table ends below the pressure of the line");
  double usable = 0;
  if (supply.store) {
    const AirStore& store = *supply.store;
    if (!(store.pressure > store.lowest)) {
      out.title = title_of(out, uses);
      out.refused = fmt::format(
          "no design: the store has {}, the line needs {}; try a higher pressure, or a lower "
          "pressure in the line",
          gauge_bar(store.pressure, uses.air), gauge_bar(store.lowest, uses.air));
      return out;
    }
    const Yield warm = yield_at_room_temperature(store, uses.air),
                cold = yield_without_heat(store, uses.air);
    const Durations of_warm = durations_of(warm.air, uses, compressor),
                    of_cold = durations_of(cold.air, uses, compressor);
    usable = warm.air;
    add_durations(out, of_warm, of_cold,
                  uses.runs.size() > 1 ? "5 % without heat to 95 % with warm walls"
                                       : "without heat to warm walls");
    add_store(out, store, supply, uses.air, warm, cold);
    out.tables = {limits_table(warm, cold, of_warm, of_cold)};
    const double net = use.per_second - compressor;
    if (net > 0) out.plots = {pressure_plot(store, uses.air, use, net)};
    if (net <= 0)
      out.notes.push_back(
          "the compressor delivers more than the mean consumption: the store is "
          "never empty");
    if (warm.air < use.filling)
      out.warnings.push_back("the usable air does not fill the machine before its first step");
  } else if (use.per_second > compressor) {
    out.warnings.push_back(fmt::format(
        "the compressor delivers {:.3g} % of the mean consumption, and there is no store",
        100 * compressor / use.per_second));
  } else {
    out.notes.push_back("the compressor delivers the mean consumption as long as it has power");
  }
  add_droop(out, s, supply, use, uses.air);
  add_one_more(out, uses, use, usable, compressor);
  out.title = title_of(out, uses);
  return out;
}

}  // namespace sinew::design
