#include "sinew/design/air_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/diagnostics.h"
#include "sinew/design/design.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/recording/raw_table.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::design {

namespace fs = std::filesystem;

namespace {

// Throws config::Error about the setting `use`.
// Figures of one run, under their keys in summary.json; NaN: absent.
struct AirFigures {
  double per_step = Value::unknown, per_metre = Value::unknown, all = Value::unknown,
         stand = Value::unknown;
  double steps = Value::unknown, sequence = Value::unknown, duration = Value::unknown;

  // Calls `each` with a key and its figure.
  template <class Each>
  void each(const Each& each) {
    each("air_used_per_step_kg", per_step);
    each("air_used_kg_per_m", per_metre);
    each("air_used_kg", all);
    each("stand.air_used_kg", stand);
    each("steps", steps);
    each("sequence_duration_s", sequence);
    each("duration_s", duration);
  }

  // The consumption: of the sequence where it is known, else of the whole run.
  AirUse use() const {
    AirUse out{Value::unknown, per_step, per_metre, 0};
    const double whole = std::isfinite(all) ? all : stand;
    out.per_second = per_step * steps / sequence;
    if (std::isfinite(out.per_second))
      out.filling = std::isfinite(all) ? std::max(0.0, all - per_step * steps) : 0.0;
    else
      out.per_second = whole / duration;
    return out;
  }
};

bool is_known(const AirUse& use) {
  return std::isfinite(use.per_second) || std::isfinite(use.per_step) ||
         std::isfinite(use.per_metre);
}

bool takes_air(const AirUse& use) {
  return use.per_second > 0 || use.per_step > 0 || use.per_metre > 0;
}

double member(const Json& summary, std::string_view key) {
  const Json* at = &summary;
  for (std::size_t from = 0; at && from != std::string_view::npos;) {
    const std::size_t dot = key.find('.', from);
    at = at->is_object() ? at->find(key.substr(from, dot - from)) : nullptr;
    from = dot == std::string_view::npos ? dot : dot + 1;
  }
  return at && at->is_number() ? at->number() : Value::unknown;
}

int muscles_with_air(const Json& summary) {
  const Json* muscles = summary.find("muscles");
  int out = 0;
  if (muscles && muscles->is_object())
    for (const Json::Member& muscle : muscles->items())
      out += muscle.value.is_object() && muscle.value.contains("air_used_kg");
  return out;
}

AirUses of_run(const fs::path& summary_file) {
  std::ifstream in(summary_file);
  Json summary;
  if (!in || !Json::parse(in, summary) || !summary.is_object())
    config::refuse_setting("use", (in ? "" : "no ") + summary_file.string(), "the summary of a run",
                           "the folder that sinew run wrote");
  AirFigures figures;
  figures.each([&](const char* key, double& value) { value = member(summary, key); });
  AirUses out{.title = fmt::format("the run `{}`", summary.string("title", "")),
              .runs = {figures.use()},
              .line = Value::unknown,
              .muscles = muscles_with_air(summary)};
  if (!is_known(out.runs[0]))
    config::refuse_setting("use", summary_file.string() + " without figures of air",
                           "a run whose muscles' air is logged", "a simulated run");
  if (!takes_air(out.runs[0]))
    config::refuse_setting("use", "a run that takes no air", "one that does");
  const double full = member(summary, "supply.full_steps");
  if (full < figures.steps)
    out.warnings.push_back(fmt::format(
        "the run's own tank was too empty after {:.0f} of {:.0f} steps: its consumption "
        "is too low; a run on a constant supply has the right one",
        full, figures.steps));
  const fs::path resolved = summary_file.parent_path() / run::resolved_name;
  if (!fs::exists(resolved)) return out;
  const experiment::MachineFile file = experiment::load_machine_file(resolved.string());
  out.air = file.experiment.air;
  out.line = file.experiment.supply.pressure;
  return out;
}

// Returns a column of a sweep's table in the unit of a key; empty if the table lacks it.
std::vector<double> column_of(const recording::RawTable& table, std::string_view key) {
  const std::string unit = analysis::unit_of_key(key);
  const std::string_view name = analysis::without_unit(key);
  for (const recording::RawColumn& c : table.columns) {
    if (c.name != name && c.name != key) continue;
    const std::string written = c.unit.empty() ? unit : c.unit;
    const auto found = recording::file_unit(written, unit, units::atmosphere);
    const auto* known = std::get_if<recording::FileUnit>(&found);
    if (!known) continue;
    std::vector<double> out;
    for (const double value : c.values) out.push_back(known->conversion(value));
    return out;
  }
  return {};
}

AirUses of_table(const fs::path& path) {
  const recording::RawTable table = recording::read_table({.path = path.string()});
  AirUses out{.title = fmt::format("the table {}", path.filename().string()),
              .line = Value::unknown};
  std::vector<AirFigures> rows(table.rows());
  AirFigures().each([&](const std::string& key, double&) {
    const std::vector<double> values = column_of(table, key);
    for (std::size_t i = 0; i < values.size(); ++i)
      rows[i].each([&](const std::string& of, double& value) {
        if (of == key) value = values[i];
      });
  });
  for (const AirFigures& row : rows)
    if (const AirUse use = row.use(); is_known(use) && takes_air(use)) out.runs.push_back(use);
  if (out.runs.empty())
    config::refuse_setting(
        "use", path.string() + " without a column of air",
        "a table of sinew sweep with air_used_per_step_kg, air_used_kg_per_m, or air_used_kg "
        "and duration_s",
        "a sweep with report=air_used_per_step_kg, report=air_used_kg_per_m, report=steps and "
        "report=sequence_duration_s");
  if (out.runs.size() < rows.size())
    out.notes.push_back(fmt::format("{} of {} rows have no figures of air and are left out",
                                    rows.size() - out.runs.size(), rows.size()));
  return out;
}

AirUses of_muscle(const AirSettings& s) {
  const experiment::MachineFile file = experiment::load_machine_file(s.use);
  const gas::Air& air = file.experiment.air;
  const config::SettingValues values(s, air.atmosphere);
  const actuator::Actuator& a =
      config::named(file.experiment.actuators, s.name, "name", "actuator", s.use);
  for (const auto& [name, given] : {std::pair{"cycles", !s.cycles.empty()},
                                    {"contraction", !s.contraction.empty()},
                                    {"muscles", s.muscles > 0}})
    if (!given)
      config::fail({name, 0, 0}, "", "nothing", "a value, as the consumption is that of a muscle",
                   R"(muscles=18 cycles="1 Hz" contraction="20 %")");
  const double rest = a.prediction.rest_length;
  const double length = values.given(s.length).value_or(rest);
  if (!(length > 0))
    config::fail({"length", 0, 0}, "", "nothing", "the length of a vented muscle",
                 R"(length="200 mm")");
  if (s.muscle_pressure.empty() && s.line.empty())
    config::fail({"muscle_pressure", 0, 0}, "", "nothing", "the pressure of a full muscle",
                 R"(muscle_pressure="6 bar gauge")");
  const double full_length = length * (1 - values.of(s.contraction));
  require_length(a, length, "length", s.length);
  require_length(a, full_length, "contraction", s.contraction);
  const double pressure =
      s.muscle_pressure.empty() ? values.of(s.line) : values.of(s.muscle_pressure);
  if (!s.line.empty() && pressure > values.of(s.line))
    config::refuse_setting("muscle_pressure", config::in_quotes(s.muscle_pressure),
                           "at most the pressure of the line, " + config::in_quotes(s.line));
  const double filling =
      air_of_filling(a, values.of(s.external_volume), length, full_length, pressure, air);
  const double rate = s.muscles * values.of(s.cycles) * filling;
  AirUses out{.title = fmt::format("{} muscles `{}`", s.muscles, a.name),
              .runs = {{rate, Value::unknown, Value::unknown, 0}},
              .air = air,
              .line = air.atmosphere + pressure,
              .muscles = s.muscles};
  if (!(rate > 0)) config::refuse_setting("use", "muscles that take no air", "ones that do");
  out.notes.push_back("each muscle is vented to the room before it is filled again");
  return out;
}

// Throws config::Error about a setting that describes muscles of a file.
void refuse_settings_of_muscles(const AirSettings& s) {
  for (const auto& [name, given] :
       {std::pair{"name", !s.name.empty()},
        {"muscles", s.muscles > 0},
        {"cycles", !s.cycles.empty()},
        {"length", !s.length.empty()},
        {"contraction", !s.contraction.empty()},
        {"muscle_pressure", !s.muscle_pressure.empty()},
        {"external_volume", s.external_volume != AirSettings().external_volume}})
    if (given)
      config::refuse_setting(name, "a setting for the file of a muscle",
                             "none, since a run or a table has its own consumption");
}

}  // namespace

AirUses air_uses(const AirSettings& s) {
  const fs::path path = s.use;
  if (!fs::exists(path))
    config::fail(
        {s.use, 0, 0}, "", "nothing",
        "the folder of a run, its summary.json, the table of a sweep or a file of an actuator");
  const bool is_file_of_muscle = !fs::is_directory(path) && path.extension() == ".toml";
  if (is_file_of_muscle) return of_muscle(s);
  refuse_settings_of_muscles(s);
  if (fs::is_directory(path)) return of_run(path / run::summary_name);
  if (path.extension() == ".json") return of_run(path);
  if (path.filename() == run::log_name) return of_run(path.parent_path() / run::summary_name);
  return of_table(path);
}

}  // namespace sinew::design
