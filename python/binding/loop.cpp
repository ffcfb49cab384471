// python/binding/loop.cpp - step function for a user's controller: numbers in, numbers out, without
// text conversion.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/binding/numbers.h"
#include "python/binding/simulation.h"

namespace sinew::python {

namespace {

using Use = HeldSimulation::Use;
using HeldPointer = std::shared_ptr<HeldSimulation>;

// Stores the indices of the settings to write and the channels to read. They are valid for every
// simulation of an experiment with the same robot.
class Loop {
 public:
  Loop(HeldPointer simulation, const std::vector<std::string>& writes,
       const std::vector<std::string>& reads, double period)
      : simulation_(std::move(simulation)), period_(period) {
    check_time(period);
    if (period < signals::tick_seconds)
      throw std::invalid_argument(
          fmt::format("period: found {} s; expected a tick, 0.1 ms, at least", period));
    const Use use(*simulation_);
    for (const std::string& key : writes) settings_.push_back(use->find_setting(key));
    for (const std::string& name : reads) channels_.push_back(use->find(name));
  }

  const HeldPointer& simulation() const { return simulation_; }
  double period() const { return period_; }
  std::size_t writes() const { return settings_.size(); }
  std::size_t reads() const { return channels_.size(); }

  // Writes, advances by a period, and reads. The caller holds Python's lock.
  void step(const double* written, double* out) {
    const Use use(*simulation_);
    write(*use, written);
    advance(*use, period_);
    use->read(channels_, {out, channels_.size()});
  }
  void read(double* out) { Use(*simulation_)->read(channels_, {out, channels_.size()}); }

 private:
  void write(run::Simulation& simulation, const double* written) const {
    for (std::size_t i = 0; i < settings_.size(); ++i)
      if (!std::isnan(written[i])) simulation.change(settings_[i], written[i]);
  }

  HeldPointer simulation_;
  double period_;
  std::vector<std::size_t> settings_, channels_;
};

Numbers step(Loop& loop, const py::object& given) {
  const Numbers values = numbers(given, "values");
  check_shape(values, {loop.writes()}, "values");
  Numbers out(static_cast<py::ssize_t>(loop.reads()));
  loop.step(values.data(), out.mutable_data());
  return out;
}

Numbers read(Loop& loop) {
  Numbers out(static_cast<py::ssize_t>(loop.reads()));
  loop.read(out.mutable_data());
  return out;
}

Numbers step_each(const std::vector<Loop*>& loops, const py::object& given) {
  const Numbers values = numbers(given, "values");
  if (loops.empty()) throw std::invalid_argument("loops: found none; expected one at least");
  const std::size_t writes = loops[0]->writes(), reads = loops[0]->reads();
  for (const Loop* loop : loops)
    if (!loop || loop->writes() != writes || loop->reads() != reads)
      throw std::invalid_argument(
          "loops: found some that write or read another number of values; expected all alike");
  check_shape(values, {loops.size(), writes}, "values");
  Numbers out({loops.size(), reads});
  for (std::size_t i = 0; i < loops.size(); ++i)
    loops[i]->step(values.data() + i * writes, out.mutable_data() + i * reads);
  return out;
}

}  // namespace

void bind_loop(py::module_& m) {
  py::class_<Loop>(m, "Loop",
                   "A simulation with what a controller of yours writes and reads each period.")
      .def(py::init<HeldPointer, const std::vector<std::string>&, const std::vector<std::string>&,
                    double>(),
           py::arg("simulation").none(false), py::arg("write"), py::arg("read"),
           py::arg("period") = 0.01,
           "`write` are keys of settings, `read` names of channels; `period` in seconds, the\n"
           "gait controller's 0.01 if not given. Raises ValueError for an unknown name.")
      .def_property_readonly("simulation", &Loop::simulation, "What it steps.")
      .def_property_readonly("period", &Loop::period, "Of a step, in seconds.")
      .def("step", &step, py::arg("values"),
           "Sets the settings to these values, in SI (NaN: left as it is), runs on by a period,\n"
           "and returns what is read, an array. Raises RunError and ValueError.")
      .def("read", &read,
           "Returns the present values of the channels to read; time does not advance.");
  m.def("step_all", &step_each, py::arg("loops"), py::arg("values"),
        "Steps loops that are alike, one after the other: `values` has a row for each. Returns a\n"
        "row of readings for each. Raises as Loop.step() does.");
}

}  // namespace sinew::python
