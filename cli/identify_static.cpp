// cli/identify_static.cpp - `sinew identify static`: the static law of an actuator.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string name = "bpa", model, hold_out, actuator, rest_length, branch = "both";
  std::vector<std::string> lengths, fit_where;
};

constexpr Range actuator_length = above_zero(1000, "of an actuator");

// "205 mm" for all files, or "Kinked19=206 mm" for those whose name contains it.
double length_for(const std::vector<std::string>& lengths, const std::string& file,
                  double atmosphere) {
  double out = 0;
  for (const std::string& text : lengths) {
    const std::size_t equals = text.find('=');
    const std::string part = equals == text.npos ? "" : text.substr(0, equals);
    const std::string name = std::filesystem::path(file).filename().string();
    if (name.find(part) == name.npos) continue;
    out = argument("--length", equals == text.npos ? text : text.substr(equals + 1), "m",
                   atmosphere, actuator_length);
  }
  return out;
}

// A part of a name that no file has is a slip: its files would take another length.
void refuse_lengths_of_no_file(const Options& options) {
  std::vector<std::string> files = options.data.files;
  if (!options.hold_out.empty()) files.push_back(options.hold_out);
  for (const std::string& text : options.lengths) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos) continue;
    const std::string part = text.substr(0, equals);
    const bool any = std::ranges::any_of(files, [&](const std::string& file) {
      return std::filesystem::path(file).filename().string().find(part) != part.npos;
    });
    if (!any)
      config::fail({"--length", 0, 0}, "", config::in_quotes(text),
                   "a part of the name of one of the files");
  }
}

// Rows that --fit-where names are fitted; the others are held out.
void read_file(const Options& options, const identify::Source& source, bool fitted,
               identify::StaticData& data) {
  const double atmosphere = source.atmosphere;
  identify::StaticInput input{.length = length_for(options.lengths, source.path, atmosphere),
                              .fitted = fitted};
  if (!options.rest_length.empty()) {
    input.rest_length =
        argument("--rest-length", options.rest_length, "m", atmosphere, actuator_length);
  }
  const identify::Measured all = read_measured(source, identify::static_columns());
  const std::size_t before = data.points.size();
  add_points(all, input, data);
  if (options.fit_where.empty() || !fitted) return;

  identify::Source some = source;
  for (const std::string& text : options.fit_where) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos)
      config::fail({"--fit-where", 0, 0}, "", config::in_quotes(text), "NAME=VALUE,...");
    some.where[text.substr(0, equals)] = text.substr(equals + 1);
  }
  if (all.has("time"))
    config::fail({"--fit-where", 0, 0}, "", "a recording",
                 "a table; of recordings, --hold-out FILE");
  const identify::Measured few = read_measured(some, identify::static_columns());
  const std::set<int> lines(few.lines.begin(), few.lines.end());
  for (std::size_t i = 0; i < all.rows(); ++i)
    data.points[before + i].fitted = lines.contains(all.lines[i]);
}

// Points of one branch only; what has none stays.
void keep_branch(const std::string& word, identify::StaticData& data) {
  if (word == "both") return;
  const auto other = word == "fill" ? identify::Branch::vent : identify::Branch::fill;
  std::erase_if(data.points, [=](const identify::StaticPoint& p) { return p.branch == other; });
}

identify::StaticOptions options_of(const Options& options, double atmosphere) {
  identify::StaticOptions out{.atmosphere = atmosphere, .model = options.model};
  out.subject = "static law from " + options.data.files[0];
  if (options.data.files.size() > 1)
    out.subject += fmt::format(" and {} more", options.data.files.size() - 1);
  if (options.hold_out == "pressure") out.hold_out = identify::HoldOut::pressure;
  if (options.hold_out == "length") out.hold_out = identify::HoldOut::length;
  if (!options.actuator.empty()) {
    const auto file = experiment::load_machine_file(options.actuator);
    out.braid = config::named(file.experiment.actuators, "", "--actuator", "actuator").braid;
  }
  return out;
}

std::string file_of_muscle(const std::string& out, const identify::StaticMuscle& muscle) {
  const std::filesystem::path path(out);
  return (path.parent_path() / fmt::format("{}-{:.0f}mm{}", path.stem().string(),
                                           1e3 * muscle.rest_length, path.extension().string()))
      .string();
}

ExitCode run_static(const Options& options) {
  const std::vector<identify::Source> sources = sources_of(options.data);
  refuse_lengths_of_no_file(options);
  identify::StaticData data;
  for (const identify::Source& source : sources) read_file(options, source, true, data);
  if (!options.hold_out.empty() && options.hold_out != "pressure" && options.hold_out != "length") {
    refuse_data_file("--hold-out", options.hold_out, options.data);
    if (!std::filesystem::exists(options.hold_out))
      config::fail({"--hold-out", 0, 0}, "", config::in_quotes(options.hold_out),
                   "pressure, length or a file that is there");
    identify::Source other = sources[0];
    other.path = options.hold_out;
    read_file(options, other, false, data);
  }
  keep_branch(options.branch, data);

  const identify::StaticResult found =
      identify_static(data, options_of(options, sources[0].atmosphere));
  const std::string source = "sinew identify static " + options.data.files[0];
  const auto text = [&](std::size_t i) {
    return static_file(found, i, options.name, source, options.actuator);
  };
  tell(found.report, text(0), options.data, options.result);

  // Others of its make, each in a file of its own.
  for (std::size_t i = 1; i < found.muscles.size() && !options.result.out.empty(); ++i) {
    ResultOptions other = options.result;
    other.no_report = true;
    other.out = file_of_muscle(options.result.out, found.muscles[i]);
    check_result_options(other);
    write_parameter_file(text(i), other);
  }
  return ok;
}

}  // namespace

void add_identify_static(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "static", "the static law of an actuator from force, length and pressure",
      "sinew identify static map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
      "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\" -o my-actuator.toml");
  add_data_options(sub, options->data);
  sub.add_option("--rest-length", options->rest_length,
                 "of the muscle without pressure and load; without it the longest length");
  sub.add_option("--length", options->lengths,
                 "of files without a column of it: \"205 mm\", or PART=\"205 mm\" for files with "
                 "PART in their name; may be repeated")
      .takes_one();
  sub.add_option("--actuator", options->actuator, "a file whose braid is taken as known");
  sub.add_option("--branch", options->branch, "fill, vent or both")
      .is_one_of({"fill", "vent", "both"})
      .show_default();
  sub.add_option("--fit-where", options->fit_where,
                 "NAME=VALUE,...: only such rows are fitted, the others held out; may be repeated")
      .takes_one();
  sub.add_option("--hold-out", options->hold_out,
                 "pressure (every second), length (each once) or another FILE, to score what was "
                 "not seen");
  sub.add_option("--model", options->model, "this one alone");
  sub.add_option("--name", options->name, "of the actuator").show_default();
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      return run_static(*options);
    };
  });
}

}  // namespace sinew::cli
