// python/binding/sweep.cpp - many runs of an experiment, on all cores.
#include "sinew/tune/sweep.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "python/binding/numbers.h"
#include "sinew/host/side_by_side.h"
#include "sinew/tune/optimizer/optimize.h"
#include "sinew/tune/optimizer/tuned_text.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"
#include "sinew/units/quantity.h"

namespace sinew::python {

namespace {

// Returns a list of texts, or one text as a list. Throws TypeError for anything else.
std::vector<std::string> texts_of(const py::object& given, const char* name) {
  if (py::isinstance<py::str>(given)) return {given.cast<std::string>()};
  std::vector<std::string> out;
  if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) {
    for (const py::handle text : given) {
      if (!py::isinstance<py::str>(text)) break;
      out.push_back(text.cast<std::string>());
    }
    if (out.size() == py::len(given)) return out;
  }
  throw py::type_error(fmt::format("{}: found {}; expected text, or a list of texts", name,
                                   py::repr(given).cast<std::string>()));
}

// Returns "KEY=a,b,c unit"; numbers are in the SI unit of the key.
std::string axis_of(const std::string& key, const py::handle& values, const HeldExperiment& e) {
  if (py::isinstance<py::str>(values)) return key + "=" + values.cast<std::string>();
  const py::array given = py::array::ensure(values);
  if (given && given.dtype().kind() == 'U') {
    std::string words;
    for (const py::handle word : given.attr("ravel")())
      words += (words.empty() ? "" : ",") + py::str(word).cast<std::string>();
    return key + "=" + words;
  }
  const Numbers all = numbers(values, key.c_str());
  if (all.size() == 0)
    throw std::invalid_argument(fmt::format("{}: found no values; expected one at least", key));
  std::string text;
  for (py::ssize_t i = 0; i < all.size(); ++i)
    text += (i > 0 ? "," : "") + units::format_number(all.data()[i]);
  const std::string unit = si_unit_of(key, e.read.origins);
  return key + "=" + text + (unit.empty() || unit == "1" ? "" : " " + unit);
}

std::vector<std::string> axes_of(const py::object& vary, const HeldExperiment& e) {
  if (!py::isinstance<py::dict>(vary)) return texts_of(vary, "vary");
  std::vector<std::string> out;
  for (const auto& [key, values] : vary.cast<py::dict>())
    out.push_back(axis_of(py::str(key).cast<std::string>(), values, e));
  return out;
}

// Throws std::invalid_argument for a count below 0.
void check_counts(std::initializer_list<std::pair<const char*, int>> counts) {
  for (const auto& [name, value] : counts)
    if (value < 0)
      throw std::invalid_argument(fmt::format("{}: found {}; expected 0 or more", name, value));
}

// Calls the user's progress function.
void report_progress(const py::object& progress, std::int64_t done, std::size_t points) {
  if (!progress.is_none()) progress(done, points);
}

py::object sweep(const py::object& experiment, const py::object& vary, const py::object& report,
                 const py::object& sets, int seeds, int threads, const py::object& where,
                 const std::string& largest, const py::object& ranges, int points,
                 const py::object& progress, const std::string& device) {
  const ExperimentPointer e = experiment_of(experiment, sets);
  if (!e->text.empty())
    throw std::invalid_argument(
        "experiment: found one that was pickled; expected one that was read from its file");
  check_counts({{"seeds", seeds}, {"threads", threads}, {"points", points}});
  const tune::Sweep asked = tune::sweep_of({.experiment = e->path,
                                            .set = e->sets,
                                            .vary = axes_of(vary, *e),
                                            .where = texts_of(where, "where"),
                                            .report = texts_of(report, "report"),
                                            .range = texts_of(ranges, "ranges"),
                                            .points = points,
                                            .largest = largest,
                                            .seeds = seeds});
  std::atomic<bool> stop = false;
  std::atomic<std::int64_t> done = 0;
  const tune::Options options{.threads = host::threads_of(threads),
                              .device = run::parse_device(device),
                              .stop = &stop,
                              .progress = &done};
  std::vector<tune::Row> rows;
  const std::size_t all = tune::points(asked);
  do_interruptibly(
      stop,
      [&] {
        tune::check(asked);
        rows = tune::sweep(asked, options);
      },
      [&] { report_progress(progress, done.load(), all); });
  report_progress(progress, static_cast<std::int64_t>(all), all);
  // Without a run that has figures, the rows have the reasons.
  if (std::ranges::any_of(rows, &tune::Row::ok)) tune::refuse_empty_columns(rows, asked);
  return parsed(tune::json_of(tune::headings(asked), rows))["rows"];
}

// Returns the output of `sinew tune --json` for a tuning file.
py::object tune_file(const py::object& path, const py::object& results, const py::object& sets,
                     int generations, int threads, const py::object& progress,
                     const std::string& device) {
  check_counts({{"generations", generations}, {"threads", threads}});
  const std::string file = path_of(path), kept = path_of(results);
  const tune::Tuning tuning = tune::load_tuning(file, sets_without_numbers(sets), generations);
  std::atomic<bool> stop = false;
  std::atomic<std::int64_t> done = 0;
  tune::Tuned tuned;
  tune::StoredTuningOptions options{.ask_to_stop = [&] { stop.store(true); }};
  options.tune.runs = {.threads = host::threads_of(threads),
                       .device = run::parse_device(device),
                       .stop = &stop,
                       .progress = &done};
  const std::size_t all = tune::points(tuning.runs);
  do_interruptibly(
      stop, [&] { tuned = tune::optimize_and_store(tuning, kept, options); },
      [&] { report_progress(progress, done.load(), all); });
  return parsed(tune::json_of(tuning, tuned));
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def(
      "sweep", &sweep, py::arg("experiment"), py::arg("vary") = py::list(), py::kw_only(),
      py::arg("report") = py::list(), py::arg("sets") = py::none(), py::arg("seeds") = 0,
      py::arg("threads") = 0, py::arg("where") = py::list(), py::arg("largest") = "",
      py::arg("ranges") = py::list(), py::arg("points") = 0, py::arg("progress") = py::none(),
      py::arg("device") = "auto",
      "Runs an experiment many times, on all cores or so many `threads`, and returns a list of\n"
      "dicts, one for each run: what was varied, what is reported, and \"status\".\n"
      "\n"
      "`vary`: {key: values in SI}, all combinations; or texts as `sinew sweep --vary` takes.\n"
      "`report`: keys of the summary, each with a unit if you like: \"trolley.distance_m [in]\";\n"
      "without, what is reported of the experiment. `seeds`: each with the noise of seeds 1 to\n"
      "so many. `where`, `largest`, `ranges` and `points` are those of `sinew sweep`.\n"
      "`progress` is called with how many are done, and of how many; what it raises ends the\n"
      "sweep, as Ctrl-C does. `device`: \"auto\", \"cpu\", \"gpu\" or \"gpu:1\", the cores or a "
      "graphics\n"
      "card. The rows are the same for any number of threads and any device. A run that is\n"
      "refused or ends early has None in place of its figures, and the reason as its status.\n"
      "Raises InputError, and RuntimeError for a card that cannot be used.");
  m.def("tune", &tune_file, py::arg("path"), py::arg("results"), py::kw_only(),
        py::arg("sets") = py::none(), py::arg("generations") = 0, py::arg("threads") = 0,
        py::arg("progress") = py::none(), py::arg("device") = "auto",
        "Searches the best values of an experiment's keys, by a tuning's file, and returns\n"
        "what `sinew tune --json` prints. Every run is kept in the file `results`, with which a\n"
        "tuning that was interrupted continues. `generations` replaces the file's number.\n"
        "`threads`, `progress` and `device` are those of sweep(). Raises InputError, and "
        "RuntimeError where\n"
        "the library was built without pagmo.");
}

}  // namespace sinew::python
