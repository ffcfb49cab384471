#include "python/binding/settings.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "sinew/identify/task/settings.h"
#include "sinew/recording/recorded.h"
#include "sinew/units/quantity.h"

namespace sinew::python {

namespace {

[[noreturn]] void refuse(const char* name, const py::handle& found, const std::string& expected) {
  auto shown = py::repr(found).cast<std::string>();
  if (shown.size() > 60) shown = shown.substr(0, 60) + " …";
  throw py::type_error(fmt::format("{}: found {}; expected {}", name, shown, expected));
}

bool is_text(const py::handle& value) { return py::isinstance<py::str>(value); }

// Returns whether it is a single number, including numpy's; arrays and texts are not.
bool is_plain_number(const py::handle& value) {
  return !py::isinstance<py::bool_>(value) && !is_text(value) && !py::hasattr(value, "__len__") &&
         PyNumber_Check(value.ptr()) != 0 && PyComplex_Check(value.ptr()) == 0;
}

std::string quantity_text(const char* name, const py::handle& value, std::string_view unit) {
  if (is_text(value)) return value.cast<std::string>();
  if (!is_plain_number(value))
    refuse(name, value, fmt::format("a number [{}], or text with a unit", unit));
  const double number = py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>();
  if (unit.empty()) return units::format_number(number) + " SI";
  return unit == "1" ? units::format_number(number) : units::format_quantity(number, unit);
}

}  // namespace

py::object Settings::at(const char* name) const {
  return given_.contains(name) ? py::object(given_[name]) : py::object(py::none());
}

void Settings::quantity(const char* name, std::string_view unit, std::string& out) const {
  if (const py::object value = at(name); !value.is_none()) out = quantity_text(name, value, unit);
}

void Settings::quantities(const char* name, std::string_view unit, std::string& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  if (is_text(value) || !py::hasattr(value, "__iter__")) return quantity(name, unit, out);
  std::string all;
  for (const py::handle one : value) {
    if (!all.empty()) all += ",";
    all += quantity_text(name, one, unit);
  }
  out = all;
}

void Settings::text(const char* name, std::string& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  if (!is_text(value)) refuse(name, value, "text");
  out = bytes_of(value);
}

void Settings::texts(const char* name, std::string_view unit, std::vector<std::string>& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  const auto text = [&](const py::handle& one) {
    if (!is_text(one) && unit.empty()) refuse(name, one, "text");
    return is_text(one) ? bytes_of(one) : quantity_text(name, one, unit);
  };
  out.clear();
  if (is_text(value) || !py::hasattr(value, "__iter__"))
    out.push_back(text(value));
  else
    for (const py::handle one : value) out.push_back(text(one));
}

void Settings::path(const char* name, std::string& out) const {
  if (const py::object value = at(name); !value.is_none()) out = path_of(value);
}

void Settings::integer(const char* name, int& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  if (py::isinstance<py::bool_>(value) || PyIndex_Check(value.ptr()) == 0)
    refuse(name, value, "a whole number");
  const py::ssize_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);  // huge: clamped
  out = static_cast<int>(std::clamp<py::ssize_t>(number, -1'000'000'000, 1'000'000'000));
}

void Settings::number(const char* name, double& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  if (!is_plain_number(value)) refuse(name, value, "a number");
  out = py::float_(value).cast<double>();
}

void Settings::flag(const char* name, bool& out) const {
  const py::object value = at(name);
  if (value.is_none()) return;
  if (!py::isinstance<py::bool_>(value)) refuse(name, value, "True or False");
  out = value.cast<bool>();
}

identify::Source source_of(const py::handle& parts) {
  const auto given = py::reinterpret_borrow<py::dict>(parts);
  const Settings settings(given);
  identify::Source out;
  settings.text("path", out.path);
  if (const py::object text = given["text"]; !text.is_none()) out.text = bytes_of(text);
  settings.texts("columns", "", out.columns);
  std::map<std::string, std::string> values;
  for (const auto& [name, to] : {std::pair{"names", &out.names},
                                 {"units", &out.units},
                                 {"where", &out.where},
                                 {"offsets", &out.offsets},
                                 {"values", &values}}) {
    const py::object pairs = given[name];
    if (pairs.is_none()) continue;
    if (!py::isinstance<py::dict>(pairs)) refuse(name, pairs, "a dict of texts");
    for (const auto& [key, value] : pairs.cast<py::dict>()) {
      if (!is_text(key) || !is_text(value)) refuse(name, pairs, "a dict of texts");
      const std::string column = bytes_of(key);
      if (to == &values && column.find(':') != column.npos)
        refuse(name, key, "the name of a column, without a colon");
      (*to)[column] = bytes_of(value);
    }
  }
  for (const auto& [column, value] : values) out.values.push_back(column + "=" + value);
  recording::check_stated(out.values, {out.path});
  settings.flag("drop_incomplete", out.drop_incomplete);
  for (const auto& [name, to] : {std::pair{"encoding", &out.encoding},
                                 {"decimal", &out.decimal},
                                 {"thousands", &out.thousands},
                                 {"dates", &out.dates},
                                 {"rate", &out.rate}})
    settings.text(name, *to);
  settings.flag("spread_times", out.spread_times);
  settings.integer("part", out.part);
  std::string atmosphere;
  settings.quantity("atmosphere", "Pa", atmosphere);
  if (!atmosphere.empty()) out.atmosphere = identify::atmosphere_setting(atmosphere);
  return out;
}

}  // namespace sinew::python
