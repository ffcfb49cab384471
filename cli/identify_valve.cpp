// cli/identify_valve.cpp - `sinew identify valve`: flow and delays of a valve.
#include <fmt/format.h>

#include <array>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/valve/timing.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

using identify::ValveData;

constexpr std::array<std::pair<const char*, ValveData>, 5> kinds{{{"chart", ValveData::chart},
                                                                  {"fill", ValveData::fill},
                                                                  {"pulses", ValveData::pulses},
                                                                  {"coil", ValveData::coil},
                                                                  {"duty", ValveData::duty}}};

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string name = "valve", kind, volume, conductance, port, frequency, hold_out, base;
  std::string temperature = "20 degC", exponent, predict;
  bool per_volume = false;
};

identify::ValveOptions valve_options(const Options& o, double atmosphere) {
  identify::ValveOptions out{.name = o.name};
  out.valve.profile = gas::Valve::Profile::ideal;
  if (!o.base.empty()) {
    const auto file = experiment::load_machine_file(o.base);
    out.valve = config::named(file.experiment.valves, o.name, "--name", "valve");
    out.provenance = identify::Provenance(file.experiment.origins, o.base);
  }
  out.air.atmosphere = atmosphere;
  out.air.temperature = argument("--temperature", o.temperature, "K", atmosphere,
                                 {200, 400, "of air in a laboratory"});
  const auto optional = [&](const char* option, const std::string& text, const char* unit,
                            const Range& range) {
    std::optional<double> value;
    if (!text.empty()) value = argument(option, text, unit, atmosphere, range);
    return value;
  };
  out.volume = optional("--volume", o.volume, "m3", above_zero(air_volume.high, air_volume.why));
  out.conductance = optional("--conductance", o.conductance, "m3/(s Pa)",
                             above_zero(1, "a valve of this size fills a hall"));
  out.port = optional("--supply", o.port, "Pa abs", air_pressure);
  out.frequency = optional("--frequency", o.frequency, "Hz", pulses);
  out.exponent = optional("--exponent", o.exponent, "1", polytropic);
  out.per_volume = o.per_volume;
  return out;
}

ValveData kind_of(const Options& options, const identify::Measured& data) {
  for (const auto& [word, kind] : kinds)
    if (options.kind == word) return identify::valve_data(data, kind);
  return identify::valve_data(data);
}

identify::ValveResult identified(const Options& options, const identify::Source& source) {
  const identify::Measured data = identify::read_measured(source, identify::valve_columns());
  const identify::ValveOptions how = valve_options(options, source.atmosphere);
  switch (kind_of(options, data)) {
    case ValveData::chart:
      return identify::identify_chart(data, how);
    case ValveData::pulses:
      return identify::identify_pulses(data, how);
    case ValveData::coil:
      return identify::identify_coil(data, how);
    case ValveData::duty:
      return identify::identify_duty(data, how);
    case ValveData::fill:
      break;
  }
  if (options.hold_out.empty()) return identify::identify_fill(data, how);
  refuse_data_file("--hold-out", options.hold_out, options.data);
  identify::Source other = source;
  other.path = options.hold_out;
  const identify::Measured unseen = identify::read_measured(other, identify::valve_columns());
  return identify::identify_fill(data, how, &unseen);
}

// A valve without a flow is none that a simulation could use.
std::string file_of(const Options& options, const identify::ValveResult& found) {
  if (options.result.out.empty()) return {};
  const gas::Flow& flow = found.valve.flow;
  if (!(flow.area > 0) && !(flow.sonic_conductance > 0))
    throw identify::Refusal(options.result.out, "delays, but no flow of the valve",
                            "both for a file",
                            "--base VALVES.toml --name NAME, whose flow is kept");
  return identify::valve_file(found.valve, found.provenance);
}

// The compensated table, where one is wanted and the delays are known.
void write_timing(const Options& options, const identify::ValveResult& found) {
  if (options.predict.empty()) return;
  if (!found.opening_known || !found.closing_known)
    throw identify::Refusal("--predict-dat", "no opening and closing delay", "both",
                            "a map of duties, or pulses and their pressure");
  const double frequency =
      argument("--frequency", options.frequency.empty() ? "100 Hz" : options.frequency, "Hz",
               units::atmosphere, pulses);
  const identify::CompensatedTiming timing =
      identify::compensated(found.valve.opening_delay, found.valve.closing_delay, frequency);
  run::write_file(options.predict, identify::predict_dat(timing.timing));
  Messages(options.result.quiet)
      .note(
          fmt::format("{}: written for {:g} Hz; the delivered duty differs from the commanded one "
                      "by {:.1f} % at most",
                      options.predict, frequency, 100 * timing.worst));
}

ExitCode run_identify_valve(const Options& options) {
  const std::vector<identify::Source> sources = sources_of(options.data);
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", fmt::format("{} files", sources.size()), "one");
  const identify::ValveResult found = identified(options, sources[0]);
  const ResultOptions& result = options.result;
  if (found.refused.empty()) {
    tell(found.report, file_of(options, found), options.data, result);
    write_timing(options, found);
    return ok;
  }
  tell(found.report, "", options.data,
       {.report = page_of(result), .json = result.json, .quiet = result.quiet},
       {{"refused", found.refused}});
  error(found.refused);
  return failed;
}

}  // namespace

void add_identify_valve(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub =
      identify.subcommand("valve",
                          "flow and delays, from a chart, a filling, pulses, a coil's current "
                          "or a map of duties",
                          "sinew identify valve fill.csv --volume \"0.5 L\" -o my-valve.toml");
  add_data_options(sub, options->data);
  sub.add_option("--kind", options->kind, "what was measured; absent: by the columns")
      .is_one_of({"chart", "fill", "pulses", "coil", "duty"});
  sub.add_option("--volume", options->volume, "fill, pulses: of the chamber, hoses included");
  sub.add_option("--conductance", options->conductance,
                 "fill, pulses: of the valve, for the volume instead");
  sub.add_flag("--per-volume", options->per_volume, "fill, pulses: C/V is enough");
  sub.add_option("--supply,--port", options->port,
                 "pressure on the valve's other side, the room's when venting; fitted without");
  sub.add_option("--exponent", options->exponent,
                 "fill: polytropic, of the chamber: 1 isothermal, 1.4 adiabatic; tried without");
  sub.add_option("--temperature", options->temperature, "of the air").show_default();
  sub.add_option("--hold-out", options->hold_out, "OTHER.csv that scores the model of a filling");
  sub.add_option("--name", options->name, "of the valve").show_default();
  sub.add_option("--base", options->base,
                 "VALVES.toml with --name in it: what is not identified is kept from there");
  sub.add_option("--frequency", options->frequency,
                 "of the pulses: of a map of duties without "
                 "such a column, and of --predict-dat");
  sub.add_option("--predict-dat", options->predict,
                 "FILE for the duties' opening and closing ticks, compensated for the delays");
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      refuse_data_file("--predict-dat", options->predict, options->data);
      if (!options->predict.empty())
        run::refuse_to_overwrite(options->predict, options->result.force);
      return run_identify_valve(*options);
    };
  });
}

}  // namespace sinew::cli
