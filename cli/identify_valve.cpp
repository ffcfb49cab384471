// cli/identify_valve.cpp - `sinew identify valve`: flow and delays of a valve.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/terminal.h"
#include "sinew/identify/task/tables.h"
#include "sinew/identify/task/valve_task.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

struct IdentifyValveOptions {
  DataOptions data;
  ResultOptions result;
  identify::ValveSettings settings;
  std::string hold_out, predict;
};

// The compensated table, where one is wanted and the delays are known.
void write_timing(const IdentifyValveOptions& options, const identify::ValveFound& found) {
  if (options.predict.empty()) return;
  const identify::TimingFile timing = identify::timing_of(found, options.settings.frequency);
  run::write_file(options.predict, timing.text);
  Messages(options.result.quiet)
      .note(
          fmt::format("{}: written for {:g} Hz; the delivered duty differs from the commanded one "
                      "by {:.1f} % at most",
                      options.predict, timing.frequency, 100 * timing.worst));
}

ExitCode run_identify_valve(const IdentifyValveOptions& options) {
  const std::vector<identify::Source> sources = sources_of(options.data, {options.hold_out});
  identify::refuse_fitted(sources, "predict_dat", options.predict);
  identify::ValveSettings settings = options.settings;
  if (!options.hold_out.empty())
    settings.held_out = identify::beside(sources, "hold_out", options.hold_out);
  const identify::ValveFound found = identify::find_valve(sources, settings);
  const identify::ValveResult& valve = found.result;
  const ResultOptions& result = options.result;
  if (valve.refused.empty()) {
    write_timing(options, found);
    tell(valve.report, result.out.empty() ? "" : found.file(result.out), options.data, result,
         to_json(found));
    return ok;
  }
  tell(valve.report, "", options.data,
       {.report = page_of(result), .json = result.json, .quiet = result.quiet}, to_json(found));
  error(valve.refused);
  return failed;
}

}  // namespace

void add_identify_valve(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyValveOptions>();
  Command sub =
      identify.subcommand("valve",
                          "flow and delays, from a chart, a filling, pulses, a coil's current "
                          "or a map of duties",
                          "sinew identify valve fill.csv --volume \"0.5 L\" -o my-valve.toml");
  add_data_options(sub, options->data);
  sub.add_option("--kind", options->settings.kind, "what was measured; absent: by the columns")
      .is_one_of({"chart", "fill", "pulses", "coil", "duty"});
  sub.add_option("--volume", options->settings.volume,
                 "fill, pulses: of the chamber, hoses included");
  sub.add_option("--conductance", options->settings.conductance,
                 "fill, pulses: of the valve, for the volume instead");
  sub.add_option("--added-volume", options->settings.added_volume,
                 "fill: joined to the chamber, of each file: \"0 L,0.5 L\"; two fillings tell "
                 "conductance and volume apart")
      .takes_one();
  sub.add_flag("--per-volume", options->settings.per_volume, "fill, pulses: C/V is enough");
  sub.add_option("--supply,--port", options->settings.port,
                 "pressure on the valve's other side, the room's when venting; fitted without");
  sub.add_option("--exponent", options->settings.exponent,
                 "fill: polytropic, of the chamber: 1 isothermal, 1.4 adiabatic; tried without");
  sub.add_option("--temperature", options->settings.temperature, "of the air").show_default();
  sub.add_option("--hold-out", options->hold_out, "OTHER.csv that scores the model of a filling");
  sub.add_option("--name", options->settings.name, "of the valve").show_default();
  sub.add_option("--base", options->settings.base,
                 "VALVES.toml with --name in it: what is not identified is kept from there");
  sub.add_option("--frequency", options->settings.frequency,
                 "of the pulses: of a map of duties without "
                 "such a column, and of --predict-dat");
  sub.add_option("--predict-dat", options->predict,
                 "FILE for the duties' opening and closing ticks, compensated for the delays");
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      if (!options->predict.empty())
        run::refuse_to_overwrite(options->predict, options->result.force);
      return run_identify_valve(*options);
    };
  });
}

}  // namespace sinew::cli
