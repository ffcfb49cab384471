// cli/identify.cpp - `sinew identify`: from measurements to parameter files; `sinew force-beam`.
//
// The options of a method come from the rows of its settings (identify/task/settings.h), and every
// method runs through run_method(). A method that differs from the others has an overload.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/task/inputs.h"
#include "sinew/identify/task/methods.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/recording/recorded.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

constexpr run::FileKind page_file{
    .what = "page of `sinew identify`",
    .name = "such a page",
    .mark = "\"sinew.fit/",
    .otherwise = "another one, or --no-report",
};
constexpr run::FileKind parameter_file{"parameter file", "a parameter file", "format=\"sinew."};
constexpr run::FileKind plan_file{"plan", "a plan", "#Planof`sinewidentifyplan`"};
constexpr run::FileKind template_file{"template of `sinew identify`", "a template",
                                      "#For`sinewidentify"};
constexpr run::FileKind timing_file{"table of a valve's timing", "such a table", "0,0,",
                                    run::FileKind::At::start};

// Options for reading files of measurements.
struct DataOptions {
  std::vector<std::string> files;
  TableOptions table;
  identify::Source how;  // the settings of table options
  std::string atmosphere = "14.7 psi";
};

// Options for printing and writing a result.
struct ResultOptions : Flags {
  std::string out;          // the parameter file
  std::string second_file;  // another file that some methods write
  std::string report;       // the page; empty: next to `out`
  std::string units;        // for printing; empty: the method's own
  bool no_report = false;
};

// All of one method.
template <class Settings>
struct Options {
  DataOptions data;
  ResultOptions result;
  Settings settings;
};

// Holds the parts of a method's help that are not its settings, and which outputs it has.
struct MethodHelp {
  std::string_view method, example;
  std::string_view out = "FILE: parameter file to write";  // empty: it writes none
  bool page = true, units = true;
};
constexpr MethodHelp methods[] = {
    {"geometry", "sinew identify geometry --trapezoids 37,16 --side \"0.057 in\""},
    {"sensor", "sinew identify sensor weights.csv --map load=weight -o my-sensors.toml"},
    {"dynamic",
     "sinew identify dynamic a.csv b.csv --actuator robots/leg/actuator.toml --mass \"6 lb,11 lb\" "
     "--pressure \"60 psi gauge,80 psi gauge\" --external-volume \"0.114 in3\" -o bpa.toml"},
    {"joint",
     "sinew identify joint knee.csv --actuator robots/leg/actuator.toml --load \"5 lb\" --lever "
     "\"6 in\" --rest-angle \"310 deg\" --joint knee --base robots/leg/robot.toml -o mine.toml"},
    {"pair", "sinew identify pair moved.csv --hold-out \"7 s..\" --freeze \"delay=0 s\""},
    {"valve", "sinew identify valve fill.csv --volume \"0.5 L\" -o my-valve.toml"},
    {"static",
     "sinew identify static map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
     "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\" -o my-actuator.toml"},
    {"creep", "sinew identify creep hold.csv", ""},
    {"check",
     "sinew identify check map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
     "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\"",
     "", false, false},
    {"scale", "sinew identify scale my-actuator.toml --rest-length \"120 mm\" -o short.toml",
     "FILE: actuator file to write", false, false},
    {"run",
     "sinew run experiments/one-joint.toml -o runs/bench\n  sinew identify run runs/bench --base "
     "robots/one-joint/robot.toml -o mine.toml\n  sinew identify run runs/bench --fit "
     "friction,valve.inlet.closing_delay --hold-out \"30 %\""},
    {"plan",
     "sinew identify plan --rest-length \"250 mm\" --diameter \"10 mm\" --pressure \"600 kPa "
     "gauge\" --error \"2 %\" -o plan.csv\n  sinew identify plan forces.csv --error \"1.5 %\"",
     "FILE: CSV file to write, with a row to fill in for each reading", false},
};

// --- the options of a line ---

using Row = identify::Setting;

// Refuses what concerns the parameter file alone where none is written. A visitor.
struct NeedsOut : config::RowVisitor<NeedsOut> {
  void row(const Row& row, const std::string& value) const {
    if (row.is_of_file && !value.empty())
      config::fail({"--" + std::string(row.name), 0, 0}, "", "no --out",
                   "a file in which to name the base");
  }
  void row(const Row& row, const auto&) const { (void)row; }
};

void add_data_options(CLI::App& sub, identify::Tables tables, DataOptions& options) {
  if (tables == identify::Tables::none) return;
  sub.add_option("DATA", options.files, "CSV files of measurements, or run folders")
      ->required(tables == identify::Tables::needed);
  add_table_options(sub, options.table, options.how);
  sub.add_option("--atmosphere", options.atmosphere, "QUANTITY: room pressure, the zero of gauges")
      ->capture_default_str();
}

void add_outputs(CLI::App& sub, const MethodHelp& help, ResultOptions& result) {
  if (!help.out.empty()) sub.add_option("-o,--out", result.out, std::string(help.out));
  add_flags(sub, result,
            help.page          ? "replace existing files"
            : help.out.empty() ? ""
                               : "replace an existing file",
            "print the result as JSON, in SI", "print only the result and errors");
  result.no_report = !help.page;
  if (help.page) {
    CLI::Option* page = sub.add_option(
        "--report", result.report,
        "FILE: page to write, with the data and the models; default: next to --out, as .html");
    sub.add_flag("--no-report", result.no_report, "write no page")->excludes(page);
  }
  if (help.units)
    add_units(sub, result.units, "printed numbers (default: the method's own); files are in SI");
}

// Adds a second file that a method writes.
template <class Settings>
void add_second_file(CLI::App& sub, const Settings&, std::string& file) {
  if constexpr (std::is_same_v<Settings, identify::JointSettings>)
    sub.add_option("--actuator-out", file, "FILE: actuator file to write");
  if constexpr (std::is_same_v<Settings, identify::ValveSettings>)
    sub.add_option(
        "--predict-dat", file,
        "FILE: predict.dat to write: ticks at which the valve opens and shuts for each duty, "
        "compensated for the delays");
}

// Refuses options that do not go together, as wrong usage.
template <class Settings>
void refuse_together(const Options<Settings>&) {}

void refuse_together(const Options<identify::GeometrySettings>& options) {
  const bool counted = !options.settings.trapezoids.empty();
  if (options.data.files.empty() != counted)
    refuse("DATA", counted ? "a file together with --trapezoids" : "no file",
           "either a file of lengths and diameters, or --trapezoids");
  if (counted && !options.result.report.empty())
    refuse("--report", "--trapezoids with it", "a file of lengths and diameters, to show it");
  if (counted && options.settings.side.empty())
    require("--side", "the side of one trapezoid, with --trapezoids");
}

// --- tables ---

// Returns the texts of "force=F_N,length=Lage, mm": a comma separates two pairs where a pair
// follows; else it is of a name.
std::vector<std::string> split_pairs(const std::vector<std::string>& texts) {
  std::vector<std::string> out;
  for (const std::string& text : texts) {
    std::istringstream pieces(text + ",");
    const std::size_t before = out.size();
    for (std::string piece; std::getline(pieces, piece, ',');)
      if (out.size() == before || piece.find('=') != piece.npos)
        out.push_back(piece);
      else
        out.back() += "," + piece;
  }
  return out;
}

// One source per file. A --value may also be of the files that are held out. Throws config::Error
// for what is no name=value, and for a --value of no file.
std::vector<identify::Source> sources_of(const DataOptions& options,
                                         const std::vector<std::string>& held_out = {}) {
  identify::Source how = options.how;
  const TableOptions& table = options.table;
  const auto take = [](const char* option, const std::vector<std::string>& texts,
                       std::map<std::string, std::string>& into) {
    for (const auto& [name, value] : pairs_of(option, texts)) into[name] = value;
  };
  take("--map", split_pairs(table.maps), how.names);
  take("--unit", table.units, how.units);
  take("--where", table.where, how.where);
  take("--offset", table.offsets, how.offsets);
  how.values = table.values;
  std::vector<std::string> files = options.files;
  for (const std::string& text : held_out)  // or the words of a rule, "level"
    if (std::filesystem::exists(text)) files.push_back(text);
  recording::check_stated(how.values, files);
  how.columns = config::at_commas(table.columns);
  how.rate = table.rate;
  how.atmosphere = identify::atmosphere_setting(options.atmosphere);
  return identify::sources_of(options.files, how);
}

// Returns the files that are read: a run's method reads the run.
template <class Settings>
DataOptions read_by(const Options<Settings>& options) {
  DataOptions out = options.data;
  if constexpr (requires { options.settings.run; }) out.files = {options.settings.run};
  return out;
}

template <class Settings>
std::vector<std::string> held_out_by(const Settings& settings) {
  if constexpr (requires { settings.hold_out.texts; })
    return settings.hold_out.texts;
  else if constexpr (requires { settings.how.hold_out; })
    return settings.how.hold_out.texts;
  else
    return {};
}

// --- files ---

// Returns the page that is to be written: that of --report, or the parameter file's name with
// .html; empty: none.
std::string page_of(const ResultOptions& options) {
  if (options.no_report) return "";
  if (!options.report.empty()) return options.report;
  if (options.out.empty() || !report::has_page()) return "";
  return std::filesystem::path(options.out).replace_extension(".html").string();
}

// Refuses files that exist already, before the work begins.
void check_outputs(const ResultOptions& options, const run::FileKind& out = parameter_file,
                   const std::vector<std::string>& inputs = {}) {
  if (const std::string page = page_of(options); !page.empty()) {
    report::require_page(page);
    if (page == options.out)
      config::fail({"--out", 0, 0}, "", config::in_quotes(options.out) + ", the page's name too",
                   "a parameter file, such as mine.toml", "another name, or --no-report");
    run::refuse_to_overwrite(page, options.force, page_file);
    run::require_folder_of(page);
  }
  if (options.out.empty()) return;
  run::refuse_to_overwrite(options.out, options.force, out, {inputs.begin(), inputs.end()});
  run::require_folder_of(options.out);
}

// Writes the files of further muscles next to that of the first one.
void write_further(const identify::Found& found, const ResultOptions& options) {
  const std::filesystem::path out(options.out);
  for (std::size_t i = 1; i < found.files.size() && !options.out.empty(); ++i) {
    const std::string& suffix = found.files[i].suffix;
    if (suffix.empty()) continue;
    const std::string file =
        out.parent_path() / (out.stem().string() + suffix + out.extension().string());
    run::refuse_to_overwrite(file, options.force, parameter_file);
    write_output(file, found.file(file, i), options.quiet);
  }
}

// Refuses the second file of a method where it exists already.
template <class Settings>
void check_second_file(const Options<Settings>& options) {
  const std::string& file = options.result.second_file;
  if (file.empty()) return;
  run::require_folder_of(file);
  if (std::is_same_v<Settings, identify::JointSettings>)
    return run::refuse_to_overwrite(file, options.result.force, parameter_file);
  identify::refuse_fitted(sources_of(options.data), "predict_dat", file);
  run::refuse_to_overwrite(file, options.result.force, timing_file);
}

// Writes the second file of a method.
void write_second_file(const identify::Found&, const ResultOptions&) {}

void write_second_file(const identify::JointFound& found, const ResultOptions& options) {
  write_output(options.second_file, found.file(options.second_file, 1), options.quiet);
}

// The compensated table, where the delays are known.
void write_second_file(const identify::ValveFound& found, const ResultOptions& options) {
  if (options.second_file.empty() || !found.refused.empty()) return;
  const identify::TimingFile timing = identify::timing_of(found);
  run::write_file(options.second_file, timing.text);
  Messages(options.quiet)
      .note(
          fmt::format("{}: written for {:g} Hz; the delivered duty differs from the commanded one "
                      "by {:.1f} % at most",
                      options.second_file, timing.frequency, 100 * timing.worst));
}

// --- a method from its options to its files ---

template <class Settings>
auto find(const Options<Settings>& options, const identify::MethodRow& row) {
  Settings settings = options.settings;
  std::vector<identify::Source> sources;
  if (row.tables != identify::Tables::none)
    sources = sources_of(options.data, held_out_by(settings));
  if constexpr (requires { settings.tried; }) {
    host::Tally tried = 0;
    const ProgressBar bar(tried, static_cast<std::int64_t>(row.laws), {.unit = "laws"},
                          options.result.quiet);
    settings.tried = &tried;
    return identify::find(sources, settings);
  } else {
    constexpr bool reports_progress = requires { settings.progress; };
    if constexpr (reports_progress)
      settings.progress = [&](const std::string& what) {
        Messages(options.result.quiet).note(what);
      };
    const ProgressBar bar(options.result.quiet || reports_progress);
    return identify::find(sources, settings);
  }
}

auto find(const Options<identify::PlanSettings>& options, const identify::MethodRow&) {
  const ProgressBar bar(options.result.quiet);
  return identify::find(sources_of(options.data), options.settings,
                        identify::atmosphere_setting(options.data.atmosphere));
}

// Writes the files and the page, and prints the result: files come first, as a reader that ends
// early, such as head, ends the program.
ExitCode report(const identify::Found& found, const DataOptions& data,
                const ResultOptions& options) {
  write_further(found, options);
  const std::string file = found.own_file(options.out);
  const Messages messages(options.quiet);
  for (const std::string& note : found.remarks.notes) messages.note(note);
  for (const std::string& warning : found.remarks.warnings) messages.warning(warning);
  if (!file.empty()) write_output(options.out, file, options.quiet);
  const double atmosphere = identify::atmosphere_setting(data.atmosphere);
  const std::string page = page_of(options);
  if (!page.empty() && !found.reports.empty())
    write_output(page, found.page(sources_of(data), atmosphere, SINEW_VERSION, options.out),
                 options.quiet);
  if (options.json)
    fmt::print("{}\n", found.json.text(2));
  else
    fmt::print("{}", as_options(found.text({chosen_units(options.units, units::UnitSet::si),
                                            atmosphere, width_of_output()})));
  if (!found.refused.empty()) error(found.refused);
  return found.fails || !found.refused.empty() ? failed : ok;
}

template <class Settings>
ExitCode run_method(const Options<Settings>& options, const identify::MethodRow& row) {
  const bool plan = std::is_same_v<Settings, identify::PlanSettings>;
  check_outputs(options.result, plan ? plan_file : parameter_file,
                plan ? options.data.files : std::vector<std::string>());
  Settings settings = options.settings;
  NeedsOut needs;
  if (options.result.out.empty()) fields(needs, settings);
  check_second_file(options);
  const auto found = find(options, row);
  write_second_file(found, options.result);
  return report(found, read_by(options), options.result);
}

template <class Settings>
void add_method(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options<Settings>>();
  const identify::MethodRow row = identify::SettingList(options->settings).of;
  const MethodHelp& help = *std::ranges::find(methods, row.name, &MethodHelp::method);
  CLI::App& sub = subcommand(app, row.name, row.doc, help.example);
  add_data_options(sub, row.tables, options->data);
  SettingOptions rows(sub);
  fields(rows, options->settings);
  add_second_file(sub, options->settings, options->result.second_file);
  add_outputs(sub, help, options->result);
  sub.callback([options, row, &action] {
    refuse_together(*options);
    action = [options, row] { return run_method(*options, row); };
  });
}

// --- columns ---

struct ColumnsOptions : Flags {
  std::string method, kind, file;
};

ExitCode run_columns(const ColumnsOptions& options) {
  const identify::MethodInputs& inputs = identify::inputs_of(options.method);
  const std::string text = identify::template_of(inputs, options.kind);  // refuses an unknown kind
  if (options.file.empty()) {
    fmt::print("{}", options.json ? to_json(inputs).text(2) + "\n"
                                  : as_options(identify::text_of(inputs)));
    return ok;
  }
  run::refuse_to_overwrite(options.file, options.force, template_file);
  write_output(options.file, text, options.quiet);
  return ok;
}

void add_columns(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "columns", "List the columns a method reads, or write a template",
                             "sinew identify columns static --template forces.csv");
  ColumnsOptions& options = runs(sub, action, run_columns);
  std::vector<std::string> names;
  for (const identify::MethodInputs& inputs : identify::method_inputs())
    names.emplace_back(inputs.method);
  sub.add_option("METHOD", options.method, "method")->required()->check(one_of(names));
  sub.add_option("--kind", options.kind, "KIND: kind of table, if a method has several: chart");
  sub.add_option("--template", options.file, "FILE: CSV file to write, to fill in");
  add_flags(sub, options, "replace an existing file", "print the result as JSON");
}

// --- force-beam ---

struct ForceBeamOptions : Flags {
  identify::TransducerSettings settings;
  std::string units;
};

ExitCode run_force_beam(const ForceBeamOptions& options) {
  const identify::Transducer s = transducer_of(options.settings);
  const std::optional<double> wanted = wanted_sensitivity(options.settings);
  if (options.json) {
    fmt::print("{}\n", json_of(s, wanted));
    return ok;
  }
  const config::UnitsToShow units = chosen_units(options.units, units::UnitSet::si);
  fmt::print("{}", text_of(s, units.requested()));
  if (wanted)
    fmt::print("\n{} with the gages, from the load:\n{}", options.settings.sensitivity,
               text_of_places(s, *wanted, units.requested()));
  for (const std::string& doubt : doubts(s)) Messages(options.quiet).warning(doubt);
  return ok;
}

}  // namespace

void add_identify(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "identify", "Turn measurements into parameter files",
                             "sinew identify geometry mesh.csv -o my-actuator.toml");
  sub.require_subcommand();
  identify::for_each_method(
      [&]<class Settings>(const Settings&) { add_method<Settings>(sub, action); });
  add_columns(sub, action);
}

void add_force_beam(CLI::App& app, Action& action) {
  const identify::MethodRow row = identify::SettingList(identify::TransducerSettings()).of;
  CLI::App& sub =
      subcommand(app, row.name, row.doc,
                 "sinew force-beam --load \"20 lbf\" --gain 400 --sensitivity \"0.1 V/lbf\"");
  ForceBeamOptions& options = runs(sub, action, run_force_beam);
  SettingOptions rows(sub);
  fields(rows, options.settings);
  add_units(sub, options.units, "printed numbers (default: SI and inches); --json is in SI");
  add_flags(sub, options, "", "print the result as JSON, in SI");
}

}  // namespace sinew::cli
