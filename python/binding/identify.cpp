// python/binding/identify.cpp - identification from measurements in Python arrays.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "python/binding/numbers.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/check/check.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/data/quality.h"
#include "sinew/json/json.h"

namespace sinew::python {

namespace {

// Returns the numbers of an argument: one per point, or one for all.
std::vector<double> each(const py::object& given, const char* name, py::ssize_t points) {
  const Numbers all = numbers(given, name);
  if (all.size() != 1 && (all.ndim() != 1 || all.size() != points))
    throw std::invalid_argument(
        fmt::format("{}: found an array of shape {}; expected {} numbers, or one", name,
                    py::str(all.attr("shape")).cast<std::string>(), points));
  for (py::ssize_t i = 0; i < all.size(); ++i)
    if (!std::isfinite(all.data()[i]))
      throw std::invalid_argument(
          fmt::format("{}: found {} in place {}; expected finite numbers", name, all.data()[i], i));
  if (all.size() == 1) return std::vector<double>(static_cast<std::size_t>(points), all.data()[0]);
  return {all.data(), all.data() + all.size()};
}

identify::HoldOut hold_out_of(const std::string& word) {
  if (word.empty()) return identify::HoldOut::none;
  if (word == "pressure") return identify::HoldOut::pressure;
  if (word == "length") return identify::HoldOut::length;
  if (word == "muscle") return identify::HoldOut::muscle;
  throw std::invalid_argument(fmt::format(
      "hold_out: found \"{}\"; expected \"pressure\", \"length\", \"muscle\" or \"\"", word));
}

// Returns the input that a table with these columns would give.
identify::CheckInput input_of(const py::object& length, const py::object& pressure,
                              const py::object& force, const py::object& rest_length,
                              const py::object& fitted, double diameter,
                              const std::string& source) {
  const py::ssize_t points = numbers(force, "force").size();
  identify::Measured table{.file = source};
  table.columns = {{"force", "N", each(force, "force", points)},
                   {"pressure", "Pa gauge", each(pressure, "pressure", points)},
                   {"length", "m", each(length, "length", points)}};
  if (!rest_length.is_none())
    table.columns.push_back({"rest_length", "m", each(rest_length, "rest_length", points)});
  for (const identify::ColumnSpec& spec : identify::static_columns())
    for (const identify::Column& column : table.columns)
      if (column.name == spec.name && column.name.ends_with("length"))
        for (const double x : column.values)
          if (!(x >= spec.least && x <= spec.most))
            throw std::invalid_argument(fmt::format("{}: found {} m; expected {} to {} m",
                                                    column.name, x, spec.least, spec.most));
  for (int row = 1; row <= points; ++row) table.lines.push_back(row);
  std::vector<bool> is_fitted;
  for (const double x : each(fitted, "fitted", points)) is_fitted.push_back(x != 0);
  table = identify::each_row_once(std::move(table), &is_fitted);
  identify::CheckInput out{.diameter = diameter};
  out.add({identify::settings_averaged(std::move(table), "force", &is_fitted), {}});
  std::vector<identify::StaticPoint>& all = out.data.points;
  for (std::size_t i = 0; i < all.size(); ++i) all[i].fitted = is_fitted[i];
  return out;
}

// Returns the report like `sinew identify static --json`, and the parameter file of each muscle.
py::tuple identify_static(const py::object& length, const py::object& pressure,
                          const py::object& force, const py::object& rest_length,
                          const py::object& fitted, const std::string& model,
                          const std::string& hold_out, const std::string& name,
                          const std::string& source, std::optional<double> diameter, bool anyway) {
  if (diameter && !(*diameter > 0 && *diameter < 1))
    throw std::invalid_argument(
        fmt::format("diameter: found {}; expected one of a muscle [m]", *diameter));
  identify::CheckInput input =
      input_of(length, pressure, force, rest_length, fitted, diameter.value_or(0), source);
  identify::StaticOptions options{
      .diameter = input.diameter, .model = model, .hold_out = hold_out_of(hold_out)};
  options.subject = "static law from " + source;
  std::optional<identify::StaticResult> found;
  std::atomic<bool> stop = false;
  do_interruptibly(stop, [&] {
    const host::Stoppable stoppable(&stop);
    identify::apply_checks(identify::check_static(input), anyway, input.data.warnings);
    found = identify::identify_static(input.data, options);
  });
  py::list files;
  for (std::size_t i = 0; i < found->muscles.size(); ++i)
    files.append(identify::static_file(*found, found->muscles[i], name, source, ""));
  Json report = identify::to_json(found->report);
  report["air_at_rest"] = identify::to_json(found->air);
  return py::make_tuple(parsed(report.text()), files);
}

}  // namespace

void bind_identify(py::module_& m) {
  static const py::handle refusal = new_exception(
      m, "RefusalError", "The data cannot support the requested model; the text states the reason.",
      PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const identify::Refusal& e) {
      PyErr_SetString(refusal.ptr(), e.what());
    }
  });
  m.def("identify_static", &identify_static, py::arg("length"), py::arg("pressure"),
        py::arg("force"), py::arg("rest_length"), py::arg("fitted"), py::arg("model"),
        py::arg("hold_out"), py::arg("name"), py::arg("source"), py::arg("diameter"),
        py::arg("anyway"));
}

}  // namespace sinew::python
