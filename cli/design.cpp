// cli/design.cpp - `sinew design`: from what a robot has to do to its parts.
//
// The options of a calculation come from the rows of its settings (design/settings.fields.h).
#include <fmt/format.h>

#include <algorithm>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/design/methods.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

constexpr run::FileKind design_page{"page of `sinew design`", "such a page",
                                    "\"sinew.design_page/"};
constexpr run::FileKind robot_file{"robot file", "a robot file", "format=\"sinew.robot/"};

// Holds the parts of a calculation's help that are not its settings; `out`: the file that it
// writes, empty: none.
struct DesignHelp {
  std::string_view method, example, out = "";
};
constexpr DesignHelp designs[] = {
    {"joint",
     "sinew design joint --actuator robots/leg/actuator.toml --torque \"20 lbf in\" --angles "
     "\"40 deg\" --motion \"80 deg\" --pressure \"100 psi gauge\" --moment-arm \"1 in\"",
     "FILE: robot file to write: that of --base with the new values"},
    {"valve",
     "sinew design valve --volume \"50 mL\" --supply \"6 bar gauge\" --pressure \"4 bar gauge\" "
     "--fill-time \"100 ms\" --frequency \"50 Hz\""},
    {"air",
     "sinew design air --use runs/walk-test-1/1 --volume \"1 L\" --pressure \"200 bar gauge\" "
     "--mass "
     "\"0.9 kg\""},
    {"life",
     "sinew design life --actuator robots/leg/actuator.toml --contraction \"20 %\" --cycles "
     "\"0.4 Hz\" --muscles 8 --duration \"10 min\""},
};

template <class Settings>
struct DesignOptions : Flags {
  Settings settings;
  std::string out, report, units;
};

// Warns if the robot that was written cannot be simulated, such as one whose sensor would leave its
// converter's range.
void warn_of_errors(const std::string& robot, const Messages& messages) {
  try {
    (void)experiment::load_machine_file(robot);
  } catch (const config::Error& e) {
    messages.warning(
        fmt::format("{} cannot be simulated before these errors are mended:\n{}", robot, e.what()));
  }
}

template <class Settings>
ExitCode run_design(const DesignOptions<Settings>& options) {
  if (!options.report.empty()) {
    report::require_page(options.report);
    if (options.report == options.out)
      config::fail({"--report", 0, 0}, "",
                   config::in_quotes(options.report) + ", the name of --out too",
                   "a name of its own, such as page.html");
    run::refuse_to_overwrite(options.report, options.force, design_page);
  }
  // Only the design of a joint makes a robot file.
  if constexpr (requires { options.settings.base; })
    if (!options.out.empty())
      run::refuse_to_overwrite(options.out, options.force, robot_file,
                               {options.settings.actuator, options.settings.base});
  const design::Result result = design::design(options.settings);
  const Messages messages(options.quiet);
  for (const std::string& warning : result.warnings) messages.warning(warning);
  if (result.refused.empty() && !options.out.empty()) {
    if (!result.file)
      config::fail(
          {"--out", 0, 0}, "", "no robot file to write",
          "--base, the robot file whose joint is designed, a cam, and the muscle as in its file");
    write_output(options.out, result.file(options.out), options.quiet);
    warn_of_errors(options.out, messages);
  }
  if (!options.report.empty())
    write_output(options.report, design::page_of(result, units::atmosphere, SINEW_VERSION),
                 options.quiet);
  if (options.json) {
    fmt::print("{}\n", design::to_json(result).text(2));
  } else if (result.refused.empty()) {
    config::UnitsToShow units = chosen_units(options.units, units::UnitSet::metric);
    units.is_requested = true;
    fmt::print("{}",
               as_options(design::text_of(result, {units, units::atmosphere, width_of_output()})));
  }
  if (!result.refused.empty()) error(result.refused);
  return result.refused.empty() ? ok : failed;
}

template <class Settings>
void add_calculation(CLI::App& app, Action& action) {
  const config::MethodRow row = config::SettingList(Settings()).of;
  const DesignHelp& help = *std::ranges::find(designs, row.name, &DesignHelp::method);
  CLI::App& sub = subcommand(app, row.name, row.doc, help.example);
  DesignOptions<Settings>& options = runs(sub, action, run_design<Settings>);
  SettingOptions rows(sub);
  fields(rows, options.settings);
  if (!help.out.empty()) sub.add_option("-o,--out", options.out, std::string(help.out));
  sub.add_option("--report", options.report, "FILE: page to write, with tables and plots");
  add_units(sub, options.units, "printed numbers (default: metric); --json is in SI");
  add_flags(sub, options, "replace an existing file", "print the result as JSON, in SI",
            "print only the result and errors");
}

}  // namespace

void add_design(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "design", "Choose muscles, valves and air for a robot on paper",
                             designs[0].example);
  sub.require_subcommand();
  design::for_each_design(
      [&]<class Settings>(const Settings&) { add_calculation<Settings>(sub, action); });
}

}  // namespace sinew::cli
