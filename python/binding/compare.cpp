// python/binding/compare.cpp - comparison and replay of kept runs.
#include <pybind11/stl.h>

#include "python/binding/bind.h"
#include "python/binding/recording.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/replayed.h"

namespace sinew::python {

namespace {

std::vector<std::string> folders_of(const py::sequence& runs) {
  std::vector<std::string> out;
  for (const py::handle& run : runs) {
    const bool recorded = py::isinstance<Recording>(run);
    out.push_back(recorded ? run.cast<std::shared_ptr<Recording>>()->folder : path_of(run));
    if (recorded && out.back().empty())
      throw py::value_error(
          "compare: found a run that is kept nowhere; expected one with a folder");
  }
  if (out.size() < 2) throw py::value_error("compare: found fewer than two runs; expected 2 to 8");
  return out;
}

report::AlignOptions align_options_of(const std::string& align, const std::string& event,
                                      const std::vector<std::string>& align_by,
                                      const std::string& clock, double within) {
  if (clock != "none" && clock != "fit")
    throw py::value_error("clock: found " + config::in_quotes(clock) + "; expected none or fit");
  report::AlignOptions align_options(align_of(align));
  align_options.event = event;
  align_options.channels = align_by;
  align_options.fit_clock = clock == "fit";
  align_options.largest_shift = within;
  return align_options;
}

py::object compare(const py::sequence& runs, const std::string& align, const std::string& event,
                   const std::vector<std::string>& align_by, const std::string& clock,
                   double within, const std::vector<std::string>& channels) {
  const std::vector<std::string> paths = folders_of(runs);
  const report::AlignOptions align_options =
      align_options_of(align, event, align_by, clock, within);
  std::string json;
  {
    const py::gil_scoped_release others;
    json = to_json(run::compare_runs(paths, align_options, channels));
  }
  return parsed(json);
}

py::object replay(const py::object& path, const std::string& of, const py::object& sets,
                  double band, const py::object& folder, bool force) {
  if (of != "controller" && of != "plant")
    throw py::value_error("of: found " + config::in_quotes(of) + "; expected controller or plant");
  run::ReplayRequest request{
      .run = path_of(path), .sets = sets_without_numbers(sets), .force = force, .band = band};
  if (of == "plant") request.of = run::ReplayOf::plant;
  if (!folder.is_none()) request.folder = path_of(folder);
  std::string json;
  {
    const py::gil_scoped_release others;
    json = to_json(run::replay_run(request));
  }
  return parsed(json);
}

}  // namespace

report::Align align_of(const std::string& word) {
  using report::Align;
  for (const Align by : {Align::start, Align::sequence, Align::event, Align::correlation})
    if (to_text(by) == word) return by;
  throw py::value_error("align: found " + config::in_quotes(word) +
                        "; expected start, sequence, event or correlation");
}

void bind_compare(py::module_& m) {
  m.def(
      "compare", &compare, py::arg("runs"), py::kw_only(), py::arg("align") = "start",
      py::arg("event") = "", py::arg("align_by") = std::vector<std::string>(),
      py::arg("clock") = "none", py::arg("within") = std::numeric_limits<double>::infinity(),
      py::arg("channels") = std::vector<std::string>(),
      "Holds kept runs, by their folders or logs, against the first of them: `runs` with their\n"
      "`alignment`, `figures`, `parameters` that differ, and `channels` with rms, bias, largest\n"
      "difference and correlation, as `sinew compare --json` prints them; SI.\n"
      "\n"
      "`align`: start, sequence, event or correlation; `event`: \"/joint/elbow/angle > 10 deg\",\n"
      "else the surest first motion; `align_by`: channels that are correlated, else chosen;\n"
      "`clock`: fit finds the rate of each run's clock and takes it out; `within`: the largest\n"
      "shift that is looked for, in s. Raises InputError, saying why, where runs cannot be laid\n"
      "on each other so.");
  m.def(
      "replay", &replay, py::arg("path"), py::kw_only(), py::arg("of") = "controller",
      py::arg("sets") = py::none(), py::arg("band") = 0.05, py::arg("folder") = py::none(),
      py::arg("force") = false,
      "Feeds the readings of a kept run to the present controller (`of` controller), or its "
      "valves'\n"
      "commands to today's plant (plant), and returns where what comes out parts from what was\n"
      "recorded, as `sinew replay --json` prints it. `sets`: \"key=value\" in place of the run's;\n"
      "`band`: the share of a channel's range beyond which it has parted; `folder`: keeps the\n"
      "replay as a run. Raises InputError, naming the topics, where the run lacks what is fed.");
}

}  // namespace sinew::python
