// cli/valve.cpp - `sinew valve`: what flows through a valve, how long a volume takes, what its
// delays make of a duty.
#include "sinew/gas/valve.h"

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/valve_flow.h"
#include "sinew/json/json.h"
#include "sinew/run/setup/valve_text.h"
#include "sinew/signals/pulse.h"

namespace sinew::cli {

namespace {

struct ValveOptions {
  std::string file, name, upstream, downstream, volume, wall_time, exponent, duty,
      frequency = "100 Hz", units;
  bool json = false, quiet = false;
};

std::vector<run::Delivered> deliveries(const gas::Valve& valve, const ValveOptions& options) {
  std::vector<run::Delivered> out;
  if (options.duty.empty()) return out;
  const gas::Delays delays = gas::delays(valve);
  const double period =
      1.0 / argument("--frequency", options.frequency, "1/s", units::atmosphere, pulses);
  constexpr Range share = from_zero(1, "a share of the period");
  for (const double duty : arguments("--duty", options.duty, "1", units::atmosphere, share).si)
    out.push_back({duty, signals::delivered_duty(duty, period, delays.opening, delays.closing)});
  return out;
}

// Returns the times by an energy balance: its two limits and, where a wall time is given, what lies
// between them; or those by an exponent.
std::vector<run::Transfers> transfers(const gas::Valve& valve, gas::Air air, double volume,
                                      const gas::ValveFlow& f, const ValveOptions& options) {
  std::vector<run::Transfers> out;
  const auto add = [&](std::string words, gas::Exchange exchange) {
    out.push_back({std::move(words), gas::transfers(valve.flow, air, volume, f, exchange)});
  };
  if (!options.exponent.empty()) {
    const Range exponents{1, gas::heat_capacity_ratio, "isothermal to adiabatic"};
    air.polytropic_exponent =
        argument("--exponent", options.exponent, "1", air.atmosphere, exponents);
    add(fmt::format("exponent {:.4g}", air.polytropic_exponent), gas::Exchange::polytrope);
    return out;
  }
  if (!options.wall_time.empty())
    air.wall_time = argument("--wall-time", options.wall_time, "s", air.atmosphere,
                             above_zero(3600, "longer walls are adiabatic"));
  add("adiabatic walls", gas::Exchange::adiabatic);
  if (air.wall_time > 0)
    add(fmt::format("walls of {:.4g} ms", 1e3 * air.wall_time), gas::Exchange::walls);
  add("isothermal walls", gas::Exchange::isothermal);
  return out;
}

ExitCode run_valve(const ValveOptions& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const gas::Valve& valve = config::named(file.experiment.valves, options.name, "NAME", "valve");
  const double up =
      argument("--upstream", options.upstream, "Pa abs", air.atmosphere, air_pressure);
  const double down =
      argument("--downstream", options.downstream, "Pa abs", air.atmosphere, air_pressure);

  const gas::ValveFlow f = gas::flow_through(valve.flow, air, up, down);
  std::vector<run::Transfers> times;
  double volume = 0;
  if (!options.volume.empty()) {
    volume = argument("--volume", options.volume, "m3", air.atmosphere,
                      above_zero(air_volume.high, air_volume.why));
    times = transfers(valve, air, volume, f, options);
  }
  const std::vector<run::Delivered> duties = deliveries(valve, options);

  if (const std::string doubt = run::doubt_of(valve, f); !doubt.empty())
    Messages(options.quiet).warning(doubt);
  if (options.json) {
    fmt::print("{}\n", (Json::parse(run::json_of(valve, f, times, duties))).text(2));
    return ok;
  }
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si);
  const units::ShownUnits* shown = asked.asked ? &asked.units : nullptr;
  fmt::print("{}{}{}", run::text_of(valve, f, shown),
             run::text_of(times, volume, f, shown, air.atmosphere),
             run::text_of(duties, options.frequency));
  return ok;
}

}  // namespace

void add_valve(CLI::App& app, Action& action) {
  auto options = std::make_shared<ValveOptions>();
  CLI::App& sub =
      subcommand(app, "valve", "flow, filling times and delays of a valve",
                 "sinew valve robots/leg/valves.toml inlet --upstream \"100 psi gauge\" "
                 "--downstream \"0 psi gauge\" --volume \"1 in3\"");
  sub.add_option("FILE", options->file, "valves, robot or experiment file")->required();
  sub.add_option("NAME", options->name, "of the valve")->required();
  sub.add_option("--upstream", options->upstream, "pressure, gauge or abs")->required();
  sub.add_option("--downstream", options->downstream, "pressure, gauge or abs")->required();
  CLI::Option* volume =
      sub.add_option("--volume", options->volume, "rigid, to be filled and vented");
  CLI::Option* walls =
      sub.add_option("--wall-time", options->wall_time,
                     "of the heat between its air and walls; else both limits, or the file's");
  walls->needs(volume);
  sub.add_option("--exponent", options->exponent, "by a polytrope, as the air of a muscle's file")
      ->needs(volume)
      ->excludes(walls);
  CLI::Option* duty =
      sub.add_option("--duty", options->duty, "share of the period, or from:to:step");
  sub.add_option("--frequency", options->frequency, "of the pulses; 100 Hz")->needs(duty);
  add_units(sub, options->units, "of what is printed; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_valve(*options); }; });
}

}  // namespace sinew::cli
