#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/task/settings.h"
#include "sinew/identify/valve/added_volume.h"
#include "sinew/identify/valve/edges.h"
#include "sinew/identify/valve/timing.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/json/json.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/parts.h"

namespace sinew::identify {

namespace {

// --- valve tables from a logger: times that do not ascend, several recordings ---

using recording::Grid;

// Returns the table of a source, with its rows as text.
Grid grid_of(const Source& source) {
  return recording::read_grid(std::string(text_of(source, "measurements as CSV")), source);
}

// Returns one source for each recording of a file: a restarted logger begins a new one.
std::vector<Source> recordings_in(const Source& source) {
  if (source.part != 0 || !source.where.empty()) return {source};
  const Grid grid = grid_of(source);
  const auto clock = recording::column_of(grid.header(), source.names, "time");
  const std::size_t parts = recording::parts_of(grid, source, clock).size();
  if (parts < 2) return {source};
  std::vector<Source> out(parts, source);
  for (std::size_t i = 0; i < parts; ++i) out[i].part = static_cast<int>(i) + 1;
  return out;
}

bool has_column_of_volumes(const Source& source) {
  return recording::column_of(grid_of(source).header(), source.names, "added_volume").has_value();
}

constexpr std::size_t most_samples = 20000, most_of_pulses = 15000;  // longer ones are averaged

// Averages long recordings of pulses over time, without blurring the shortest pulse.
Measured pulses_averaged(const Measured& data) {
  if (data.rows() <= most_of_pulses) return data;
  const std::vector<Opening> edges = edges_of(data).edges;
  QuickChange shortest{edges.front().time, data["time"].back() - data["time"].front()};
  for (std::size_t i = 1; i < edges.size(); ++i)
    shortest.duration = std::min(shortest.duration, edges[i].time - edges[i - 1].time);
  return times_averaged(data, most_of_pulses, shortest);
}

// Returns the fillings with the volumes of the setting, comma-separated, one for each source.
std::vector<AddedFill> fills_by_setting(const std::vector<Source>& sources,
                                        const ValveSettings& settings,
                                        const SettingValues& values) {
  const std::size_t pieces = config::at_commas(settings.added_volume).size();
  if (pieces != sources.size())
    config::fail({"added_volume", 0, 0}, "", fmt::format("{} volumes", pieces),
                 fmt::format("one for each of {} files, between commas", sources.size()));
  const std::vector<double> added = values.each(settings.added_volume, sources.size());
  std::vector<AddedFill> out;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Measured data =
        times_averaged(read_measured(sources[i], valve_columns()), most_samples, "pressure");
    if (data.has("added_volume"))
      config::fail({"added_volume", 0, 0}, "", config::in_quotes(settings.added_volume),
                   fmt::format("no such setting: {} has a column of that name", data.file));
    out.push_back({std::move(data), added[i]});
  }
  return out;
}

// Returns the table. The order of rows is irrelevant in a chart or duty map: there a column
// `time` that is not ascending is left out. Throws config::Error.
Measured read_valve(const Source& source) {
  try {
    return each_row_once(read_measured(source, valve_columns()));
  } catch (const config::Error&) {
    // Retry without the time. Only a chart or duty map is valid then; otherwise the time was the
    // error.
    std::vector<ColumnSpec> timeless;
    for (const ColumnSpec& w : valve_columns())
      if (w.name != "time") timeless.push_back(w);
    Source without = source;
    without.names.erase("time");
    try {
      Measured data = each_row_once(read_measured(without, timeless));
      const ValveData kind = valve_data(data);
      if (kind == ValveData::chart || kind == ValveData::duty) {
        data.notes.emplace_back("its times are out of order, which means nothing here");
        return data;
      }
    } catch (const std::exception&) {  // the first error is the better one
    }
    throw;
  }
}

// Returns the fillings with known added volumes: from the setting, one for each source, or from
// a column added_volume, which may also divide one table. Several consecutive recordings in a
// file are as many fillings. Empty: no added volumes are given. Throws config::Error and Refusal.
std::vector<AddedFill> added_fills(const std::vector<Source>& sources,
                                   const ValveSettings& settings, const SettingValues& values) {
  if (!settings.added_volume.empty()) return fills_by_setting(sources, settings, values);
  if (!std::ranges::any_of(sources, has_column_of_volumes)) return {};
  std::vector<AddedFill> out;
  for (const Source& source : sources)
    for (const Source& recording : recordings_in(source))
      for (AddedFill& fill : fills_by_column(read_measured(recording, valve_columns())))
        out.push_back({times_averaged(std::move(fill.data), most_samples, "pressure"), fill.added});
  if (out.size() == 1) return {};  // a single filling, with any volume
  return out;
}

struct Kind {
  std::string_view name;
  ValveData data;
};
constexpr std::array<Kind, 5> kinds{{{"chart", ValveData::chart},
                                     {"fill", ValveData::fill},
                                     {"pulses", ValveData::pulses},
                                     {"coil", ValveData::coil},
                                     {"duty", ValveData::duty}}};

ValveOptions options_of(const ValveSettings& s, const SettingValues& values, double atmosphere) {
  ValveOptions out{.name = s.name};
  out.valve.profile = gas::Valve::Profile::ideal;
  if (!s.base.empty()) {
    const auto file = experiment::load_machine_file(s.base);
    out.valve = config::named(file.experiment.valves, s.name, "name", "valve", s.base);
    out.provenance = Provenance(file.experiment.origins, s.base);
  }
  out.air.atmosphere = atmosphere;
  out.air.temperature = values.of(s.temperature);
  out.volume = values.given(s.volume);
  out.conductance = values.given(s.conductance);
  out.port = values.given(s.port);
  out.frequency = values.given(s.frequency);
  out.exponent = values.given(s.exponent);
  out.per_volume = s.per_volume;
  return out;
}

ValveData kind_of(const std::string& name, const Measured& data) {
  for (const Kind& kind : kinds)
    if (kind.name == name) return valve_data(data, kind.data);
  return valve_data(data);
}

ValveResult identified(const Measured& data, const ValveOptions& how, const std::string& kind,
                       const std::vector<Source>& others) {
  switch (kind_of(kind, data)) {
    case ValveData::chart:
      return identify_chart(data, how);
    case ValveData::pulses:
      return identify_pulses(pulses_averaged(data), how);
    case ValveData::coil:
      return identify_coil(data, how);
    case ValveData::duty:
      return identify_duty(data, how);
    case ValveData::fill:
      break;
  }
  const auto filling = [](Measured m) {
    return times_averaged(std::move(m), most_samples, "pressure");
  };
  if (others.empty()) return identify_fill(filling(data), how);
  const Measured unseen = filling(read_measured(others[0], valve_columns()));
  return identify_fill(filling(data), how, &unseen);
}

// Refuses settings of volume or conductance if the fillings determine both.
void refuse_with_added_volume(const ValveSettings& s, const std::vector<Source>& others) {
  const auto refuse = [](const char* name, const std::string& found, const char* expected) {
    config::fail({name, 0, 0}, "", found, expected);
  };
  if (!s.kind.empty() && s.kind != "fill")
    refuse("kind", config::in_quotes(s.kind), "fill: volumes are joined to a chamber that fills");
  if (!s.volume.empty())
    refuse("volume", config::in_quotes(s.volume), "none with added volumes, which determine it");
  if (!s.conductance.empty())
    refuse("conductance", config::in_quotes(s.conductance),
           "none with added volumes, which determine it");
  if (!others.empty())
    refuse("hold_out", config::in_quotes(others[0].path),
           "none with added volumes: every second tenth of each curve is held out");
}

ValveFound found_of(ValveResult result, const ValveSettings& settings) {
  ValveFound out(std::move(result));
  out.refused = out.result.refused;
  if (!out.refused.empty()) out.json["refused"] = out.refused;
  out.frequency = settings.frequency;
  out.files = {{[found = out.result](const std::string& at) {
    if (!found.refused.empty()) throw Refusal(found.refused);
    const gas::Flow& flow = found.valve.flow;
    if (!(flow.area > 0) && !(flow.sonic_conductance > 0))
      throw Refusal(at, "delays, but no flow of the valve", "both for a file",
                    "base=VALVES.toml with a valve of that name, whose flow is kept");
    return valve_file(found.valve, found.provenance);
  }}};
  return out;
}

}  // namespace

ValveFound find(const SourceList& sources, const ValveSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  const double atmosphere = sources.front().atmosphere;
  const SettingValues values(settings, atmosphere);
  const ValveOptions options = options_of(settings, values, atmosphere);
  const std::vector<Source> others = held_out_tables(settings.hold_out, sources);
  if (const std::vector<AddedFill> fills = added_fills(sources, settings, values); !fills.empty()) {
    refuse_with_added_volume(settings, others);
    return found_of(identify_added(fills, options), settings);
  }
  if (sources.size() > 1)
    config::fail({"data", 0, 0}, "", std::to_string(sources.size()) + " files",
                 "one, or fillings with known volumes joined to the chamber",
                 "added_volume=\"0 L,0.5 L\"");
  return found_of(identified(read_valve(sources.front()), options, settings.kind, others),
                  settings);
}

TimingFile timing_of(const ValveFound& found, const std::string& frequency) {
  const ValveResult& r = found.result;
  if (!r.opening_known || !r.closing_known)
    throw Refusal("predict_dat", "no opening and closing delay", "both",
                  "a map of duties, or pulses and their pressure");
  const ValveSettings settings{.frequency = frequency.empty() ? found.frequency : frequency};
  const double hertz = SettingValues(settings).of(settings.frequency, "100 Hz");
  const CompensatedTiming timing = compensated(r.valve.opening_delay, r.valve.closing_delay, hertz);
  return {predict_dat(timing.timing), hertz, timing.worst};
}

}  // namespace sinew::identify
