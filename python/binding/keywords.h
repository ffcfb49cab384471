// python/binding/keywords.h - keywords of Python as the settings of a method or a design.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "python/binding/settings.h"
#include "sinew/identify/task/settings.h"

namespace sinew::python {

// Reads the settings of a method from Python keywords. A visitor of config/setting_rows.h.
class Keywords : public config::RowVisitor<Keywords> {
 public:
  using Row = config::Setting;
  explicit Keywords(const py::dict& given) : given_(given), left_(given.attr("copy")()) {}

  void row(const Row& row, std::string& out) {
    const char* keyword = name(row);
    if (row.kind == Kind::quantity) return given_.quantity(keyword, row.unit, out);
    if (row.kind == Kind::quantities) return given_.quantities(keyword, row.unit, out);
    if (row.kind == Kind::file) return given_.path(keyword, out);
    if (!row.is_at_commas) return given_.text(keyword, out);
    std::vector<std::string> all;
    given_.texts(keyword, row.unit, all);
    if (!all.empty()) out = fmt::format("{}", fmt::join(all, ","));
  }
  void row(const Row& row, double& out) { given_.number(name(row), out); }
  void row(const Row& row, int& out) { given_.integer(name(row), out); }
  void row(const Row& row, bool& out) { given_.flag(name(row), out); }
  void row(const Row& row, std::vector<std::string>& out) {
    given_.texts(name(row), row.unit, out);
  }
  void row(const Row& row, identify::HeldOut& out) {
    const py::object every = given_.at(name(row));
    if (every.is_none()) return;
    for (const py::handle one : every) {
      if (py::isinstance<py::dict>(one))
        out.tables.push_back(source_of(one));
      else
        out.texts.push_back(bytes_of(one));
    }
  }

  // Throws TypeError for an unknown keyword.
  void refuse_others() const {
    for (const auto& [key, value] : left_)
      throw py::type_error(
          fmt::format("{}: found no such setting", py::str(key).cast<std::string>()));
  }

 private:
  const char* name(const Row& row) {
    name_ = row.keyword;
    left_.attr("pop")(name_, py::none());
    return name_.c_str();
  }

  Settings given_;
  py::dict left_;
  std::string name_;
};

}  // namespace sinew::python
