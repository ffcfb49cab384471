// python/binding/recording.cpp - recorded runs as arrays.
#include "python/binding/recording.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/verdict/compare.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::python {

namespace {

using Pointer = std::shared_ptr<Recording>;

std::string name_of(const signals::Topic& topic, std::size_t field) {
  return topic.fields.size() > 1 ? topic.name + "." + topic.fields[field].name : topic.name;
}

// Returns numbers of a recording as a read-only array in its memory, which keeps the recording
// alive.
py::array view(const Pointer& recording, const std::vector<double>& values) {
  const auto owner = new Pointer(recording);
  const py::capsule base(owner, [](void* p) { delete static_cast<Pointer*>(p); });
  py::array_t<double> out(static_cast<py::ssize_t>(values.size()), values.data(), base);
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

std::string page(const Recording& recording) {
  if (recording.name.empty())
    throw std::invalid_argument("page: found what follows from a run; expected the run itself");
  // With Python's lock, as only one thread at a time may read samples that are in a file.
  return report::page(
      {.analysis = *recording.analysis, .resolved = recording.resolved, .name = recording.name});
}

// Returns the page for a notebook cell.
py::object cell(const Recording& recording) {
  if (recording.name.empty() || !report::has_page()) return py::none();
  return in_a_cell(page(recording));
}

Pointer derived(const Pointer& of) {
  if (of->analysis && of->analysis->machine.stand)
    throw std::invalid_argument("derived: found a run of a test stand; expected one of a machine");
  auto out = std::make_shared<Recording>();
  out->table = of->analysis->derived;
  out->summary = of->summary;
  out->verdicts = of->verdicts;
  out->folder = of->folder;
  out->board = of->board;
  return out;
}

}  // namespace

py::object in_a_cell(const std::string& page) {
  const py::object escape = py::module_::import("html").attr("escape");
  return py::str("<iframe srcdoc=\"") + py::str(escape(page, true)) +
         py::str("\" style=\"width: 100%; height: 720px; border: 0\"></iframe>");
}

void summarize(Recording& recording) {
  recording.analysis = std::make_unique<analysis::Analysis>(
      recording.table, analysis::read_machine(recording.resolved));
  const analysis::Analysis& a = *recording.analysis;
  recording.warnings = a.summary.warnings;
  recording.summary = to_json(a.summary);
  recording.verdicts = report::to_json(a.verdicts).text();
}

std::vector<Recording::Channel> Recording::channels() const {
  std::vector<Channel> out;
  for (const signals::Series& s : table.series)
    for (std::size_t f = 0; f < s.topic.fields.size(); ++f)
      out.push_back({name_of(s.topic, f), s.topic.fields[f].unit, s.topic.description});
  return out;
}

Recording::Place Recording::find(const std::string& channel) const {
  std::vector<std::string> names;
  for (std::size_t s = 0; s < table.series.size(); ++s) {
    const signals::Topic& topic = table.series[s].topic;
    for (std::size_t f = 0; f < topic.fields.size(); ++f) {
      names.push_back(name_of(topic, f));
      if (names.back() == channel) return {s, f};
    }
  }
  const std::string near = config::closest_in_quotes(channel, {names.begin(), names.end()});
  throw py::key_error(fmt::format("channel: found {}; expected one of `channels`{}",
                                  config::in_quotes(channel), near.empty() ? "" : "; try " + near));
}

const std::vector<double>& Recording::values(const std::string& channel) {
  const auto [series, field] = find(channel);
  const auto [at, is_new] = values_.try_emplace({series, field});
  if (is_new) at->second = table.series[series].columns[field].in_memory();
  return at->second;
}

const std::vector<double>& Recording::time(const std::string& channel) {
  const std::size_t series = find(channel).series;
  const auto [at, is_new] = times_.try_emplace(series);
  if (is_new) {
    at->second.reserve(table.series[series].time_ns.size());
    for (const std::int64_t ns : table.series[series].time_ns)
      at->second.push_back(1e-9 * static_cast<double>(ns));
  }
  return at->second;
}

Pointer read_run(const std::string& named) {
  auto out = std::make_shared<Recording>();
  const run::RunFiles run = run::run_files(named);
  run::require_finished(run.log);
  out->resolved = config::compose(run::machine_of(run, "").string());
  out->table = log::read(run.log);
  out->name = run::experiment_in(run.log);
  out->folder = run.log.parent_path().string();
  summarize(*out);
  return out;
}

void bind_recording(py::module_& m) {
  py::class_<Recording::Channel>(m, "RecordedChannel", "What a run recorded.")
      .def_readonly("name", &Recording::Channel::name, "Its name, \"/joint/hip/angle\".")
      .def_readonly("unit", &Recording::Channel::unit, "Its unit, \"rad\" for instance.")
      .def_readonly("description", &Recording::Channel::description, "What it is.")
      .def("__repr__", [](const Recording::Channel& c) {
        return fmt::format("<sinew.RecordedChannel {} [{}]>", c.name, c.unit);
      });
  py::class_<Recording, Pointer>(m, "Recording",
                                 "What a run recorded: its samples as arrays, its figures.")
      .def_property_readonly("channels", &Recording::channels, "What was recorded.")
      .def(
          "__getitem__",
          [](const Pointer& r, const std::string& channel) { return view(r, r->values(channel)); },
          py::arg("channel"),
          "Returns the samples of a channel in its unit, an array that is not copied and cannot\n"
          "be written to. Raises KeyError.")
      .def(
          "time",
          [](const Pointer& r, const std::string& channel) { return view(r, r->time(channel)); },
          py::arg("channel"),
          "Returns the times of a channel's samples, in seconds; topics that are sampled together\n"
          "have equal ones, valves' edges have their own.")
      .def_property_readonly(
          "complete", [](const Recording& r) { return r.table.complete; },
          "False: it was read from a log that was cut off.")
      .def_readonly("warnings", &Recording::warnings, "What is doubtful about it.")
      .def_property_readonly(
          "folder", [](const Recording& r) { return path_text(r.folder); },
          "Where it is kept; empty: nowhere.")
      .def_readonly("board", &Recording::board,
                    "Device at the port of the run; empty: it was simulated, or read.")
      .def_property_readonly(
          "summary", [](const Recording& r) { return parsed(r.summary); },
          "Its figures, as `sinew run` writes them to summary.json: dicts, SI.")
      .def_property_readonly(
          "verdicts", [](const Recording& r) { return parsed(r.verdicts); },
          "Reported values of the experiment and those of the run: a list of dicts.")
      .def("page", &page,
           "Returns the page that shows the run, report.html, which needs no network: HTML.\n"
           "Raises RuntimeError where the library was built without it.")
      .def("_repr_html_", &cell)
      .def("__repr__",
           [](const Recording& r) {
             return fmt::format("<sinew.Recording of {}: {} channels>",
                                r.name.empty() ? "derived values" : r.name, r.channels().size());
           })
      .def("derive", &derived,
           "Returns what follows from the samples: the foot's way and forces, torques, errors\n"
           "(docs/reference/analysis.md). Raises ValueError for a test stand's.");
  m.def(
      "read_run",
      [](const py::object& path) {
        const std::string named = path_of(path);
        const py::gil_scoped_release others;
        return read_run(named);
      },
      py::arg("path"),
      "Reads a run that is kept, by its folder or its log. Raises InputError and LogError.");
}

}  // namespace sinew::python
