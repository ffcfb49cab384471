// python/binding/ensemble.cpp - many runs that differ in some numbers: arrays in, arrays out.
#include "sinew/run/ensemble/ensemble.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <atomic>

#include "python/binding/numbers.h"
#include "python/binding/used.h"

namespace sinew::python {

namespace {

struct HeldEnsemble {
  run::Ensemble runs;
  std::vector<std::string> parameters, figures;
};

std::unique_ptr<HeldEnsemble> make(const py::object& experiment,
                                   const std::vector<std::string>& parameters,
                                   const std::vector<std::string>& figures, const py::object& sets,
                                   bool allow_unreachable) {
  const ExperimentPointer e = from_file(experiment, sets);
  return std::unique_ptr<HeldEnsemble>(new HeldEnsemble{
      {e->path, e->sets, parameters, figures, allow_unreachable}, parameters, figures});
}

// Runs the ensemble; returns its figures and the status of each run.
py::tuple run(const HeldEnsemble& self, const py::object& values, int threads,
              const py::object& progress, const std::string& device) {
  if (threads < 0)
    throw std::invalid_argument(fmt::format("threads: found {}; expected 0 or more", threads));
  const Numbers given = numbers(values, "values");
  const auto width = static_cast<py::ssize_t>(self.parameters.size());
  if (given.ndim() != 2 || given.shape(1) != width)
    throw std::invalid_argument(fmt::format(
        "values: found an array of shape {}; expected one row for each run, of {} "
        "numbers: {}",
        py::str(given.attr("shape")).cast<std::string>(), width, fmt::join(self.parameters, ", ")));
  const py::ssize_t rows = given.shape(0);
  Numbers figures({rows, static_cast<py::ssize_t>(self.figures.size())});
  const std::span<const double> from(given.data(), static_cast<std::size_t>(given.size()));
  const std::span<double> to(figures.mutable_data(), static_cast<std::size_t>(figures.size()));
  std::atomic<bool> stop = false;
  std::atomic<std::int64_t> done = 0;
  std::vector<std::string> status;
  const run::Device chosen = run::parse_device(device);
  do_interruptibly(
      stop,
      [&] {
        status = self.runs.run(
            from, to, {.threads = threads, .device = chosen, .stop = &stop, .progress = &done});
      },
      [&] {
        if (!progress.is_none()) progress(done.load(), rows);
      });
  if (!progress.is_none()) progress(rows, rows);
  return py::make_tuple(figures, status);
}

}  // namespace

void bind_ensemble(py::module_& m) {
  py::class_<HeldEnsemble>(
      m, "Ensemble",
      "Many runs of one experiment that differ in some of its numbers: numbers in, figures out.\n"
      "\n"
      "    walks = sinew.Ensemble(\"walk-test-1\", [\"joint.hip.damping\", \"seed\"],\n"
      "                           [\"trolley.distance_m\"])\n"
      "    distance = walks(numpy.array([[0.1, 1], [0.2, 1]]))   # of shape (2, 1) [m]\n"
      "\n"
      "The experiment is read and checked once. The figures have the bits of run() with the same\n"
      "values.")
      .def(
          py::init(&make), py::arg("experiment"), py::arg("parameters"), py::arg("figures"),
          py::kw_only(), py::arg("sets") = py::none(), py::arg("allow_unreachable") = false,
          "`parameters`: keys of numbers in the experiment, also of an element of a list,\n"
          "\"polynomial[1]\"; `figures`: keys of its summary; `sets`: other settings of all runs.\n"
          "Raises InputError, also for a parameter that does not exist, is not a number or is\n"
          "given twice.")
      .def_property_readonly(
          "parameters", [](const HeldEnsemble& self) { return self.parameters; },
          "The keys of the parameters, a column of the values each.")
      .def_property_readonly(
          "figures", [](const HeldEnsemble& self) { return self.figures; },
          "The keys of the figures, a column of the result each.")
      .def_property_readonly(
          "units", [](const HeldEnsemble& self) { return self.runs.units(); },
          "The SI unit of each parameter; \"\" for a whole number.")
      .def(
          "run", &run, py::arg("values"), py::kw_only(), py::arg("threads") = 0,
          py::arg("progress") = py::none(), py::arg("device") = "auto",
          "Runs one experiment per row of `values` [SI], on all cores or on so many `threads`, or\n"
          "on a graphics card: `device` is \"auto\", \"cpu\", \"gpu\" or \"gpu:1\".\n"
          "Returns the figures, an array [SI] with a row per run, and a list of texts: \"ok\", or\n"
          "why that run has no figures, which are NaN then. A figure that a run lacks is NaN, "
          "too.\n"
          "`progress` is called with the numbers of completed and of all runs; an exception that\n"
          "it raises ends the ensemble, as Ctrl-C does. Raises ValueError for another shape,\n"
          "InputError for a figure that neither these runs nor the experiment as it is have and\n"
          "that resembles one of theirs, and RuntimeError for a card that cannot be used.")
      .def(
          "__call__",
          [](const HeldEnsemble& self, const py::object& values, int threads,
             const std::string& device) -> py::object {
            return run(self, values, threads, py::none(), device)[0];
          },
          py::arg("values"), py::kw_only(), py::arg("threads") = 0, py::arg("device") = "auto",
          "Returns the figures of run(), without the reasons of runs that have none.");
}

}  // namespace sinew::python
