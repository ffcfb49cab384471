// python/binding/laws.cpp - actuator and valve as functions of arrays.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>

#include "python/binding/numbers.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/actuator/tension.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/valve_flow.h"
#include "sinew/run/setup/actuator_text.h"

namespace sinew::python {

namespace {

using Path = const py::object&;

// Actuator and its surroundings, in SI; pressures are gauge pressures.
struct HeldActuator {
  actuator::Actuator law;
  actuator::Surroundings around;
};

HeldActuator read_actuator(Path where, const std::string& name, double external_volume) {
  const std::string path = path_of(where);
  const auto file = experiment::load_machine_file(path);
  const gas::Air& air = file.experiment.air;
  if (!(external_volume >= 0 && external_volume <= 1))
    throw std::invalid_argument(
        fmt::format("external_volume: found {}; expected 0 to 1 m3", external_volume));
  return {config::named(file.experiment.actuators, name, path, "actuator"),
          {air.atmosphere, air.polytropic_exponent, external_volume}};
}

// Throws std::invalid_argument for a length, pressure or velocity outside the law's range.
void check_point(const HeldActuator& a, double length, double pressure) {
  const double shortest = a.law.caps.length, longest = shortest + 1.5 * a.law.braid.thread_length;
  if (!(length >= shortest && length <= longest))
    throw std::invalid_argument(fmt::format(
        "length: found {} m; expected {:.4g} m (the caps alone) to {:.4g} m (one and a half "
        "threads)",
        length, shortest, longest));
  if (!(pressure >= -a.around.atmosphere && pressure <= 1e7))
    throw std::invalid_argument(
        fmt::format("pressure: found {} Pa; expected a gauge pressure of {:.6g} Pa (vacuum) to 1e7 "
                    "Pa",
                    pressure, -a.around.atmosphere));
}

actuator::OperatingPoint point_at(const HeldActuator& a, double length, double pressure,
                                  double velocity) {
  check_point(a, length, pressure);
  return actuator::operating_point(a.law, length, pressure, a.around, velocity);
}

// Returns a number for each operating point.
template <class Of>
py::object at_points(const HeldActuator& a, const py::object& length, const py::object& pressure,
                     Of of) {
  return over(numbers(length, "length"), numbers(pressure, "pressure"),
              [&a, of](double l, double p) {
                return of(point_at(a, l, p, actuator::OperatingPoint::not_given));
              });
}

py::object clamped_tension(const HeldActuator& a, const py::object& length,
                           const py::object& pressure) {
  return over(numbers(length, "length"), numbers(pressure, "pressure"), [&a](double l, double p) {
    check_point(a, l, p);
    return actuator::clamped_tension(a.law, l, 0, p, a.around.atmosphere);
  });
}

py::object tension(const HeldActuator& a, const py::object& length, const py::object& pressure,
                   const py::object& velocity) {
  if (velocity.is_none())
    return at_points(a, length, pressure, [](const auto& point) { return point.tension; });
  const py::tuple all = py::module_::import("numpy").attr("broadcast_arrays")(
      numbers(length, "length"), numbers(pressure, "pressure"), numbers(velocity, "velocity"));
  return py::vectorize([&a](double l, double p, double v) {
    if (!(v >= -100 && v <= 100))
      throw std::invalid_argument(
          fmt::format("velocity: found {} m/s; expected -100 to 100 m/s", v));
    return point_at(a, l, p, v).sliding_tension;
  })(Numbers(all[0]), Numbers(all[1]), Numbers(all[2]));
}

void bind_actuator(py::module_& m) {
  using Point = actuator::OperatingPoint;
  py::class_<HeldActuator> c(
      m, "Actuator",
      "A braided actuator's laws at rest and in motion. All in SI; pressures "
      "are gauge\npressures. Numbers and arrays alike, which are broadcast.");
  c.def(py::init(&read_actuator), py::arg("path"), py::arg("name") = "",
        py::arg("external_volume") = 0.0,
        "Reads an actuator, robot or experiment file; `name` selects one of several.\n"
        "`external_volume` [m3] of hose and fittings counts for the sealed stiffness. Raises\n"
        "InputError.")
      .def_property_readonly(
          "name", [](const HeldActuator& a) { return a.law.name; }, "Its name.")
      .def_property_readonly(
          "atmosphere", [](const HeldActuator& a) { return a.around.atmosphere; },
          "The pressure that gauge pressures are above, absolute [Pa].")
      .def_property_readonly(
          "shortest_length", [](const HeldActuator& a) { return actuator::shortest_length(a.law); },
          "At which it pulls no more, b/sqrt(3) of a plain braid [m].")
      .def_property_readonly(
          "greatest_length", [](const HeldActuator& a) { return a.law.long_end.length; },
          "Beyond which the threads themselves stretch [m].")
      .def(
          "tension", &tension, py::arg("length"), py::arg("pressure"),
          py::arg("velocity") = py::none(),
          "Returns the tension [N] at a length [m] and a gauge pressure [Pa], never below 0, as a\n"
          "muscle cannot push: at rest and without losses, [31]; with a velocity of the length\n"
          "[m/s], below 0 while it contracts, with its losses, [33]. Raises ValueError outside\n"
          "what a braid can be.")
      .def(
          "clamped_tension", &clamped_tension, py::arg("length"), py::arg("pressure"),
          "Returns the force [N] of an actuator clamped at both ends, at rest and without losses,\n"
          "[31]: below 0 where it pushes, as it does below its shortest length.")
      .def(
          "volume",
          [](const HeldActuator& a, const py::object& l, const py::object& p) {
            return at_points(a, l, p, [](const Point& point) { return point.volume; });
          },
          py::arg("length"), py::arg("pressure"), "Returns the volume of its air [m3], [4].")
      .def(
          "stiffness",
          [](const HeldActuator& a, const py::object& l, const py::object& p) {
            return at_points(
                a, l, p, [](const Point& point) { return point.stiffness_at_constant_pressure; });
          },
          py::arg("length"), py::arg("pressure"),
          "Returns the stiffness at constant pressure [N/m], [26].")
      .def(
          "sealed_stiffness",
          [](const HeldActuator& a, const py::object& l, const py::object& p) {
            return at_points(a, l, p, [](const Point& point) { return point.stiffness_sealed; });
          },
          py::arg("length"), py::arg("pressure"),
          "Returns the stiffness with the air shut in [N/m].")
      .def(
          "point",
          [](const HeldActuator& a, double length, double pressure, double velocity) {
            return parsed(run::json_of(point_at(a, length, pressure, velocity)));
          },
          py::arg("length"), py::arg("pressure"), py::arg("velocity") = Point::not_given,
          "Returns the values of all laws at one point, by names that end with the unit.");
}

struct HeldValve {
  gas::Valve law;
  gas::Air air;
};

HeldValve read_valve(Path where, const std::string& name) {
  const std::string path = path_of(where);
  const auto file = experiment::load_machine_file(path);
  return {config::named(file.experiment.valves, name, path, "valve"), file.experiment.air};
}

gas::ValveFlow flow_at(const HeldValve& v, double upstream, double downstream) {
  for (const auto& [name, value] : {std::pair{"upstream", upstream}, {"downstream", downstream}})
    if (!(value >= 0 && value <= 1e7))
      throw std::invalid_argument(fmt::format(
          "{}: found {} Pa; expected an absolute pressure of 0 to 1e7 Pa", name, value));
  return gas::flow_through(v.law.flow, v.air, upstream, downstream);
}

template <class Of>
py::object at_pressures(const HeldValve& v, const py::object& up, const py::object& down, Of of) {
  return over(numbers(up, "upstream"), numbers(down, "downstream"),
              [&v, of](double u, double d) { return of(flow_at(v, u, d)); });
}

void bind_valve(py::module_& m) {
  py::class_<HeldValve> c(m, "Valve",
                          "An open valve's flow. All in SI; pressures are absolute. Numbers and "
                          "arrays alike.");
  c.def(py::init(&read_valve), py::arg("path"), py::arg("name") = "",
        "Reads a valves, robot or experiment file; `name` selects one of several. Raises "
        "InputError.")
      .def_property_readonly(
          "name", [](const HeldValve& v) { return v.law.name; }, "Its name.")
      .def(
          "mass_flow",
          [](const HeldValve& v, const py::object& up, const py::object& down) {
            return at_pressures(v, up, down, [](const gas::ValveFlow& f) { return f.mass_flow; });
          },
          py::arg("upstream"), py::arg("downstream"),
          "Returns the flow [kg/s] from `upstream` to `downstream` [Pa abs], [44]. Raises\n"
          "ValueError for what is no pressure.")
      .def(
          "choked",
          [](const HeldValve& v, const py::object& up, const py::object& down) {
            return at_pressures(v, up, down, [](const gas::ValveFlow& f) { return f.choked(); });
          },
          py::arg("upstream"), py::arg("downstream"),
          "Returns whether the flow is at the speed of sound.");
}

}  // namespace

void bind_laws(py::module_& m) {
  bind_actuator(m);
  bind_valve(m);
}

}  // namespace sinew::python
