// cli/valve.cpp - `sinew valve`: what flows through a valve, how long a volume takes, what its
// delays make of a duty.
#include "sinew/gas/valve.h"
#include "sinew/report/text/text_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/valve_flow.h"
#include "sinew/signals/pulse.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, name, upstream, downstream, volume, duty, frequency = "100 Hz";
  bool json = false, quiet = false;
};

struct Delivered {
  double duty = 0, delivered = 0;
};

std::vector<Delivered> deliveries(const gas::Valve& valve, const Options& options) {
  std::vector<Delivered> out;
  if (options.duty.empty()) return out;
  const gas::Delays delays = gas::delays(valve);
  const double period =
      1.0 / argument("--frequency", options.frequency, "1/s", units::atmosphere, pulses);
  constexpr Range share = from_zero(1, "a share of the period");
  for (const double duty : arguments("--duty", options.duty, "1", units::atmosphere, share).si)
    out.push_back({duty, signals::delivered_duty(duty, period, delays.opening, delays.closing)});
  return out;
}

Json to_json(const gas::Valve& valve, const gas::ValveFlow& f,
             const std::vector<gas::Transfer>& times, const std::vector<Delivered>& duties) {
  Json out{{"valve", valve.name},
           {"upstream_Pa", f.upstream},
           {"downstream_Pa", f.downstream},
           {"mass_flow_kg_per_s", f.mass_flow},
           {"normal_flow_m3_per_s", f.normal_flow},
           {"pressure_ratio", f.ratio},
           {"critical_pressure_ratio", f.critical_ratio},
           {"choked", f.choked()},
           {"linear_part", f.linear},
           {"law_mass_flow_kg_per_s", f.law_flow},
           {"effective_area_m2", f.area},
           {"sonic_conductance_m3_per_s_Pa", f.sonic_conductance},
           {"opening_delay_s", gas::delays(valve).opening},
           {"closing_delay_s", gas::delays(valve).closing}};
  for (const gas::Transfer& t : times)
    out["transfers"].push_back(
        {{"share", t.share}, {"fill_time_s", t.fill}, {"vent_time_s", t.vent}});
  for (const Delivered& d : duties)
    out["duties"].push_back({{"duty", d.duty}, {"delivered_duty", d.delivered}});
  return out;
}

void print_flow(const gas::Valve& valve, const gas::ValveFlow& f) {
  const auto show = [](double si, std::string_view unit, std::string_view display) {
    return config::format_quantity(si, unit, display, 5);
  };
  report::TextTable table({"", "", ""});
  table.add({"mass flow", show(f.mass_flow, "kg/s", "kg/s"),
             show(f.normal_flow, "m3/s", "L/min") + " ANR"});
  if (f.linear) table.add({"by the law itself", show(f.law_flow, "kg/s", "kg/s"), ""});
  table.add(
      {"flow",
       f.choked() ? "choked"
       : f.linear ? "free, linear"
                  : "free",
       fmt::format("ratio {:.{}f}, critical {:.4f}", f.ratio, f.linear ? 6 : 4, f.critical_ratio)});
  table.add({"effective area", show(f.area, "m2", "mm2"), show(f.area, "m2", "in2")});
  table.add({"sonic conductance C", show(f.sonic_conductance, "m3/(s Pa)", "L/(s bar)"), ""});
  table.add({"delays", "opens after " + show(gas::delays(valve).opening, "s", "ms"),
             "shuts after " + show(gas::delays(valve).closing, "s", "ms")});
  fmt::print("{}", table.text().substr(1));
}

// The linear part is there for integration; near equal pressures it is far below the law.
void warn_of_linear_part(const gas::Valve& valve, const gas::ValveFlow& f,
                         const Messages& messages) {
  if (!f.linear) return;
  messages.warning(fmt::format(
      "{}: the pressures are {:.2g} % apart, less than linear_below, {:.2g} %: there the flow is a "
      "straight line through zero, so that it can be integrated; the law itself gives {:.3g} times "
      "as much",
      valve.name, 100 * (1 - f.ratio), 100 * valve.flow.linear_below, f.law_flow / f.mass_flow));
}

void print_times(const std::vector<gas::Transfer>& times, double volume, const gas::ValveFlow& f) {
  if (times.empty()) return;
  const auto bar = [](double p) { return config::format_quantity(p, "Pa abs", "psi abs", 4); };
  fmt::print("\n{} between {} and {}, valve open:\n", config::format_quantity(volume, "m3", "in3"),
             bar(f.downstream), bar(f.upstream));
  using enum report::TextTable::Align;
  report::TextTable table({"of the way", "fill [ms]", "vent [ms]"}, {right, right, right});
  for (const gas::Transfer& t : times)
    table.add({fmt::format("{:.0f} %", 100 * t.share), fmt::format("{:.3f}", 1e3 * t.fill),
               fmt::format("{:.3f}", 1e3 * t.vent)});
  fmt::print("{}", table.text());
}

void print_duties(const std::vector<Delivered>& duties, const std::string& frequency) {
  if (duties.empty()) return;
  using enum report::TextTable::Align;
  fmt::print("\nat {}:\n", frequency);
  report::TextTable table({"duty", "delivered"}, {right, right});
  for (const Delivered& d : duties)
    table.add({fmt::format("{:.4g} %", 100 * d.duty), fmt::format("{:.4g} %", 100 * d.delivered)});
  fmt::print("{}", table.text());
}

ExitCode run_valve(const Options& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const gas::Valve& valve = config::named(file.experiment.valves, options.name, "NAME", "valve");
  const double up =
      argument("--upstream", options.upstream, "Pa abs", air.atmosphere, air_pressure);
  const double down =
      argument("--downstream", options.downstream, "Pa abs", air.atmosphere, air_pressure);

  const gas::ValveFlow f = gas::flow_through(valve.flow, air, up, down);
  std::vector<gas::Transfer> times;
  double volume = 0;
  if (!options.volume.empty()) {
    volume = argument("--volume", options.volume, "m3", air.atmosphere,
                      above_zero(air_volume.high, air_volume.why));
    times = gas::transfers(valve.flow, air, volume, f);
  }
  const std::vector<Delivered> duties = deliveries(valve, options);

  warn_of_linear_part(valve, f, Messages(options.quiet));
  if (options.json) {
    fmt::print("{}\n", json_text(to_json(valve, f, times, duties), 2));
    return ok;
  }
  print_flow(valve, f);
  print_times(times, volume, f);
  print_duties(duties, options.frequency);
  return ok;
}

}  // namespace

void add_valve(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub =
      app.subcommand("valve", "flow, filling times and delays of a valve",
                     "sinew valve robots/leg/valves.toml inlet --upstream \"100 psi gauge\" "
                     "--downstream \"0 psi gauge\" --volume \"1 in3\"");
  sub.add_option("FILE", options->file, "valves, robot or experiment file").required();
  sub.add_option("NAME", options->name, "of the valve").required();
  sub.add_option("--upstream", options->upstream, "pressure, gauge or abs").required();
  sub.add_option("--downstream", options->downstream, "pressure, gauge or abs").required();
  sub.add_option("--volume", options->volume, "rigid, to be filled and vented");
  Option duty = sub.add_option("--duty", options->duty, "share of the period, or from:to:step");
  sub.add_option("--frequency", options->frequency, "of the pulses; 100 Hz").needs(duty);
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_valve(*options); }; });
}

}  // namespace sinew::cli
