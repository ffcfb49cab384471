#include "sinew/identify/task/pair_task.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/pair/pair_file.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

// Of both ends of "7 s..14 s"; one may be open.
std::pair<double, double> times_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  const std::string_view from = config::trimmed(std::string_view(text).substr(0, dots)),
                         to = config::trimmed(std::string_view(text).substr(dots + 2));
  const auto time = [](std::string_view end, double open) {
    return end.empty() ? open : config::quantity_setting("hold_out", end, "s");
  };
  const std::pair out{time(from, -unbounded), time(to, unbounded)};
  if (!(out.first < out.second))
    config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
                 "a time and a later one, such as \"7 s..14 s\"");
  return out;
}

std::vector<std::string> rigs_of(const std::string& text, std::size_t tables) {
  if (text.empty()) return std::vector<std::string>(tables, "rig");
  std::vector<std::string> out = config::at_commas(text);
  if (out.size() == 1) out.resize(tables, out[0]);
  if (out.size() != tables || std::ranges::find(out, "") != out.end())
    config::fail({"rigs", 0, 0}, "", fmt::format("{} names", out.size()),
                 fmt::format("{}: one for each file", tables));
  return out;
}

std::vector<PairRecord> records_of(std::vector<Source> sources, const PairSettings& settings) {
  for (const Source& other : settings.held_out)
    if (std::ranges::find(sources, other.path, &Source::path) == sources.end())
      sources.push_back(other);
  const std::vector<std::string> rigs = rigs_of(settings.rigs, sources.size());
  const double window = config::quantity_setting("window", settings.window, "s", units::atmosphere,
                                                 config::above_zero(10, "of a few samples"));
  std::vector<PairRecord> out;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    out.push_back(pair_record(read_measured(sources[i], pair_columns()), window));
    out.back().rig = rigs[i];
    out.back().held_out = std::ranges::find(settings.held_out, sources[i].path, &Source::path) !=
                          settings.held_out.end();
  }
  return out;
}

}  // namespace

bool is_time_range(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return false;
  const auto time = [](std::string_view end) {
    end = config::trimmed(end);
    return end.empty() || (end[0] >= '0' && end[0] <= '9') || end[0] == '-';
  };
  const std::string_view from = text.substr(0, dots), to = text.substr(dots + 2);
  return time(from) && time(to) && from.size() + to.size() > 0;
}

PairFound find_pair(const std::vector<Source>& sources, const PairSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  PairOptions options{.model = settings.model, .wishes = Wishes(settings.wishes)};
  if (!settings.hold_out.empty()) {
    if (!is_time_range(settings.hold_out))
      config::fail({"hold_out", 0, 0}, "", config::in_quotes(settings.hold_out),
                   "times such as \"7 s..14 s\" or \"7 s..\", or a file");
    std::tie(options.held_out_from, options.held_out_to) = times_of(settings.hold_out);
  }
  PairFound out{.result = identify_pair(records_of(sources, settings), options),
                .joint = settings.joint,
                .base = settings.base};
  out.source = "sinew identify pair";
  for (const Source& source : sources) out.source += " " + source.path;
  out.source += ": " + out.result.report.best().model;
  return out;
}

std::string PairFound::file(const std::string& out) const {
  return pair_file(result, joint, source, robot_over(base, out));
}

Json to_json(const PairFound& found) {
  Json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

}  // namespace sinew::identify
