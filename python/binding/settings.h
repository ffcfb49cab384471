// python/binding/settings.h - what Python says of a method of identification: its settings and the
// tables that it is asked about.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "python/binding/bind.h"
#include "sinew/identify/data/measured.h"

namespace sinew::python {

// Settings by their names. Each of its functions leaves `out` as it is where the setting is None,
// or not there, and throws TypeError for what is no such setting.
class Settings {
 public:
  explicit Settings(const py::dict& given) : given_(given) {}

  // A text with a unit, or a number in `unit`, as a text: "0.3 SI" where the unit is empty.
  void quantity(const char* name, std::string_view unit, std::string& out) const;
  // One for all tables, or a list with one for each: with commas between.
  void quantities(const char* name, std::string_view unit, std::string& out) const;

  void text(const char* name, std::string& out) const;
  // One, or a list of them; numbers only where they have a `unit`.
  void texts(const char* name, std::string_view unit, std::vector<std::string>& out) const;
  void path(const char* name, std::string& out) const;
  void integer(const char* name, int& out) const;
  void number(const char* name, double& out) const;
  void flag(const char* name, bool& out) const;

  // Returns the setting; None where it is not there.
  py::object at(const char* name) const;

 private:
  py::dict given_;
};

// Returns a table of `sinew.identify.Table`'s parts: {path, text, names, …}.
identify::Source source_of(const py::handle& parts);

}  // namespace sinew::python
