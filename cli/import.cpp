// cli/import.cpp - `sinew import`: somebody's recording as the folder of a run.
#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "cli/option_groups.h"
#include "cli/run.h"
#include "cli/terminal.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/text_file.h"
#include "sinew/recording/number.h"
#include "sinew/run/folder/imported_run.h"
#include "sinew/run/setup/buildable.h"
#include "thesis/out_dat/out_dat.h"

namespace sinew::cli {

namespace {

struct ImportOptions {
  run::ImportRequest request;
  TableOptions table;
  std::vector<std::string> scales, shifts;  // "name=value"
  std::string join = "side";
  bool json = false, quiet = false;
};

struct Pair {
  std::string name, value;
};

// A unit or a value holds no "=", a column's name may.
Pair pair_at(std::size_t equals, const std::string& text, const char* option,
             const char* expected) {
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    config::fail({option, 0, 0}, "", config::in_quotes(text), expected);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void take_pairs(ImportOptions& options) {
  recording::Mapping& mapping = options.request.mapping;
  mapping.table = options.table.settings;
  mapping.table.columns = config::at_commas(options.table.columns);
  mapping.clock.rate = options.table.rate;
  options.request.values = options.table.values;
  for (const std::string& text : options.table.maps) {
    const Pair p =
        pair_at(text.find('='), text, "--map", "CHANNEL=COLUMN, /joint/elbow/angle=Winkel");
    map_channel(mapping, p.name, p.value);
  }
  for (const std::string& text : options.table.units) {
    const Pair p = pair_at(text.rfind('='), text, "--unit", "COLUMN=UNIT, Winkel=deg");
    map_unit(mapping, p.name, p.value);
  }
  for (const std::string& text : options.scales) {
    const Pair p = pair_at(text.rfind('='), text, "--scale", "COLUMN=NUMBER, Winkel=-1");
    const auto number = recording::number_in(p.value);
    if (!number) config::fail({"--scale", 0, 0}, "", config::in_quotes(p.value), "a number");
    map_scale(mapping, p.name, *number);
  }
  for (const std::string& text : options.table.offsets) {
    const Pair p = pair_at(text.rfind('='), text, "--offset", "COLUMN=VALUE, \"Winkel=90 deg\"");
    map_offset(mapping, p.name, p.value);
  }
  for (const std::string& text : options.table.where) {
    const Pair p = pair_at(text.find('='), text, "--where", "COLUMN=VALUE, test=3");
    map_where(mapping, p.name, p.value);
  }
  for (const std::string& text : options.shifts) {
    const Pair p = pair_at(text.rfind('='), text, "--shift", "FILE=TIME, \"force.csv=0.12 s\"");
    options.request.shifts[p.name] = p.value;
  }
}

bool is_out_dat(const std::string& path) {
  std::string begin(16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return thesis::is_out_dat(begin);
}

// The thesis's own log knows what its columns are.
run::Kept import_out_dat(const ImportOptions& options, const Messages& messages) {
  const run::ImportRequest& request = options.request;
  const std::string& path = request.files.front();
  if (request.files.size() > 1)
    config::fail({path, 0, 0}, "", "out.dat beside other files", "out.dat alone",
                 "an import of each");
  const experiment::Experiment e =
      run::buildable_robot(config::compose(request.experiment, request.sets), request.experiment);
  const signals::Table table =
      thesis::parse_out_dat(config::read_text_file(path, "a log out.dat"), path, e);
  experiment::ImportedFile file = run::imported_file(path, "out.dat");
  for (const signals::Series& s : table.series) {
    file.rows = std::max(file.rows, static_cast<int>(s.time_ns.size()));
    file.values += static_cast<int>(s.time_ns.size());
  }
  return run::keep_imported(table, e, {std::move(file)}, "",
                            {.folder = request.folder, .force = request.force}, messages.notices());
}

ExitCode tell_kept(const run::Kept& kept, const ImportOptions& options, const Messages& messages) {
  for (const std::string& text : kept.summary.warnings) messages.warning(text);
  if (options.json)
    fmt::print("{}", kept.json);
  else
    print_verdicts(kept.summary, kept.machine);
  messages.note(kept.folder.string());
  if (kept.page) note_page(kept.folder, messages);
  return ok;
}

// Returns the size of a recording that takes a while to read, 0 for any other and for several.
std::int64_t bytes_to_show(const std::vector<std::string>& files) {
  constexpr std::uintmax_t large = 50'000'000;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(files.front(), none);
  return files.size() == 1 && !none && size > large ? static_cast<std::int64_t>(size) : 0;
}

ExitCode import_recording(ImportOptions& options) {
  const Messages messages(options.quiet);
  take_pairs(options);
  options.request.join_at_end = options.join == "end";
  if (is_out_dat(options.request.files.front()))
    return tell_kept(import_out_dat(options, messages), options, messages);
  std::atomic<std::int64_t> read{0};
  options.request.read = &read;
  const ProgressBar bar(read, bytes_to_show(options.request.files),
                        {.each = 1e-6, .unit = "MB", .decimals = 0}, options.quiet);
  return tell_kept(run::import_run(options.request, messages.notices()), options, messages);
}

void add_mapping_options(CLI::App& sub, ImportOptions& options) {
  run::ImportRequest& request = options.request;
  add_table_options(sub, options.table);
  sub.add_option(
         "--scale", options.scales,
         "COLUMN=NUMBER: by which its numbers are multiplied, before --offset; -1 turns the "
         "sign; may be repeated")
      ->allow_extra_args(false);
  sub.add_option("--mapping", request.mapping_file,
                 "a file with these and the options of how a table is read, sinew.mapping/1");
  sub.add_option("--save-mapping", request.save_mapping, "write such a file, for the next time");
  sub.add_flag("--all", request.mapping.keep_others,
               "keep columns that are no channel, as /recorded/NAME");
}

void add_clock_options(CLI::App& sub, ImportOptions& options) {
  recording::ClockMapping& clock = options.request.mapping.clock;
  sub.add_option("--time", clock.column, "the column with the times; else time, t or such");
  sub.add_option("--time-unit", clock.unit, "of its numbers: ms");
  sub.add_option("--clock-scale", clock.scale,
                 "true seconds in a second of the recording's clock: 0.997");
  sub.add_option("--start", clock.start,
                 "the recording's time that becomes 0, \"12.5 s\"; else its first sample");
  sub.add_option("--join", options.join, "several files: side by side in time, or end to end")
      ->check(one_of({"side", "end"}));
  sub.add_option("--shift", options.shifts, "FILE=TIME: by which a file is later than it says")
      ->allow_extra_args(false);
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  auto options = std::make_shared<ImportOptions>();
  run::ImportRequest& request = options->request;
  CLI::App& sub = subcommand(
      app, "import", "a recording of a laboratory as the folder of a run",
      "sinew import rig.csv --experiment one-joint.toml --map /joint/elbow/angle=Winkel");
  sub.add_option("FILE", request.files,
                 "a table as CSV, a log as MCAP, a .mat of MATLAB, or the thesis's out.dat")
      ->required();
  sub.add_option("--experiment", request.experiment, "what was run: its robot or stand, its phases")
      ->required();
  add_mapping_options(sub, *options);
  add_clock_options(sub, *options);
  sub.add_option("-o,--output", request.folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", request.force, "replace the run that is in the folder");
  add_sets(sub, request.sets);
  sub.add_flag("--json", options->json, "print summary.json");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return import_recording(*options); }; });
}

}  // namespace sinew::cli
