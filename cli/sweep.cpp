// cli/sweep.cpp - `sinew sweep`: many runs of one experiment as one table.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/config/compose.h"
#include "sinew/log/replacement.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, out;
  tune::Study study;  // what the command line says
  int halvings = -1, threads = 0;
  bool force = false, json = false, quiet = false;
};

// A plan's own words, and those of the command line behind them.
tune::Sweep sweep_for(const Options& options) {
  const bool plan = config::format_kind(config::parse_file(options.file)) == "plan";
  tune::Study study = plan ? tune::load_study(options.file) : tune::Study{};
  if (!plan) study.experiment = options.file;

  const tune::Study& said = options.study;
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  append(study.set, said.set);
  append(study.vary, said.vary);
  append(study.where, said.where);
  append(study.report, said.report);
  if (!said.largest.empty()) study.largest = said.largest;
  if (said.seeds > 0) study.seeds = said.seeds;
  if (options.halvings >= 0) study.halvings = options.halvings;
  study.allow_unreachable = study.allow_unreachable || said.allow_unreachable;
  return tune::sweep_of(study);
}

// Rows as they come, so that a sweep that is killed leaves them, beside the file that they become;
// to stdout where no file is named. Made with the first row: a sweep that is refused leaves
// nothing.
class CsvTable {
 public:
  CsvTable(const Options& options, std::vector<std::string> headings)
      : name_(options.out), headings_(std::move(headings)) {
    if (name_.empty()) return;
    run::refuse_to_overwrite(name_, options.force, {options.file});
    log::require_free_part(name_);
  }

  // Called between runs that go on: a failure is told of by finish(). False: there was one.
  bool add(const std::vector<std::string>& cells) noexcept {
    if (failure_) return false;
    try {
      const std::string text =
          (lines_++ == 0 ? tune::csv_line(headings_) : "") + tune::csv_line(cells);
      if (name_.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return true;
      }
      if (!file_) file_.emplace(name_, log::Replacement::Sync::now, log::Replacement::Part::kept);
      file_->write(text);
    } catch (...) {
      failure_ = std::current_exception();
    }
    return !failure_;
  }

  // Returns the file that holds the rows of a table that is not whole.
  std::string part() const { return file_ ? file_->part().string() : name_; }

  void take_place() {
    if (file_) file_->commit();
  }

  void tell_failure() const {
    if (!failure_) return;
    try {
      std::rethrow_exception(failure_);
    } catch (const std::exception& e) {
      throw std::runtime_error(
          e.what() + (file_ ? "\n" + part() + ": holds the rows that are done" : std::string()));
    }
  }

 private:
  std::string name_;
  std::vector<std::string> headings_;
  std::int64_t lines_ = 0;
  std::optional<log::Replacement> file_;
  std::exception_ptr failure_;
};

// A number or a flag as such.
Json json_cell(const std::string& cell) {
  if (cell.empty()) return nullptr;
  return Json::accept(cell) ? Json::parse(cell) : Json(cell);
}

std::string table_as_json(const std::vector<std::string>& headings,
                          const std::vector<tune::Row>& rows) {
  Json out{{"format", "sinew.sweep/1"}, {"rows", Json::array()}};
  for (const tune::Row& row : rows) {
    Json entry = Json::object();
    for (std::size_t i = 0; i < headings.size(); ++i) entry[headings[i]] = json_cell(row.cells[i]);
    out["rows"].push_back(std::move(entry));
  }
  return json_text(out, 2) + "\n";
}

int threads_for(const Options& options) {
  if (options.threads > 0) return options.threads;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

// The bar would run through a table on the same terminal.
std::vector<tune::Row> run_all(const Options& options, const tune::Sweep& s, CsvTable* csv) {
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(tune::points(s)),
                        {.each = 1, .unit = "points", .decimals = 0},
                        options.quiet || options.out.empty());
  Interrupt interrupt;
  return tune::sweep(s, {.threads = threads_for(options),
                         .stop = &interrupt.asked(),
                         .progress = &progress,
                         .row = [&](const tune::Row& row) {
                           if (csv && !csv->add(row.cells)) interrupt.ask();
                         }});
}

// A figure that no run has was asked for in vain: under a name that is none, or of a machine that
// does not have it.
void refuse_empty_columns(const std::vector<tune::Row>& rows, const tune::Sweep& s) {
  std::vector<config::Problem> problems;
  for (const std::string& key : tune::keys(s)) {
    const auto has = [&](const tune::Row& row) {
      return row.ok && std::ranges::find(row.lacks, key) == row.lacks.end();
    };
    const auto lacks = [&](const tune::Row& row) {
      return std::ranges::find(row.lacks, key) != row.lacks.end();
    };
    if (std::ranges::any_of(rows, lacks) && std::ranges::none_of(rows, has))
      problems.push_back({{key, 0, 0},
                          "",
                          "no run with it",
                          "a key of the runs' summary.json",
                          "sinew run, whose summary.json has them all"});
  }
  if (!problems.empty()) throw config::Error(problems);
  if (std::ranges::none_of(rows, &tune::Row::ok))
    throw std::runtime_error("no row has figures; the first one's status: " +
                             rows.front().cells.back());
}

// Before the table takes an older one's place.
void judge(const std::vector<tune::Row>& rows, const tune::Sweep& s, const std::string& part) try {
  refuse_empty_columns(rows, s);
} catch (const std::exception& e) {
  if (part.empty()) throw;
  throw std::runtime_error(std::string(e.what()) + "\n" + part + ": holds the rows");
}

void tell(const std::vector<tune::Row>& rows, std::size_t points, const CsvTable* csv,
          const Messages& messages) {
  const auto part = std::ranges::count_if(rows, [](const auto& r) { return !r.lacks.empty(); });
  if (part > 0)
    messages.warning(
        fmt::format("{} of {} rows lack a figure; their status names it", part, rows.size()));
  const auto bad = std::ranges::count_if(rows, [](const tune::Row& row) { return !row.ok; });
  if (bad > 0)
    messages.warning(
        fmt::format("{} of {} rows have no figures; their status says why", bad, rows.size()));
  const auto ended = std::ranges::count_if(rows, &tune::Row::stop_reached);
  if (ended > 0)
    messages.warning(
        fmt::format("in {} of {} rows the trolley reaches the end of its track; distance and mean "
                    "speed are up to there",
                    ended, rows.size()));
  if (rows.size() < points)
    throw std::runtime_error(
        fmt::format("interrupted: {} of {} points are done{}", rows.size(), points,
                    csv && !csv->part().empty() ? " and kept in " + csv->part() : ""));
}

ExitCode sweep_all(const Options& options) {
  const Messages messages(options.quiet);
  const tune::Sweep s = sweep_for(options);
  tune::check(s);

  const std::vector<std::string> headings = tune::headings(s);
  std::optional<CsvTable> csv;
  if (!options.out.empty() || !options.json) csv.emplace(options, headings);
  const std::vector<tune::Row> rows = run_all(options, s, csv ? &*csv : nullptr);
  const std::size_t points = tune::points(s);
  if (csv) csv->tell_failure();
  if (options.json) fmt::print("{}", table_as_json(headings, rows));
  tell(rows, points, csv ? &*csv : nullptr, messages);
  judge(rows, s, csv ? csv->part() : "");
  if (csv) csv->take_place();
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

// One each, so that what follows stays what it is.
void add_words(CLI::App& sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description)->allow_extra_args(false);
}

}  // namespace

void add_sweep(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(
      app, "sweep", "many runs of one experiment as one table",
      "sinew sweep experiments/leg-in-air.toml --vary \"joint.hip.angle_gain=0.02:0.1:5 %/count\" "
      "--report \"joints.hip.tracking_rms_rad [deg]\" -o gain.csv");
  sub.add_option("FILE", options->file, "the experiment, or a plan: the same options as a file")
      ->required();
  add_words(sub, "--vary", options->study.vary,
            "KEY=a,b,c unit or KEY=from:to:how many unit; repeated: all combinations");
  sub.add_option("--seeds", options->study.seeds, "each point with the noise of seeds 1 … N")
      ->check(CLI::Range(1, 10000));
  add_words(sub, "--report", options->study.report,
            "keys of summary.json, with commas: key, or key [unit]");
  sub.add_option("--largest", options->study.largest,
                 "the largest value of one more key for which --where holds; written like --vary");
  add_words(sub, "--where", options->study.where,
            "\"key < value\" of summary.json, also <=, >, >=; repeated: all must hold");
  sub.add_option("--halvings", options->halvings, "of the interval that --largest finds; 6")
      ->check(CLI::Range(0, 50));
  add_sets(sub, options->study.set);
  sub.add_flag("--allow-unreachable", options->study.allow_unreachable, "as in sinew run");
  sub.add_option("--threads", options->threads, "at a time; as many as the machine has")
      ->check(CLI::Range(1, 1024));
  sub.add_option("-o,--output", options->out, "the CSV file to write; else stdout");
  sub.add_flag("--force", options->force, "replace that file");
  sub.add_flag("--json", options->json, "print the table as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return sweep_all(*options); }; });
}

}  // namespace sinew::cli
