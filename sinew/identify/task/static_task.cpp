#include "sinew/identify/task/static_task.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/task/tables.h"

namespace sinew::identify {

namespace {

constexpr config::Range actuator_length = config::above_zero(1000, "of an actuator");

// "Kinked19=206 mm" is for files with Kinked19 in their name, "205 mm" for all.
struct LengthOf {
  std::string part, text;

  explicit LengthOf(const std::string& setting) : text(setting) {
    const std::size_t equals = setting.find('=');
    if (equals == setting.npos) return;
    part = setting.substr(0, equals);
    text = setting.substr(equals + 1);
  }

  bool is_for(const std::string& file) const {
    return std::filesystem::path(file).filename().string().find(part) != part.npos;
  }
};

double length_for(const std::vector<std::string>& lengths, const Source& source) {
  double out = 0;
  for (const std::string& setting : lengths)
    if (const LengthOf length(setting); length.is_for(source.path))
      out =
          config::quantity_setting("length", length.text, "m", source.atmosphere, actuator_length);
  return out;
}

// A part of a name that no file has is a slip: its files would take another length.
void refuse_lengths_of_no_file(const std::vector<std::string>& lengths,
                               const std::vector<Source>& sources) {
  for (const std::string& setting : lengths) {
    const LengthOf length(setting);
    const auto fits = [&](const Source& s) { return length.is_for(s.path); };
    if (!std::ranges::any_of(sources, fits))
      config::fail({"length", 0, 0}, "", config::in_quotes(setting),
                   "a part of the name of one of the files");
  }
}

// Returns what the settings say of a file's points.
StaticInput input_for(const StaticSettings& settings, const Source& source, bool fitted) {
  StaticInput input{.length = length_for(settings.lengths, source), .fitted = fitted};
  if (!settings.rest_length.empty())
    input.rest_length = config::quantity_setting("rest_length", settings.rest_length, "m",
                                                 source.atmosphere, actuator_length);
  return input;
}

// Rows that fit_where names are fitted; the others are held out.
void read_table(const StaticSettings& settings, const Source& source, bool fitted,
                StaticData& data) {
  const StaticInput input = input_for(settings, source, fitted);
  const Measured all = read_measured(source, static_columns());
  const std::size_t before = data.points.size();
  add_points(all, input, data);
  if (settings.fit_where.empty() || !fitted) return;

  Source some = source;
  for (const std::string& text : settings.fit_where) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos)
      config::fail({"fit_where", 0, 0}, "", config::in_quotes(text), "NAME=VALUE,...");
    some.where[text.substr(0, equals)] = text.substr(equals + 1);
  }
  if (all.has("time"))
    config::fail({"fit_where", 0, 0}, "", "a recording", "a table; of recordings, hold_out=FILE");
  const Measured few = read_measured(some, static_columns());
  const std::set<int> lines(few.lines.begin(), few.lines.end());
  for (std::size_t i = 0; i < all.rows(); ++i)
    data.points[before + i].fitted = lines.contains(all.lines[i]);
}

// Points of one branch only; what has none stays.
void keep_branch(const std::string& word, StaticData& data) {
  if (word == "both") return;
  if (word != "fill" && word != "vent")
    config::fail({"branch", 0, 0}, "", config::in_quotes(word), "fill, vent or both");
  const auto other = word == "fill" ? Branch::vent : Branch::fill;
  std::erase_if(data.points, [=](const StaticPoint& p) { return p.branch == other; });
}

StaticOptions options_of(const std::vector<Source>& sources, const StaticSettings& settings) {
  StaticOptions out{.atmosphere = sources[0].atmosphere, .model = settings.model};
  out.subject = "static law from " + sources[0].path;
  if (sources.size() > 1) out.subject += " and " + std::to_string(sources.size() - 1) + " more";
  if (settings.hold_out == "pressure") out.hold_out = HoldOut::pressure;
  if (settings.hold_out == "length") out.hold_out = HoldOut::length;
  if (!settings.actuator.empty()) {
    const auto file = experiment::load_machine_file(settings.actuator);
    out.braid = config::named(file.experiment.actuators, "", "actuator", "actuator").braid;
  }
  return out;
}

// The table that is not fitted, where there is one.
std::optional<Source> held_out_of(const std::vector<Source>& sources,
                                  const StaticSettings& settings) {
  const std::string& word = settings.hold_out;
  if (settings.held_out || word.empty() || word == "pressure" || word == "length")
    return settings.held_out;
  Source other = beside(sources, "hold_out", word);
  if (!std::filesystem::exists(word))
    config::fail({"hold_out", 0, 0}, "", config::in_quotes(word),
                 "pressure, length or a file that is there");
  return other;
}

}  // namespace

StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  refuse_lengths_of_no_file(settings.lengths, sources);
  StaticData data;
  for (const Source& source : sources) read_table(settings, source, true, data);
  keep_branch(settings.branch, data);
  return data;
}

StaticFound find_static(const std::vector<Source>& sources, const StaticSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  const std::optional<Source> other = held_out_of(sources, settings);
  std::vector<Source> all = sources;
  if (other) all.push_back(*other);
  refuse_lengths_of_no_file(settings.lengths, all);

  StaticData data;
  for (const Source& source : sources) read_table(settings, source, true, data);
  if (other) read_table(settings, *other, false, data);
  keep_branch(settings.branch, data);

  StaticFound out{identify_static(data, options_of(sources, settings)), {}};
  for (std::size_t i = 0; i < out.result.muscles.size(); ++i)
    out.files.push_back(static_file(out.result, i, settings.name,
                                    "sinew identify static " + sources[0].path, settings.actuator));
  return out;
}

std::vector<Check> check_before_static(const std::vector<Source>& sources,
                                       const StaticSettings& settings,
                                       const std::string& diameter) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  double across = 0;
  if (!diameter.empty())
    across = config::quantity_setting("diameter", diameter, "m", sources[0].atmosphere,
                                      config::above_zero(1, "of a muscle"));
  std::vector<CheckedTable> tables;
  for (const Source& source : sources)
    tables.push_back({read_measured(source, static_columns()), input_for(settings, source, true)});
  std::vector<Check> out = check_static(tables, across);
  try {
    refuse_lengths_of_no_file(settings.lengths, sources);
  } catch (const config::Error& error) {
    out.insert(out.begin(), {"lengths of files", Light::red, error.what(),
                             "Name a part that one of the files has."});
  }
  return out;
}

}  // namespace sinew::identify
