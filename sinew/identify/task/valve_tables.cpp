#include "sinew/identify/task/valve_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/task/tables.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/parts.h"

namespace sinew::identify {

namespace {

using recording::Grid;

// What the file calls a wanted column.
std::string called_in(const Source& source, const std::string& name) {
  const auto said = source.names.find(name);
  return said == source.names.end() ? name : said->second;
}

std::optional<std::size_t> column_called(const Grid& grid, const std::string& name) {
  for (std::size_t i = 0; i < grid.headings().size(); ++i)
    if (grid.headings()[i].is_called(name)) return i;
  return std::nullopt;
}

// One source for each recording of a file: a logger that was started again begins a new one.
std::vector<Source> recordings_in(const Source& source) {
  if (source.part != 0 || !source.where.empty()) return {source};
  const Grid grid =
      recording::read_grid(std::string(text_of(source, "measurements as CSV")), source);
  const auto clock = column_called(grid, called_in(source, "time"));
  const std::size_t parts = recording::parts_of(grid, source, clock).size();
  if (parts < 2) return {source};
  std::vector<Source> out(parts, source);
  for (std::size_t i = 0; i < parts; ++i) out[i].part = static_cast<int>(i) + 1;
  return out;
}

bool has_column_of_volumes(const Source& source) {
  const Grid grid =
      recording::read_grid(std::string(text_of(source, "measurements as CSV")), source);
  return column_called(grid, called_in(source, "added_volume")).has_value();
}

// One for each source, between commas.
std::vector<AddedFill> fills_by_setting(const std::vector<Source>& sources,
                                        const std::string& settings) {
  const std::vector<std::string> pieces = config::at_commas(settings);
  if (pieces.size() != sources.size())
    config::fail({"added_volume", 0, 0}, "", fmt::format("{} volumes", pieces.size()),
                 fmt::format("one for each of {} files, between commas", sources.size()));
  std::vector<AddedFill> out;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double added = config::quantity_setting("added_volume", pieces[i], "m3",
                                                  sources[i].atmosphere, config::air_volume);
    Measured data = read_measured(sources[i], valve_columns());
    if (data.has("added_volume"))
      config::fail({"added_volume", 0, 0}, "", config::in_quotes(settings),
                   fmt::format("no such setting: {} has a column of that name", data.file));
    out.push_back({std::move(data), added});
  }
  return out;
}

}  // namespace

Measured read_valve(const Source& source) {
  try {
    return read_measured(source, valve_columns());
  } catch (const config::Error&) {
    // Of a chart the time tells nothing; of anything else it is what is wrong.
    std::vector<Wanted> timeless;
    for (const Wanted& w : valve_columns())
      if (w.name != "time") timeless.push_back(w);
    Source without = source;
    without.names.erase("time");
    try {
      Measured data = read_measured(without, timeless);
      const ValveData kind = valve_data(data);
      if (kind == ValveData::chart || kind == ValveData::duty) {
        data.notes.emplace_back("its times are out of order, which means nothing here");
        return data;
      }
    } catch (const std::exception&) {  // the first reason is the better one
    }
    throw;
  }
}

std::vector<AddedFill> added_fills(const std::vector<Source>& sources,
                                   const std::string& settings) {
  if (!settings.empty()) return fills_by_setting(sources, settings);
  if (!std::ranges::any_of(sources, has_column_of_volumes)) return {};
  std::vector<AddedFill> out;
  for (const Source& source : sources)
    for (const Source& recording : recordings_in(source))
      for (AddedFill& fill : fills_by_column(read_measured(recording, valve_columns())))
        out.push_back(std::move(fill));
  if (out.size() == 1) return {};  // one filling, whatever was joined
  return out;
}

}  // namespace sinew::identify
