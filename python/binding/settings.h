// python/binding/settings.h - conversion of Python's settings and tables for a method of
// identification.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "python/binding/bind.h"
#include "sinew/identify/data/measured.h"

namespace sinew::python {

// Settings by name. Each function leaves `out` unchanged if the setting is None or missing, and
// throws TypeError for a value of the wrong type.
class Settings {
 public:
  explicit Settings(const py::dict& given) : given_(given) {}

  // Converts a text with a unit, or a number in `unit`, to text: "0.3 SI" if the unit is empty.
  void quantity(const char* name, std::string_view unit, std::string& out) const;
  // Converts one value for all tables, or a list with one for each, to a text separated by commas.
  void quantities(const char* name, std::string_view unit, std::string& out) const;

  void text(const char* name, std::string& out) const;
  // Converts one value or a list; numbers are allowed only with a `unit`.
  void texts(const char* name, std::string_view unit, std::vector<std::string>& out) const;
  void path(const char* name, std::string& out) const;
  void integer(const char* name, int& out) const;
  void number(const char* name, double& out) const;
  void flag(const char* name, bool& out) const;

  // Returns the setting; None if it is missing.
  py::object at(const char* name) const;

 private:
  py::dict given_;
};

// Returns the source for a dict of `sinew._tables.parts_of()`: {path, text, names, …}.
identify::Source source_of(const py::handle& parts);

}  // namespace sinew::python
