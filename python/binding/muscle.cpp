// python/binding/muscle.cpp - muscle with its valves, hose and supply, simulated from a Python
// loop.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>

#include "python/binding/numbers.h"
#include "python/binding/used.h"
#include "sinew/actuator/actuator.h"
#include "sinew/run/muscle/muscle_setup.h"
#include "sinew/world/driven/driven_muscle.h"

namespace sinew::python {

namespace {

constexpr double longest_step = 10;  // limit of one call [s]
constexpr double slice = 10;         // simulated time between two checks for Ctrl-C [s]

// Muscle that only one thread at a time may use.
class HeldMuscle : public Guarded<air::DrivenMuscle> {
 public:
  HeldMuscle(std::string its_path, run::MuscleSetup its_setup, double length, double pressure)
      : Guarded("muscle", its_setup.muscle, its_setup.air, its_setup.supply, length, pressure),
        path(std::move(its_path)),
        setup(std::move(its_setup)),
        start_length(length) {}

  const std::string path;
  const run::MuscleSetup setup;
  const double start_length;  // [m]
};

using Held = std::shared_ptr<HeldMuscle>;
using UseMuscle = HeldMuscle::Use;

// --- construction, copies, saved states ---

// Refuses impossible lengths, most likely given in a wrong unit.
void check_length(const run::MuscleSetup& setup, double length) {
  const actuator::Actuator& a = setup.muscle.actuator;
  const double longest = a.caps.length + 1.5 * a.braid.thread_length;
  if (!(length > a.caps.length && length <= longest))
    throw std::invalid_argument(
        fmt::format("length: found {} m; expected above {:.4g} m (the caps alone), at most {:.4g} "
                    "m (one and a half threads)",
                    length, a.caps.length, longest));
}

Held make(const py::object& where, const std::string& name, const std::optional<double>& length,
          const std::optional<double>& pressure, const py::object& sets) {
  const std::string path = path_of(where);
  run::MuscleSetup setup = run::muscle_setup(path, name, sets_of(sets, path));
  if (!length && !(setup.length > 0))
    throw std::invalid_argument(fmt::format(
        "length: found none, and {} has none; expected the length at the start [m]", path));
  const double long_now = length.value_or(setup.length);
  const double pressed = pressure.value_or(setup.pressure);
  check_length(setup, long_now);
  if (!(pressed > 0 && pressed <= 1e7))
    throw std::invalid_argument(fmt::format(
        "pressure: found {} Pa; expected an absolute pressure above 0, at most 1e7 Pa", pressed));
  return std::make_shared<HeldMuscle>(path, std::move(setup), long_now, pressed);
}

// Returns a muscle with the same description and state.
Held copied(HeldMuscle& of) {
  const UseMuscle use(of);
  auto copy =
      std::make_shared<HeldMuscle>(of.path, of.setup, of.start_length, of.setup.air.atmosphere);
  UseMuscle(*copy)->restore(use->state());
  return copy;
}

py::bytes saved(HeldMuscle& m) {
  const std::vector<std::byte> bytes = run::save(*UseMuscle(m), m.setup);
  return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void restore(HeldMuscle& m, const py::bytes& given) {
  const auto bytes = static_cast<std::string_view>(given);
  run::restore(*UseMuscle(m), m.setup, std::as_bytes(std::span(bytes)));
}

py::tuple pickled(HeldMuscle& m) {
  return py::make_tuple(m.path, m.setup.text, m.setup.muscle.name, m.start_length, saved(m));
}

Held unpickled(const py::tuple& state) {
  const auto path = state[0].cast<std::string>();
  run::MuscleSetup setup =
      run::muscle_setup_of(state[1].cast<std::string>(), path, state[2].cast<std::string>());
  const double room = setup.air.atmosphere;
  auto made = std::make_shared<HeldMuscle>(path, std::move(setup), state[3].cast<double>(), room);
  restore(*made, state[4].cast<py::bytes>());
  return made;
}

// --- steps ---

void check_step(double step) {
  if (!(step > 0 && step <= longest_step))
    throw std::invalid_argument(
        fmt::format("step: found {} s; expected above 0, at most {} s", step, longest_step));
}

// Throws RunError if its state is not finite.
void refuse_failed(const air::DrivenMuscle& m) {
  if (m.failed())
    throw RunError(fmt::format(
        "muscle: its air is not finite at {:g} s, {:g} m long; expected lengths at which "
        "it has room for air, and that change by less than a step can follow",
        m.time(), m.length()));
}

void advance(HeldMuscle& m, double step, double length) {
  check_step(step);
  check_length(m.setup, length);
  const UseMuscle use(m);
  refuse_failed(*use);
  use->advance(step, length);
  refuse_failed(*use);
}

// Commands of a sequence of steps: a flag for each step, one for all, or none.
class Commands {
 public:
  Commands(const py::object& given, const char* name, py::ssize_t steps) {
    if (given.is_none()) return;
    flags_ = numbers(given, name);
    if (flags_->ndim() != 0) check_shape(*flags_, {static_cast<std::size_t>(steps)}, name);
    for (py::ssize_t k = 0; k < flags_->size(); ++k)
      if (flags_->data()[k] != 0 && flags_->data()[k] != 1)
        throw std::invalid_argument(fmt::format("{}: found {} in place {}; expected True or False",
                                                name, flags_->data()[k], k));
  }

  explicit operator bool() const { return flags_.has_value(); }
  bool at(py::ssize_t k) const { return flags_->data()[flags_->ndim() == 0 ? 0 : k] != 0; }

 private:
  std::optional<Numbers> flags_;
};

Numbers lengths_of(const HeldMuscle& m, const py::object& given) {
  Numbers lengths = numbers(given, "lengths");
  check_shape(lengths, {static_cast<std::size_t>(lengths.size())}, "lengths");
  for (py::ssize_t k = 0; k < lengths.size(); ++k) check_length(m.setup, lengths.data()[k]);
  return lengths;
}

py::tuple follow(HeldMuscle& m, double step, const py::object& given, const py::object& inlet,
                 const py::object& exhaust) {
  check_step(step);
  const Numbers lengths = lengths_of(m, given);
  const py::ssize_t steps = lengths.size();
  const Commands in(inlet, "inlet", steps), out(exhaust, "exhaust", steps);
  Numbers tension(steps), pressure(steps);
  double* const pulls = tension.mutable_data();
  double* const presses = pressure.mutable_data();
  const UseMuscle use(m);
  refuse_failed(*use);
  const auto at_once = static_cast<py::ssize_t>(std::ceil(std::fmin(slice / step, 1e4)));
  for (py::ssize_t k = 0; k < steps && !use->failed();) {
    {
      const py::gil_scoped_release others;
      for (const py::ssize_t until = std::min(steps, k + at_once); k < until; ++k) {
        if (in) use->inlet(in.at(k));
        if (out) use->exhaust(out.at(k));
        use->advance(step, lengths.data()[k]);
        pulls[k] = use->tension();
        presses[k] = use->pressure();
      }
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  refuse_failed(*use);
  return py::make_tuple(tension, pressure);
}

void set_point(HeldMuscle& m, double share) {
  if (!(share >= 0 && share <= 1))
    throw std::invalid_argument(
        fmt::format("share: found {}; expected 0 to 1 of the regulator's range", share));
  UseMuscle(m)->set_point(share);
}

py::dict account(HeldMuscle& m) {
  const air::Account a = UseMuscle(m)->account();
  py::dict out;
  out["mass"] = a.mass;
  out["in"] = a.in;
  out["out"] = a.out;
  out["leak"] = a.leak;
  return out;
}

// --- Python class ---

using Class = py::class_<HeldMuscle, Held>;

template <class Of>
void add_look(Class& c, const char* name, Of of, const char* doc) {
  c.def_property_readonly(
      name, [of](HeldMuscle& m) { return of(*UseMuscle(m)); }, doc);
}

void bind_looks(Class& c) {
  using Muscle = air::DrivenMuscle;
  c.def_property_readonly(
      "name", [](const HeldMuscle& m) { return m.setup.muscle.name; }, "Its name.");
  c.def_property_readonly(
      "atmosphere", [](const HeldMuscle& m) { return m.setup.air.atmosphere; },
      "Pressure of the room, absolute [Pa].");
  add_look(
      c, "tension", [](const Muscle& m) { return m.tension(); },
      "Force on both ends [N], static and viscous: a tendon, which never pushes.");
  add_look(
      c, "friction", [](const Muscle& m) { return m.friction(); },
      "Bound of the dry friction between bladder and mesh [N]. Whether the muscle sticks\n"
      "depends on your mechanism.");
  add_look(
      c, "pressure", [](const Muscle& m) { return m.pressure(); },
      "Pressure of its air, absolute [Pa].");
  add_look(
      c, "length", [](const Muscle& m) { return m.length(); }, "Where it stands [m].");
  add_look(
      c, "time", [](const Muscle& m) { return m.time(); }, "Since it was made [s].");
  add_look(
      c, "air_mass", [](const Muscle& m) { return m.air_mass(); },
      "Air in the muscle and its hose [kg].");
  c.def_property_readonly("account", &account,
                          "A dict of air [kg]: its \"mass\" in the muscle now, and what has passed "
                          "\"in\", \"out\" and by\n\"leak\" since the start.");
  add_look(
      c, "failed", [](const Muscle& m) { return m.failed(); },
      "Whether its air is not finite any more; then it does not move.");
}

void bind_motion(Class& c) {
  c.def(
       "inlet", [](HeldMuscle& m, bool on) { UseMuscle(m)->inlet(on); }, py::arg("on"),
       "Current of the inlet's coil from now on; also a 3-way valve's. Raises ValueError where a\n"
       "regulator is in its place.")
      .def(
          "exhaust", [](HeldMuscle& m, bool on) { UseMuscle(m)->exhaust(on); }, py::arg("on"),
          "Current of the exhaust's coil from now on. Raises ValueError if it has no exhaust "
          "valve.")
      .def("set_point", &set_point, py::arg("share"),
           "Sets a regulator in the inlet's place, from now on: 0 to 1 of its range. Raises\n"
           "ValueError where there are other valves.")
      .def("advance", &advance, py::arg("step"), py::arg("length"),
           "Lets `step` [s] pass, in which the muscle comes, straight, to be `length` [m] long.\n"
           "Raises ValueError for an impossible step or length, RunError if its air is not finite\n"
           "any more.")
      .def("follow", &follow, py::arg("step"), py::arg("lengths"), py::arg("inlet") = py::none(),
           py::arg("exhaust") = py::none(),
           "Advances once for each of `lengths` [m], by `step` [s], with a command before each:\n"
           "`inlet` and `exhaust` are arrays of flags, one flag for all, or None for no command.\n"
           "Returns arrays of tension [N] and absolute pressure [Pa] after each. Raises as\n"
           "advance() does.");
}

void bind_saves(Class& c) {
  bind_states(c, &saved, &restore, &copied, "another muscle");
  c.def(py::pickle(&pickled, &unpickled));
}

}  // namespace

void bind_muscle(py::module_& m) {
  Class c(m, "DrivenMuscle",
          "A muscle with its valves, hose, leak and supply, moved by a loop that is yours: your\n"
          "robot, simulator or controller. All in SI; pressures are absolute. The same bits as\n"
          "the class of C++.");
  c.def(
      py::init(&make), py::arg("path"), py::arg("name") = "", py::arg("length") = py::none(),
      py::arg("pressure") = py::none(), py::arg("sets") = py::none(),
      "Reads a muscle of a rig, robot or experiment file; `name` selects one if it has\n"
      "several; `sets` as for Experiment. `length` at the start [m]; None: the file's, a robot's\n"
      "mount length. `pressure` there, absolute [Pa]; None: the file's, or the room's. Raises\n"
      "InputError; ValueError for a length at which there is no room for air.");
  bind_looks(c);
  bind_motion(c);
  bind_saves(c);
  c.def("__repr__", [](HeldMuscle& held) {
    return fmt::format("<sinew.DrivenMuscle {} of {} at {:g} s>", held.setup.muscle.name, held.path,
                       UseMuscle(held)->time());
  });
}

}  // namespace sinew::python
