// python/binding/simulation.cpp - simulation advanced from Python.
#include "python/binding/simulation.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "sinew/run/folder/run_storage.h"

namespace sinew::python {

namespace {

using run::Simulation;
using signals::Tick;
using HeldPointer = std::shared_ptr<HeldSimulation>;
using Use = HeldSimulation::Use;

// Ticks between two checks for Ctrl-C: some ten milliseconds of computing time.
constexpr Tick slice = 100'000;

HeldPointer copied(HeldSimulation& of) {
  auto copy = std::make_shared<HeldSimulation>(of.experiment());
  Use(*copy)->restore(Use(of)->save());
  return copy;
}

py::bytes saved(HeldSimulation& s) {
  const std::vector<std::byte> bytes = Use(s)->save();
  return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void restore(HeldSimulation& s, const py::bytes& saved) {
  const auto bytes = static_cast<std::string_view>(saved);
  Use(s)->restore(std::as_bytes(std::span(bytes)));
}

void advance_to(HeldSimulation& s, Tick tick) {
  const Use use(s);
  if (tick < use->tick())
    throw std::invalid_argument(fmt::format(
        "tick: found {}; expected {} or later, where the simulation stands", tick, use->tick()));
  advance(*use, static_cast<double>(tick - use->tick()) * signals::tick_seconds);
}

double read(HeldSimulation& s, const py::object& channel) {
  const Use use(s);
  if (py::isinstance<py::str>(channel)) return use->read(channel.cast<std::string>());
  if (PyIndex_Check(channel.ptr()) == 0)
    throw py::type_error(fmt::format("channel: found {}; expected a name, or a place in channels",
                                     py::repr(channel).cast<std::string>()));
  const py::ssize_t number = PyNumber_AsSsize_t(channel.ptr(), nullptr);  // huge: clamped
  if (number < 0 || static_cast<std::size_t>(number) >= use->channels().size())
    throw py::index_error(fmt::format("channel: found {}; expected 0 to {}",
                                      py::str(channel).cast<std::string>(),
                                      use->channels().size() - 1));
  return use->read(static_cast<std::size_t>(number));
}

void bind_parts(py::module_& m) {
  py::class_<Simulation::Channel>(m, "Channel", "What can be read of a run.")
      .def_readonly("name", &Simulation::Channel::name, "Its name, \"/joint/hip/angle\".")
      .def_readonly("unit", &Simulation::Channel::unit, "Its unit, \"rad\" for instance.")
      .def("__repr__", [](const Simulation::Channel& c) {
        return fmt::format("<sinew.Channel {} [{}]>", c.name, c.unit);
      });
  py::class_<gait::Setting>(m, "Setting", "What can be changed of a run while it goes.")
      .def_readonly("key", &gait::Setting::key, "Its key, \"control.stiffness.hip\".")
      .def_property_readonly(
          "unit", [](const gait::Setting& s) { return std::string(s.unit); }, "Its SI unit.")
      .def("__repr__", [](const gait::Setting& s) {
        return fmt::format("<sinew.Setting {} [{}]>", s.key, s.unit);
      });
}

using Class = py::class_<HeldSimulation, HeldPointer>;

void bind_time(Class& c) {
  c.def_property_readonly(
       "time", [](HeldSimulation& s) { return Use(s)->time(); }, "Where it stands, in seconds.")
      .def_property_readonly(
          "tick", [](HeldSimulation& s) { return Use(s)->tick(); },
          "Where it stands, in ticks of 0.1 ms.")
      .def_property_readonly(
          "ended", [](HeldSimulation& s) { return Use(s)->ended(); },
          "Has the plan come to its end, or has something failed?")
      .def(
          "advance", [](HeldSimulation& s, double seconds) { advance(*Use(s), seconds); },
          py::arg("seconds"),
          "Runs on by seconds, rounded to ticks of 0.1 ms, at most to the plan's end. Raises\n"
          "RunError where something fails, and ValueError for what is no time.")
      .def("advance_to", &advance_to, py::arg("tick"),
           "Runs all that happens before the tick. Raises as advance() does.");
}

void bind_looks(Class& c) {
  c.def_property_readonly(
       "channels", [](HeldSimulation& s) { return Use(s)->channels(); },
       "What can be read, each with its unit.")
      .def("read", &read, py::arg("channel"),
           "Returns the value of a channel now, by its name or its place in `channels`, in its\n"
           "unit. Changes nothing. Raises ValueError or IndexError for an unknown one.")
      .def_property_readonly(
          "settings", [](HeldSimulation& s) { return Use(s)->settings(); },
          "What can be changed, each with its unit.")
      .def(
          "setting",
          [](HeldSimulation& s, const std::string& key) {
            const Use use(s);
            return use->value_of(use->find_setting(key));
          },
          py::arg("key"),
          "Returns what a setting is at now, the plan's or what was set in its place, in SI; of\n"
          "the first leg. Raises ValueError for an unknown one.")
      .def(
          "change",
          [](HeldSimulation& s, const std::string& key, double value, const std::string& leg) {
            Use(s)->change(key, value, leg);
          },
          py::arg("key"), py::arg("value"), py::arg("leg") = "",
          "Sets gain, stiffness or angle in place of the plan's, in SI, from the next period\n"
          "start on; of every leg where none is named. Raises ValueError.")
      .def(
          "release",
          [](HeldSimulation& s, const std::string& key, const std::string& leg) {
            Use(s)->release(key, leg);
          },
          py::arg("key"), py::arg("leg") = "", "Gives a setting back to the plan.");
}

void bind_saves(Class& c) {
  bind_states(c, &saved, &restore, &copied, "an experiment with other values");
  c.def(py::pickle([](HeldSimulation& s) { return py::make_tuple(s.experiment(), saved(s)); },
                   [](const py::tuple& state) {
                     auto made =
                         std::make_shared<HeldSimulation>(state[0].cast<ExperimentPointer>());
                     restore(*made, state[1].cast<py::bytes>());
                     return made;
                   }));
}

}  // namespace

void check_time(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e9)
    throw std::invalid_argument(
        fmt::format("seconds: found {}; expected a time from 0 to 1e9 s", seconds));
}

void refuse_failed(const Simulation& simulation) {
  if (const std::string cause = simulation.cause(); !cause.empty()) throw RunError(cause);
}

void advance(Simulation& simulation, double seconds) {
  check_time(seconds);
  const Tick asked = std::llround(seconds / signals::tick_seconds);
  const Tick until = std::min(simulation.tick() + asked, simulation.last());
  if (until - simulation.tick() < slice) {
    simulation.advance_to(until);
  } else {
    while (simulation.tick() < until && !simulation.ended()) {
      {
        const py::gil_scoped_release others;
        simulation.advance_to(std::min(until, simulation.tick() + slice));
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
  }
  if (simulation.ended()) refuse_failed(simulation);
}

void bind_simulation(py::module_& m) {
  bind_parts(m);
  Class c(m, "Simulation",
          "A run that you hold: advance it, read it, change it, save and restore it. However it\n"
          "is cut into advances, looked at and restored: the same bits as a run at one go.");
  c.def(py::init([](const py::object& experiment, const py::object& sets) {
          const ExperimentPointer e = experiment_of(experiment, sets);
          run::refuse_unrunnable(e->read, false);
          return std::make_shared<HeldSimulation>(e);
        }),
        py::arg("experiment"), py::arg("sets") = py::none(),
        "At its start. `experiment` is a path or an Experiment, `sets` as for Experiment. Raises\n"
        "InputError.");
  c.def_property_readonly(
      "experiment", [](HeldSimulation& s) { return s.experiment(); }, "What is run.");
  c.def_property_readonly(
      "duration",
      [](HeldSimulation& s) { return static_cast<double>(Use(s)->last()) * signals::tick_seconds; },
      "Of the whole plan, in seconds.");
  bind_time(c);
  bind_looks(c);
  bind_saves(c);
  c.def("__repr__", [](HeldSimulation& s) {
    return fmt::format("<sinew.Simulation {} at {:g} s>", s.experiment()->path, Use(s)->time());
  });
}

}  // namespace sinew::python
