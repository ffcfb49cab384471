// python/binding/experiment.cpp - experiments: reading, access by key, variation, pickling.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <set>

#include "python/binding/numbers.h"
#include "python/binding/values.h"
#include "sinew/config/compose.h"
#include "sinew/config/node.h"
#include "sinew/config/setting.h"
#include "sinew/config/shown_units.h"
#include "sinew/config/utf8.h"
#include "sinew/control/gait/change.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/files/keys.h"
#include "sinew/files/values.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/signals/tick.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::python {

namespace {

using experiment::Experiment;

// Returns a value as the text after "key=". A number is in the SI unit of the key.
std::string text_of(const std::string& key, const py::handle& value,
                    const config::Origins& origins) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (!PyNumber_Check(value.ptr()) || py::hasattr(value, "__len__"))
    throw py::type_error(
        fmt::format("{}: found {}; expected a number in SI, True or False, or text with a unit",
                    key, py::repr(value).cast<std::string>()));
  const auto number = py::reinterpret_borrow<py::object>(value);
  if (const std::string unit = si_unit_of(key, origins); !unit.empty())
    return units::format_quantity(py::float_(number).cast<double>(), unit);
  if (PyIndex_Check(value.ptr()) != 0) return py::str(number).cast<std::string>();
  return units::format_number(py::float_(number).cast<double>());
}

ExperimentPointer read(const std::string& path, std::vector<std::string> sets,
                       const std::string& text) {
  auto held = std::make_shared<HeldExperiment>(HeldExperiment{path, std::move(sets), text, {}});
  if (text.empty()) {
    held->read = run::buildable(path, held->sets);
  } else {
    config::Node root = config::parse_text(text, path);
    for (const std::string& set : held->sets) config::apply_set(root, set);
    held->read = run::buildable(root, path);
  }
  return held;
}

ExperimentPointer varied(const ExperimentPointer& of, const py::object& sets) {
  std::vector<std::string> all = of->sets;
  for (std::string& set :
       sets_of(sets, [&]() -> const config::Origins& { return of->read.origins; }))
    all.push_back(std::move(set));
  return read(of->path, std::move(all), of->text);
}

ExperimentPointer load(const py::object& path, const py::object& sets) {
  const std::string file = path_of(path);
  return read(file, sets_of(sets, file), "");
}

// Returns the origin of a key. Raises KeyError if the experiment does not have the key.
const config::Origin& origin_at(const HeldExperiment& held, const std::string& key) {
  if (const config::Origin* origin = config::find_origin(held.read.origins, key)) return *origin;
  std::vector<std::string_view> keys;
  for (const config::Origin& o : held.read.origins) keys.push_back(o.path);
  const std::string near = config::closest_in_quotes(key, keys);
  throw py::key_error(fmt::format("found {}; expected a key of the experiment{}",
                                  config::in_quotes(key), near.empty() ? "" : "; try " + near));
}

// Returns the value in SI; None if the key exists but is not set.
py::object in_si(const HeldExperiment& held, const std::string& key) {
  const config::Origin& origin = origin_at(held, key);
  const config::Node root = experiment::values_in_si({"experiment", held.read});
  const config::Node* node = config::value_at(root, key);
  if (!node || (node->is_table() && !node->is_value_table())) return py::none();
  return value_of(*node, !origin.unit.empty());
}

// Returns the experiment with another seed of noise, without reading its files again.
std::shared_ptr<HeldExperiment> with_seed(const HeldExperiment& of, int seed) {
  if (seed < 0)
    throw std::invalid_argument(fmt::format("seed: found {}; expected 0 to 2147483647", seed));
  auto out = std::make_shared<HeldExperiment>(of);
  out->read.seed = seed;
  out->sets.push_back(fmt::format("seed={}", seed));
  return out;
}

double converted(double value, const std::string& unit, const std::string& display) try {
  return units::convert(value, unit, display);
} catch (const std::exception& e) {
  throw std::invalid_argument(fmt::format("convert: {}; expected units of one kind", e.what()));
}

units::ShownUnits units_of(const std::string& units) {
  return config::units_to_show({.now = units}).units;
}

std::string shown(double value, const std::string& unit, const std::string& units, int digits) {
  if (digits < 1 || digits > 17)
    throw std::invalid_argument(fmt::format("digits: found {}; expected 1 to 17", digits));
  return units_of(units).text(value, unit, digits);
}

py::tuple in_units(const py::object& values, const std::string& unit, const std::string& units) {
  const units::ShownUnit to = units_of(units).of(unit);
  return py::make_tuple(
      py::vectorize([&to](double v) { return to.of(v); })(numbers(values, "values")), to.label());
}

std::vector<std::string> keys_of(const HeldExperiment& held) {
  std::vector<std::string> out;
  for (const config::Origin& o : held.read.origins) out.push_back(o.path);
  return out;
}

std::string resolved(const HeldExperiment& held) {
  return experiment::resolved(held.read, SINEW_VERSION);
}

}  // namespace

std::string si_unit_of(const std::string& key, const config::Origins& origins) {
  const config::Origin* origin = config::find_origin(origins, key);
  return origin ? origin->unit : files::unit_of(key);
}

std::vector<std::string> sets_of(const py::object& sets,
                                 const std::function<const config::Origins&()>& origins) {
  std::vector<std::string> out;
  if (sets.is_none()) return out;
  if (py::isinstance<py::dict>(sets)) {
    for (const auto& [name, value] : sets.cast<py::dict>()) {
      if (!py::isinstance<py::str>(name))
        throw py::type_error("settings: found a key that is no text");
      const auto key = name.cast<std::string>();
      out.push_back(fmt::format("{}={}", key, text_of(key, value, origins())));
    }
    return out;
  }
  if (py::isinstance<py::list>(sets) || py::isinstance<py::tuple>(sets)) {
    std::set<std::string> keys;
    for (const py::handle set : sets) {
      if (!py::isinstance<py::str>(set))
        throw py::type_error("settings: found a member that is no text; expected \"key=value\"");
      out.push_back(set.cast<std::string>());
      const std::string key(
          units::trimmed(std::string_view(out.back()).substr(0, out.back().find('='))));
      if (!keys.insert(key).second)
        throw std::invalid_argument(fmt::format(
            "settings: found {}, a second value of this key; expected one value for each key",
            config::in_quotes(out.back())));
    }
    return out;
  }
  throw py::type_error(fmt::format(
      "settings: found {}; expected a dict of keys and values, or a list of \"key=value\"",
      py::repr(sets).cast<std::string>()));
}

std::vector<std::string> sets_of(const py::object& sets, const std::string& path) {
  config::Origins read;
  return sets_of(sets, [&]() -> const config::Origins& {
    if (read.empty()) read = files::values(path).origins;
    return read;
  });
}

std::vector<std::string> sets_without_numbers(const py::object& sets) {
  return sets_of(sets, []() -> const config::Origins& {
    throw py::type_error("sets: found a number; expected a text with a unit, \"0.8 lbf in s/rad\"");
  });
}

py::object parsed(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

std::string path_or_none(const py::handle& meant) { return meant.is_none() ? "" : path_of(meant); }

std::vector<std::string> paths_of(const py::handle& meant) {
  if (!py::isinstance<py::list>(meant) && !py::isinstance<py::tuple>(meant))
    return {path_of(meant)};
  std::vector<std::string> out;
  for (const py::handle path : meant) out.push_back(path_of(path));
  return out;
}

std::string path_of(const py::handle& meant) {
  if (py::isinstance<py::str>(meant) || py::hasattr(meant, "__fspath__"))
    return bytes_of(py::module_::import("os").attr("fsdecode")(meant));
  throw py::type_error(fmt::format("found {}; expected a path, or an Experiment",
                                   py::repr(meant).cast<std::string>()));
}

std::string bytes_of(const py::handle& text) {
  return py::bytes(text.attr("encode")("utf-8", "surrogateescape"));
}

py::object path_text(const std::string& path) {
  return py::bytes(path).attr("decode")("utf-8", "surrogateescape");
}

ExperimentPointer experiment_of(const py::object& meant, const py::object& sets) {
  if (!py::isinstance<HeldExperiment>(meant)) return load(meant, sets);
  const auto held = meant.cast<ExperimentPointer>();
  return sets.is_none() ? held : varied(held, sets);
}

ExperimentPointer from_file(const py::object& meant, const py::object& sets) {
  ExperimentPointer e = experiment_of(meant, sets);
  if (!e->text.empty())
    throw std::invalid_argument(
        "experiment: found one that was pickled; expected one that was read from its file");
  return e;
}

void bind_experiment(py::module_& m) {
  py::class_<HeldExperiment, std::shared_ptr<HeldExperiment>>(
      m, "Experiment",
      "An experiment file with the robot that it names, read and checked; it does not change.")
      .def(
          py::init([](const py::object& path, const py::object& sets) { return load(path, sets); }),
          py::arg("path"), py::arg("sets") = py::none(),
          "Reads the file, with settings in place of its own: {\"control.stiffness.hip\": 3.0}.\n"
          "A number is in the key's SI unit, text has a unit of its own (\"35 lbf in/rad\").\n"
          "Raises InputError with everything that is wrong.")
      .def_property_readonly(
          "path", [](const HeldExperiment& e) { return path_text(e.path); }, "Its file.")
      .def_property_readonly(
          "name", [](const HeldExperiment& e) { return e.read.name; },
          "The file's name without its ending.")
      .def_property_readonly(
          "title", [](const HeldExperiment& e) { return e.read.title; },
          "What it is, in a sentence.")
      .def_property_readonly(
          "sets", [](const HeldExperiment& e) { return e.sets; },
          "Settings in place of the file's, as \"key=value\".")
      .def_property_readonly(
          "seed", [](const HeldExperiment& e) { return e.read.seed; },
          "Of the noise of the sensors.")
      .def_property_readonly(
          "duration",
          [](const HeldExperiment& e) {
            return static_cast<double>(experiment::last_tick(e.read)) * signals::tick_seconds;
          },
          "Of its plan, in seconds.")
      .def_property_readonly(
          "warnings",
          [](const HeldExperiment& e) {
            std::vector<std::string> out;
            for (const config::Problem& p : e.read.warnings) out.push_back(config::to_text(p));
            return out;
          },
          "What is doubtful about it, a sentence each.")
      .def(
          "vary",
          [](const std::shared_ptr<HeldExperiment>& e, const py::object& sets) {
            return varied(e, sets);
          },
          py::arg("sets"), "Returns the experiment with these settings besides.")
      .def("with_seed", &with_seed, py::arg("seed"),
           "Returns the experiment with other noise of its sensors. Raises ValueError.")
      .def("__contains__",
           [](const HeldExperiment& e, const std::string& key) {
             return config::find_origin(e.read.origins, key) != nullptr;
           })
      .def("__iter__", [](const HeldExperiment& e) { return py::iter(py::cast(keys_of(e))); })
      .def("__len__", [](const HeldExperiment& e) { return e.read.origins.size(); })
      .def("keys", &keys_of, "Returns the keys of all values, dotted.")
      .def("__getitem__", &in_si, py::arg("key"),
           "Returns the value of a key in SI. Raises KeyError.")
      .def(
          "to_dict",
          [](const HeldExperiment& e) {
            return values_of(experiment::values_in_si({"experiment", e.read}), e.read.origins);
          },
          "Returns all values by their keys, in SI.")
      .def(
          "origin",
          [](const HeldExperiment& e, const std::string& key) {
            return origin_of(origin_at(e, key));
          },
          py::arg("key"),
          "Returns where a value came from: text as written, SI unit, source, file and line,\n"
          "range, uncertainty. Raises KeyError.")
      .def("resolved", &resolved,
           "Returns a file with every value in SI and its source, which runs again.")
      .def("__repr__",
           [](const HeldExperiment& e) {
             return fmt::format("<sinew.Experiment {}>", config::printable(e.path));
           })
      .def("__copy__", [](const std::shared_ptr<HeldExperiment>& e) { return e; })
      .def(
          "__deepcopy__",
          [](const std::shared_ptr<HeldExperiment>& e, const py::dict&) { return e; },
          py::arg("memo"))
      .def(py::pickle([](const HeldExperiment& e) { return py::make_tuple(e.path, resolved(e)); },
                      [](const py::tuple& state) {
                        return read(state[0].cast<std::string>(), {}, state[1].cast<std::string>());
                      }));
  m.def(
      "quantity",
      [](const std::string& text, const std::string& unit) { return config::quantity(text, unit); },
      py::arg("text"), py::arg("unit"),
      "Returns a quantity in the SI unit: quantity(\"60 psi gauge\", \"Pa abs\"). Raises\n"
      "InputError.");
  m.def("convert", &converted, py::arg("value"), py::arg("unit"), py::arg("display"),
        "Returns a value of an SI unit in another: convert(0.0254, \"m\", \"in\"). Raises\n"
        "ValueError.");
  m.def("shown", &shown, py::arg("value"), py::arg("unit"), py::arg("units") = "",
        py::arg("digits") = 4,
        "Returns a value of an SI unit as people see it: shown(0.08, \"m\", \"metric\") is \"80 "
        "mm\".\n"
        "`units` is si, thesis, metric, or a choice on top of one, \"metric,length=cm\"; without "
        "it,\n"
        "SINEW_UNITS or your settings, else si. Pressures in \"Pa\" are absolute ones, and\n"
        "gauges count from 14.7 psi. Raises InputError.");
  m.def("in_units", &in_units, py::arg("values"), py::arg("unit"), py::arg("units") = "",
        "Returns numbers of an SI unit in that of such units, and what it is called, for an axis:\n"
        "ys, label = in_units(pressure, \"Pa\", \"metric\"). Raises InputError.");
}

}  // namespace sinew::python
