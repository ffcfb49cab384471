// python/binding/imported.cpp - import of laboratory recordings as runs.
#include <pybind11/stl.h>

#include <map>
#include <optional>

#include "python/binding/recording.h"
#include "sinew/recording/mapping.h"
#include "sinew/run/folder/imported_run.h"

namespace sinew::python {

namespace {

using Texts = std::map<std::string, std::string>;

// Column settings of a caller.
struct MappingArguments {
  Texts map, units, offset, where;
  std::map<std::string, double> scale;
};

recording::Mapping mapping_of(const MappingArguments& arguments) {
  recording::Mapping out;
  for (const auto& [channel, column] : arguments.map) map_channel(out, channel, column);
  for (const auto& [column, unit] : arguments.units) map_unit(out, column, unit);
  for (const auto& [column, scale] : arguments.scale) map_scale(out, column, scale);
  for (const auto& [column, offset] : arguments.offset) map_offset(out, column, offset);
  for (const auto& [column, values] : arguments.where) map_where(out, column, values);
  return out;
}

bool is_at_end(const std::string& join) {
  if (join == "end" || join == "side") return join == "end";
  throw std::invalid_argument("join: found \"" + join +
                              "\"; expected \"side\", side by side in time, or \"end\"");
}

struct Clock {
  std::string time, time_unit, rate, start;
  double scale = 1;
};

std::shared_ptr<Recording> import_recording(
    const py::object& files, const py::object& experiment, const Texts& map, const Texts& units,
    const std::map<std::string, double>& scale, const Texts& offset, const Texts& where,
    const py::object& mapping, const py::object& save_mapping, bool keep_others, const Clock& clock,
    const std::string& join, const Texts& shift, const recording::TableSettings& table,
    const py::object& sets, const py::object& folder, bool force) {
  run::ImportRequest request{.files = paths_of(files),
                             .experiment = path_of(experiment),
                             .mapping_file = path_or_none(mapping),
                             .mapping = mapping_of({map, units, offset, where, scale}),
                             .join_at_end = is_at_end(join),
                             .shifts = shift,
                             .save_mapping = path_or_none(save_mapping),
                             .folder = path_or_none(folder),
                             .force = force};
  request.mapping.keep_others = keep_others;
  request.mapping.clock = {clock.time, clock.time_unit, clock.rate, clock.scale, clock.start};
  request.mapping.table = table;
  request.sets = experiment_of(experiment, sets)->sets;
  std::vector<std::string> notes;
  const run::Notices notices{.on_note = [&](std::string_view note) { notes.emplace_back(note); }};
  std::shared_ptr<Recording> out;
  {
    const py::gil_scoped_release others;
    out = read_run(run::import_run(request, notices).folder.string());
  }
  for (std::string& note : notes) out->warnings.push_back(std::move(note));
  return out;
}

}  // namespace

void bind_imported(py::module_& m) {
  m.def(
      "import_recording",
      [](const py::object& files, const py::object& experiment, const Texts& map,
         const Texts& units, const std::map<std::string, double>& scale, const Texts& offset,
         const Texts& where, const py::object& mapping, const py::object& save_mapping,
         bool keep_others, const std::string& time, const std::string& time_unit,
         const std::string& rate, double clock_scale, const std::string& start,
         const std::string& join, const Texts& shift, const std::vector<std::string>& columns,
         const std::string& encoding, const std::string& decimal, const std::string& thousands,
         const std::string& dates, bool spread_times, bool drop_incomplete, int part,
         const py::object& sets, const py::object& folder, bool force) {
        return import_recording(files, experiment, map, units, scale, offset, where, mapping,
                                save_mapping, keep_others,
                                {time, time_unit, rate, start, clock_scale}, join, shift,
                                {.encoding = encoding,
                                 .decimal = decimal,
                                 .thousands = thousands,
                                 .dates = dates,
                                 .spread_times = spread_times,
                                 .drop_incomplete = drop_incomplete,
                                 .columns = columns,
                                 .part = part},
                                sets, folder, force);
      },
      py::arg("files"), py::arg("experiment"), py::kw_only(), py::arg("map") = Texts{},
      py::arg("units") = Texts{}, py::arg("scale") = std::map<std::string, double>{},
      py::arg("offset") = Texts{}, py::arg("where") = Texts{}, py::arg("mapping") = py::none(),
      py::arg("save_mapping") = py::none(), py::arg("keep_others") = false, py::arg("time") = "",
      py::arg("time_unit") = "", py::arg("rate") = "", py::arg("clock_scale") = 1.0,
      py::arg("start") = "", py::arg("join") = "side", py::arg("shift") = Texts{},
      py::arg("columns") = std::vector<std::string>{}, py::arg("encoding") = "",
      py::arg("decimal") = "", py::arg("thousands") = "", py::arg("dates") = "",
      py::arg("spread_times") = false, py::arg("drop_incomplete") = false, py::arg("part") = 0,
      py::arg("sets") = py::none(), py::arg("folder") = py::none(), py::arg("force") = false,
      "Keeps recordings of a laboratory - CSV, MCAP, MATLAB's .mat - as a run, and returns it.\n"
      "`experiment` is the file of what was run: its robot, or its test stand.\n"
      "\n"
      "`map` gives the column of a channel, {\"/joint/elbow/angle\": \"Winkel\"}; `units`,\n"
      "`scale`, `offset` and `where` are by column: value = scale x number [unit] + offset, of\n"
      "rows that have one of the values of `where`. `mapping` is a file with all of these, which\n"
      "`save_mapping` writes. Columns that are no channel are left out, or kept as\n"
      "/recorded/NAME with `keep_others`.\n"
      "\n"
      "`time` and `time_unit` are the column of times, `rate` (\"100 Hz\") replaces it;\n"
      "`clock_scale` are true seconds in a second of the recording's clock, `start` its time\n"
      "that becomes 0. Several files lie side by side in time, or end to end with join=\"end\";\n"
      "`shift` is by how much a file is later, {\"force.csv\": \"0.12 s\"}.\n"
      "\n"
      "The run is kept in `folder`, or in runs/<experiment>/<n>; its `warnings` hold what was\n"
      "left out and filled in. Raises InputError and LogError.");
}

}  // namespace sinew::python
