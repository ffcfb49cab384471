// python/binding/run.cpp - whole runs, interrupted by Ctrl-C where Python is.
#include "sinew/run/simulation/run.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "python/binding/recording.h"
#include "sinew/config/node.h"
#include "sinew/run/folder/kept_run.h"
#include "sinew/run/folder/outcome.h"
#include "sinew/run/folder/runnable.h"

namespace sinew::python {

namespace {

using Pointer = std::shared_ptr<Recording>;

// The run in memory alone.
void run_here(const HeldExperiment& e, std::atomic<bool>& stop, Recording& out) {
  run::Outcome outcome = run::run(e.read, {.stop = &stop});
  if (outcome.stopped) return;
  if (outcome.ended_early()) throw RunError(run::black_box(e.read, outcome));
  if (!outcome.no_room.empty()) throw std::runtime_error(outcome.no_room);
  out.table = std::move(outcome.table);
  out.machine = analysis::read_machine(
      config::parse_text(experiment::resolved(e.read, SINEW_VERSION), "resolved.toml"));
  sum_up(out, *out.machine);
  for (std::string& text : run::warnings_beside_the_log(e.read, outcome))
    out.warnings.push_back(std::move(text));
}

// The run kept in a folder, as `sinew run` keeps it.
void run_kept(const HeldExperiment& e, const run::RunRequest& where, std::atomic<bool>& stop,
              Recording& out) {
  run::RunRequest request = where;
  request.experiment = e.path;
  request.sets = e.sets;
  run::KeptRun kept(
      request, {.on_warning = [&](std::string_view text) { out.warnings.emplace_back(text); }});
  run::RunOptions options{.stop = &stop};
  kept.apply(options);
  run::Outcome outcome = run::run(kept.experiment(), options);
  if (outcome.stopped) return;
  if (outcome.ended_early()) {
    const std::string words = run::black_box(kept.experiment(), outcome);
    try {
      (void)kept.keep(std::move(outcome));
    } catch (const std::exception& told) {  // says where its log is
      throw RunError(told.what());
    }
    throw RunError(words);
  }
  out.table = outcome.table;
  auto left = kept.keep(std::move(outcome));
  std::vector<std::string> warnings = std::move(out.warnings);
  out.folder = left.folder.string();
  out.machine = std::move(left.machine);
  sum_up(out, *out.machine);
  out.warnings = std::move(warnings);
}

Pointer run(const py::object& experiment, const py::object& sets, const py::object& where,
            bool force, bool report) {
  const std::string folder = where.is_none() ? "" : path_of(where);
  const ExperimentPointer e = experiment_of(experiment, sets);
  if (!folder.empty() && !e->text.empty())
    throw std::invalid_argument(
        "folder: found an experiment that was pickled; expected one that was read from its file");
  auto out = std::make_shared<Recording>();
  std::atomic<bool> stop = false;
  do_interruptibly(stop, [&] {
    if (folder.empty())
      run_here(*e, stop, *out);
    else
      run_kept(*e, {.folder = folder, .force = force, .report = report}, stop, *out);
  });
  return out;
}

}  // namespace

void do_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work,
                      const std::function<void()>& look) {
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
      if (look) look();
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
        "Runs an experiment to its end and returns what it recorded; in memory, or kept in\n"
        "`folder` as `sinew run` keeps it, where `force` replaces a run and `report` leaves its\n"
        "page. `experiment` is a path or an Experiment, `sets` as for Experiment. Ctrl-C ends it.\n"
        "Raises InputError, and RunError where it ends before its plan does.");
}

}  // namespace sinew::python
