// python/binding/bind.h - the parts of the Python module `sinew._sinew`: a function for each of its
// files, and what they share.
//
// The module only asks the library. Whatever takes longer than some microseconds is done without
// Python's lock, so that other threads of the program go on.
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
void bind_laws(py::module_& m);
void bind_muscle(py::module_& m);
void bind_identify(py::module_& m);
void bind_identify_tables(py::module_& m);
void bind_fmu(py::module_& m);
void bind_figures(py::module_& m);

// Returns a new exception of the module, sinew.NAME, below `base`.
py::handle new_exception(py::module_& m, const char* name, const char* doc, const py::handle& base);

// A run ended before its plan did: a muscle burst, the supervisor tripped. What was recorded until
// then is in the words.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An experiment as Python holds it: read once, never changed.
struct HeldExperiment {
  std::string path;               // of its file
  std::vector<std::string> sets;  // key=value in place of the file's
  std::string text;               // in place of the file: a resolved one that was pickled
  experiment::Experiment read;
};
using ExperimentPointer = std::shared_ptr<const HeldExperiment>;

// Returns a path that was given as text or as pathlib's. Throws TypeError for anything else.
std::string path_of(const py::handle& meant);

// The bytes of a text, and the text of a path's bytes, as Python's os has them: a name that is not
// UTF-8 keeps its bytes.
std::string bytes_of(const py::handle& text);
py::object path_text(const std::string& path);

// Returns settings as "key=value": of None, a list of such texts, or a dict, whose numbers are in
// the SI units that `origins` has of the keys. Throws TypeError for anything else.
std::vector<std::string> sets_of(const py::object& sets,
                                 const std::function<const config::Origins&()>& origins);

// Returns the experiment that is meant: one that is read already, or a path. Throws TypeError for
// anything else, and config::Error.
ExperimentPointer experiment_of(const py::object& meant, const py::object& sets);

// Does the work on a thread of its own, without Python's lock, until it returns; what it throws is
// thrown here. Meanwhile `look` is called some times a second, with Python's lock. Ctrl-C, and
// whatever else a signal handler of Python or `look` raises, sets `stop`, waits for the work's end,
// and is raised.
void do_interruptibly(std::atomic<bool>& stop, const std::function<void()>& work,
                      const std::function<void()>& look = {});

}  // namespace sinew::python
