// python/binding/bind.h - common declarations of the Python module `sinew._sinew`: a function for
// each source file, and shared helpers.
//
// The module only calls the library. Work that takes longer than some microseconds releases
// Python's lock (GIL), so that other threads of the program continue.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_experiment(py::module_& m);
void bind_files(py::module_& m);
void bind_values(py::module_& m);
void bind_simulation(py::module_& m);
void bind_loop(py::module_& m);
void bind_episode(py::module_& m);
void bind_recording(py::module_& m);
void bind_compare(py::module_& m);
void bind_run(py::module_& m);
void bind_imported(py::module_& m);
void bind_sweep(py::module_& m);
void bind_ensemble(py::module_& m);
void bind_laws(py::module_& m);
void bind_muscle(py::module_& m);
void bind_identify(py::module_& m);
void bind_identify_tables(py::module_& m);
void bind_design(py::module_& m);
void bind_fmu(py::module_& m);
void bind_figures(py::module_& m);

// Returns a new exception of the module, sinew.NAME, below `base`.
py::handle new_exception(py::module_& m, const char* name, const char* doc, const py::handle& base);

// Error for a run that ended before its plan: a muscle burst, the supervisor tripped. The message
// includes what was recorded before.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Experiment held by Python: read once, never changed.
struct HeldExperiment {
  std::string path;               // path of its file
  std::vector<std::string> sets;  // key=value, overrides the file's
  std::string text;               // replaces the file: a resolved one that was pickled
  experiment::Experiment read;
};
using ExperimentPointer = std::shared_ptr<HeldExperiment>;

// Returns a path that was given as text or as pathlib's. Throws TypeError for anything else.
std::string path_of(const py::handle& meant);
// Returns the same; empty for None.
std::string path_or_none(const py::handle& meant);
// Returns the paths of a list or of a single path.
std::vector<std::string> paths_of(const py::handle& meant);

// Convert a text to bytes and a path's bytes to text like Python's os module: a name that is not
// UTF-8 keeps its bytes.
std::string bytes_of(const py::handle& text);
py::object path_text(const std::string& path);

// Returns the SI unit of a key's numbers; that of Sinew's keys if the file lacks the key. Empty:
// none.
std::string si_unit_of(const std::string& key, const config::Origins& origins);

// Returns settings as texts "key=value" from None, a list of such texts, or a dict, whose numbers
// are in the SI units of the keys in `origins`. Throws TypeError for anything else.
std::vector<std::string> sets_of(const py::object& sets,
                                 const std::function<const config::Origins&()>& origins);

// Returns such settings for a file, whose keys have the units of numbers.
std::vector<std::string> sets_of(const py::object& sets, const std::string& path);
// Returns such settings where numbers have no unit. Throws TypeError for a number.
std::vector<std::string> sets_without_numbers(const py::object& sets);

// Returns the objects of a JSON text.
py::object parsed(const std::string& json);

// Returns the experiment given as an Experiment or a path. Throws TypeError for anything else, and
// config::Error.
ExperimentPointer experiment_of(const py::object& meant, const py::object& sets);
// Returns the same for work that reads the file again. Throws std::invalid_argument for an
// experiment that was pickled.
ExperimentPointer from_file(const py::object& meant, const py::object& sets);

// Runs `work` on a thread of its own, without Python's lock, and rethrows its exception. Meanwhile
// calls `poll` several times a second, with Python's lock. If Ctrl-C, another signal handler of
// Python or `poll` raises an exception, sets `stop`, waits for the end of the work, and raises it.
void do_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work,
                      const std::function<void()>& poll = {});

}  // namespace sinew::python
