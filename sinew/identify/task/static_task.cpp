#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "sinew/actuator/prediction.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/task/settings.h"
#include "sinew/report/text/text_table.h"

namespace sinew::identify {

namespace {

// Returns which rows of a table fit_where selects; the others are held out.
std::vector<bool> named_rows(const StaticSettings& settings, const Source& source,
                             const Measured& all) {
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
  std::vector<bool> out;
  for (const int line : all.lines) out.push_back(lines.contains(line));
  return out;
}

// Rules of holding out rows, in the order of HoldOut.
constexpr std::string_view rules[] = {"pressure", "length", "muscle"};

// Treatment of a table that no method can read.
enum class Unreadable { is_refused, is_red };

void read_table(const StaticSettings& settings, const StaticInput& input, const Source& source,
                Unreadable unreadable, CheckInput& out) {
  Measured all = read_measured(source, static_columns());
  // A row repeats another only if both are fitted, or both are held out.
  std::vector<bool> named;
  if (input.fitted && !settings.fit_where.empty()) named = named_rows(settings, source, all);
  all = settings_averaged(each_row_once(std::move(all), &named), all.has("load") ? "load" : "force",
                          &named);
  const std::size_t before = out.data.points.size();
  CheckedTable table{all, input};
  if (unreadable == Unreadable::is_red)
    out.add_or_report(std::move(table));
  else
    out.add(std::move(table));
  for (std::size_t i = 0; i < named.size() && before + i < out.data.points.size(); ++i)
    out.data.points[before + i].fitted = named[i];
}

// Removes the points of the other branch; points without a branch stay.
void keep_branch(const std::string& word, StaticData& data) {
  if (word == "both") return;
  const auto other = word == "fill" ? Branch::vent : Branch::fill;
  std::vector<StaticPoint> left_out;
  for (const StaticPoint& p : data.points)
    if (p.branch == other) left_out.push_back(p);
  std::erase_if(data.points, [=](const StaticPoint& p) { return p.branch == other; });
  if (left_out.empty()) return;
  StaticOmitted& omitted = data.omitted("of the other branch", "branch=" + word + " was given");
  omitted.count = left_out.size();
  omitted.points = std::move(left_out);
}

StaticOptions options_of(const std::vector<Source>& sources, const StaticSettings& settings,
                         const CheckInput& read) {
  const SettingValues values(settings, read.atmosphere);
  StaticOptions out{.atmosphere = read.atmosphere,
                    .braid = read.braid,
                    .volume = values.given(settings.volume).value_or(0),
                    .diameter = read.diameter,
                    .model = settings.model,
                    .tried = settings.tried};
  out.subject = "static law from " + sources[0].path;
  if (sources.size() > 1) out.subject += " and " + std::to_string(sources.size() - 1) + " more";
  for (const std::string& word : settings.hold_out.texts)
    if (const auto* rule = std::ranges::find(rules, word); rule != std::end(rules))
      out.hold_out = static_cast<HoldOut>(1 + (rule - rules));
  return out;
}

// Returns a title such as "Static law of the muscle bpa, identified from forces.csv".
std::string title_of(const std::vector<Source>& sources, const StaticSettings& settings,
                     const std::vector<StaticMuscle>& muscles) {
  std::string lengths;
  for (std::size_t i = muscles.size(); i-- > 0;)
    lengths += fmt::format("{}{:.4g}",
                           lengths.empty() ? ""
                           : i == 0        ? " and "
                                           : ", ",
                           1e3 * muscles[i].rest_length);
  return fmt::format(
      "Static law of {}, identified from {}",
      muscles.size() == 1 ? fmt::format("the muscle {}", settings.name)
                          : fmt::format("{}: muscles of {} mm", settings.name, lengths),
      sources.size() == 1 ? std::filesystem::path(sources[0].path).filename().string()
                          : fmt::format("{} files", sources.size()));
}

// Returns the tables that are not fitted.
std::vector<Source> held_out_of(const std::vector<Source>& sources,
                                const StaticSettings& settings) {
  for (const std::string& text : settings.hold_out.texts)
    if (std::ranges::find(rules, text) == std::end(rules) && !std::filesystem::exists(text))
      config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
                   "pressure, length, muscle or a file that is there");
  return held_out_tables(settings.hold_out, sources, rules);
}

// Reads "rest_length=120 mm", or the length alone [m].
double predicted_length(const std::string& setting, double atmosphere) {
  const std::size_t equals = setting.find('=');
  if (equals != setting.npos && setting.substr(0, equals) != "rest_length")
    config::fail({"predict", 0, 0}, "", config::in_quotes(setting), "a rest length", "\"120 mm\"");
  return config::quantity_setting("predict",
                                  equals == setting.npos ? setting : setting.substr(equals + 1),
                                  "m", atmosphere, actuator_length);
}

ParameterFile file_of(const StaticResult& found, const StaticMuscle& muscle,
                      const std::string& source, const StaticSettings& settings) {
  ParameterFile out =
      file_with(static_file(found, muscle, settings.name, source, settings.actuator));
  out.suffix = fmt::format("-{:.0f}mm", 1e3 * muscle.rest_length);
  return out;
}

// Adds a remark on the uncertainty of a muscle that was not measured.
void note_prediction(const StaticMuscle& muscle, StaticResult& found) {
  const actuator::Prediction p = prediction_of(found, muscle);
  const std::string what =
      fmt::format("a muscle of {:.4g} mm, from the others: ", 1e3 * muscle.rest_length);
  if (p.inside_95 > 0)
    found.report.notes.push_back(
        what +
        fmt::format("68 % of its forces are expected within {:.3g} N and {:.2g} % of the law, "
                    "95 % within {:.3g} N and {:.2g} %, the squares added, between {:.4g} "
                    "and {:.4g} mm",
                    actuator::widest_inside_68(p, 0), 100 * p.per_force_68,
                    actuator::widest_inside_95(p, 0), 100 * p.per_force_95, 1e3 * p.lengths.front(),
                    1e3 * p.lengths.back()));
  else
    found.report.warnings.push_back(
        what +
        "how far off it is stays unknown, as no muscle could be left out; "
        "measure muscles of two rest lengths, or one force of this muscle");
}

// Reads all tables, the held-out ones last.
CheckInput read_tables(const std::vector<Source>& sources, const StaticSettings& settings,
                       Unreadable unreadable) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  const SettingValues values(settings, sources[0].atmosphere);
  CheckInput out{.diameter = values.given(settings.diameter).value_or(0),
                 .atmosphere = sources[0].atmosphere,
                 .braid = known_braid(settings.actuator)};
  StaticInput input{.rest_length = values.given(settings.rest_length).value_or(0)};
  const std::vector<Source> others = held_out_of(sources, settings);
  for (const Source& source : sources) read_table(settings, input, source, unreadable, out);
  input.fitted = false;
  for (const Source& source : others) read_table(settings, input, source, unreadable, out);
  keep_branch(settings.branch, out.data);
  return out;
}

void put_files(std::string& out, const std::vector<RecognisedFile>& files, std::size_t width) {
  report::TextTable table({"file", "rows", "is", "columns"},
                          {report::TextTable::Align::left, report::TextTable::Align::right});
  for (const RecognisedFile& f : files) {
    std::string columns;
    for (const RecognisedColumn& c : f.columns)
      columns +=
          fmt::format("{}{} {} … {}", columns.empty() ? "" : ", ", c.name, c.lowest, c.highest);
    table.add(
        {f.file, std::to_string(f.rows),
         f.is_recording ? fmt::format("a recording, {:.3g} % settled", 100 * f.settled) : "a table",
         columns});
  }
  put(out, "{}\n", table.text_within(width));
}

void put_mounts(std::string& out, const std::vector<RecognisedMount>& mounts) {
  using enum report::TextTable::Align;
  report::TextTable table({"muscle [mm]", "mount [mm]", "points", "pressures", "from [kPa]",
                           "to [kPa]", "largest force [N]", "branches"},
                          {right, right, right, right, right, right, right, left});
  for (const RecognisedMount& m : mounts)
    table.add({m.rest_length > 0 ? fmt::format("{:.4g}", 1e3 * m.rest_length) : "?",
               fmt::format("{:.4g}", 1e3 * m.length),
               m.held_out > 0 ? fmt::format("{} + {} held out", m.points, m.held_out)
                              : std::to_string(m.points),
               std::to_string(m.pressures), fmt::format("{:.4g}", m.lowest / 1e3),
               fmt::format("{:.4g}", m.highest / 1e3), fmt::format("{:.4g}", m.strongest),
               m.branches.empty() ? "unknown" : m.branches});
  if (!table.empty()) put(out, "{}\n", table.text());
}

void put_noise(std::string& out, const ForceNoise& noise) {
  if (noise.readings == 0)
    put(out, "noise of force: unknown, as no reading is repeated\n\n");
  else
    put(out, "noise of force: {:.2g} N, {:.2g} % of the largest, from {} {}\n\n", noise.deviation,
        100 * noise.share, noise.readings, noise.from);
}

void put_checks(std::string& out, const std::vector<Check>& checks) {
  for (const Check& c : checks) {
    put(out, "{:<6}  {:<17}  {}\n", word(c.light), c.name, c.evidence);
    if (!c.advice.empty()) put(out, "{:27}{}\n", "", c.advice);
  }
}

void put_determined(std::string& out, const DeterminedLaw& law) {
  if (!law.refused.empty()) {
    put(out, "\nwhat a fit could determine: not evaluated, {}\n", law.refused);
    return;
  }
  report::TextTable table({"a fit could determine", "known", "to know more, measure"});
  for (const Determined& d : law.parameters) table.add({d.name, d.words, d.advice});
  put(out, "\n{}by the richest law, {}: {}\n", table.text(), law.model, law.law);
}

void put_checkup(const CheckFound& found, const TextOptions& how, std::string& out) {
  put_files(out, found.checkup.recognised.files, how.width);
  put_mounts(out, found.checkup.recognised.mounts);
  put_noise(out, found.checkup.recognised.noise);
  put_checks(out, found.checkup.checks);
  put_determined(out, found.checkup.determined);
}

}  // namespace

std::optional<actuator::Braid> known_braid(const std::string& file_name) {
  if (file_name.empty()) return {};
  const auto file = experiment::load_machine_file(file_name);
  return config::named(file.experiment.actuators, "", "actuator", "actuator", file_name).braid;
}

StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings) {
  return read_tables(sources, settings, Unreadable::is_refused).data;
}

StaticFound find(const SourceList& sources, const StaticSettings& settings) {
  CheckInput read = read_tables(sources, settings, Unreadable::is_refused);
  std::vector<double> lengths;
  for (const std::string& setting : settings.predict)
    lengths.push_back(predicted_length(setting, sources[0].atmosphere));
  apply_checks(check_static(read), settings.anyway, read.data.warnings);

  StaticResult result = identify_static(read.data, options_of(sources, settings, read));
  result.report.title = title_of(sources, settings, result.muscles);
  result.report.further = further_measurements(result, sources[0].atmosphere, read.braid);
  const std::string source = "sinew identify static " + sources[0].path;
  std::vector<ParameterFile> files;
  for (const StaticMuscle& muscle : result.muscles)
    files.push_back(file_of(result, muscle, source, settings));
  for (const double length : lengths) {
    const StaticMuscle muscle = muscle_of(result, length);
    note_prediction(muscle, result);
    files.push_back(file_of(result, muscle, source + ", of another rest length", settings));
  }
  StaticFound out(std::move(result));
  out.files = std::move(files);
  out.json["air_at_rest"] = to_json(out.result.air);
  return out;
}

CheckFound find(const SourceList& sources, const CheckSettings& settings) {
  CheckFound out;
  out.checkup = check_up(read_tables(sources, settings.how, Unreadable::is_red));
  out.json = to_json(out.checkup);
  out.fails = has_red(out.checkup.checks);
  prints(out, put_checkup);
  return out;
}

}  // namespace sinew::identify
