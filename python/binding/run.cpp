// python/binding/run.cpp - whole runs, interruptible by Ctrl-C.
#include "sinew/run/simulation/run.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "python/binding/recording.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/config/node.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/run/simulation/place.h"

namespace sinew::python {

namespace {

using Pointer = std::shared_ptr<Recording>;

// Runs in memory only, simulated or on a board that is ready.
void run_here(const HeldExperiment& e, const run::RunRequest& request, std::atomic<bool>& stop,
              Recording& out) {
  run::refuse_unrunnable(e.read, false);
  out.resolved = config::parse_text(experiment::resolved(e.read, SINEW_VERSION), "resolved.toml");
  (void)analysis::read_machine(out.resolved);  // refuses what cannot be summarised
  run::Place place(request.port, e.read);
  place.prepare(request.clear_fault, &stop);
  out.board = place.who();
  out.warnings = place.messages();
  run::RunOptions options{.stop = &stop};
  place.apply(options);
  run::Outcome outcome = run::run(e.read, options);
  if (outcome.stopped) return;
  if (outcome.ended_early()) throw RunError(run::last_records(e.read, outcome));
  if (!outcome.no_room.empty()) throw std::runtime_error(outcome.no_room);
  out.table = std::move(outcome.table);
  out.name = e.read.name;
  summarize(out);
  for (std::string& text : run::warnings_outside_log(e.read, outcome))
    out.warnings.push_back(std::move(text));
}

// Runs and keeps the run in a folder like `sinew run`.
void run_kept(const run::RunRequest& request, std::atomic<bool>& stop, Recording& out) {
  std::vector<std::string> warnings;
  run::RunRequest stopped_by_python = request;
  stopped_by_python.stop = &stop;
  run::RunStorage kept(stopped_by_python,
                       {.on_warning = [&](std::string_view text) { warnings.emplace_back(text); }});
  run::RunOptions options;
  kept.apply(options);
  out.board = kept.place().who();
  for (const std::string& line : kept.place().messages()) warnings.push_back(line);
  run::Outcome outcome = run::run(kept.experiment(), options);
  if (outcome.stopped) return;
  out.table = outcome.table;
  out.resolved = kept.values();
  out.name = kept.experiment().name;
  if (outcome.ended_early()) {
    const std::string words = run::last_records(kept.experiment(), outcome);
    try {
      (void)kept.store(std::move(outcome));
    } catch (const std::exception& failure) {  // the message has the place of the log
      throw RunError(failure.what());
    }
    throw RunError(words);
  }
  out.folder = kept.store(std::move(outcome)).folder.string();
  summarize(out);
  out.warnings = std::move(warnings);
}

// Throws std::invalid_argument for an invalid port.
void check_place(const std::string& place) {
  if (const std::string wrong = run::problem_of_place(place); !wrong.empty())
    throw std::invalid_argument("port: " + wrong);
}

Pointer run(const py::object& experiment, const py::object& sets, const py::object& folder,
            bool force, bool report, const std::string& port, bool clear_fault) {
  auto out = std::make_shared<Recording>();
  run::RunRequest request{.folder = path_or_none(folder),
                          .force = force,
                          .report = report,
                          .port = port,
                          .clear_fault = clear_fault};
  std::atomic<bool> stop = false;
  check_place(port);
  const ExperimentPointer e = experiment_of(experiment, sets);
  if (!request.folder.empty() && !e->text.empty())
    throw std::invalid_argument(
        "folder: found an experiment that was pickled; expected one that was read from its file");
  request.experiment = e->path;
  request.sets = e->sets;
  do_interruptibly(stop, [&] {
    if (request.folder.empty())
      run_here(*e, request, stop, *out);
    else
      run_kept(request, stop, *out);
  });
  return out;
}

}  // namespace

void do_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work,
                      const std::function<void()>& poll) {
  std::mutex mutex;
  std::condition_variable finished;
  bool done = false;
  std::exception_ptr failure, interruption;
  std::thread worker([&] {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    done = true;
    finished.notify_one();
  });
  const auto wait = [&](auto time) {
    const py::gil_scoped_release others;
    std::unique_lock lock(mutex);
    return finished.wait_for(lock, time, [&] { return done; });
  };
  while (!wait(std::chrono::milliseconds(20)) && !interruption) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (poll) poll();
    } catch (...) {
      interruption = std::current_exception();
      stop.store(true);
    }
  }
  while (!wait(std::chrono::hours(1))) {}
  worker.join();
  if (interruption) std::rethrow_exception(interruption);
  if (failure) std::rethrow_exception(failure);
}

void bind_run(py::module_& m) {
  m.def("run", &run, py::arg("experiment"), py::arg("sets") = py::none(), py::kw_only(),
        py::arg("folder") = py::none(), py::arg("force") = false, py::arg("report") = true,
        py::arg("port") = "", py::arg("clear_fault") = false,
        "Runs an experiment to its end and returns what it recorded; in memory, or kept in\n"
        "`folder` as `sinew run` keeps it, where `force` replaces a run and `report` leaves its\n"
        "page. `experiment` is a path, also of an experiment on the test stand, or an Experiment;\n"
        "`sets` are as for Experiment. Ctrl-C ends it.\n"
        "\n"
        "`port` is where it runs: \"simulated\", \"serial:DEVICE[@RATE]\", \"emulated:FILE\",\n"
        "\"lock-step:FILE\" or \"comedi:DEVICE\", as behind `sinew run --port`; `clear_fault`: a\n"
        "board that dumped by itself was looked into. Ctrl-C lets the air out of a machine.\n"
        "\n"
        "Raises InputError, BoardError where a board or card is not there or not as it should be,\n"
        "and RunError where the run ends before its plan does.");
}

}  // namespace sinew::python
