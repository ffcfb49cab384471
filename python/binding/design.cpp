// python/binding/design.cpp - design calculations like `sinew design`: settings in, a result out.
#include <fmt/format.h>

#include "python/binding/keywords.h"
#include "sinew/design/methods.h"
#include "sinew/host/side_by_side.h"
#include "sinew/report/page/page.h"

namespace sinew::python {

namespace {

// Calls `use` with the settings of the named calculation. Throws std::invalid_argument if it is
// unknown.
template <class Use>
void with_design(const std::string& name, const Use& use) {
  bool known = false;
  design::for_each_design([&](const auto& settings) {
    if (config::SettingList(settings).of.name != name) return;
    known = true;
    use(settings);
  });
  if (!known) throw std::invalid_argument(fmt::format("design: found no calculation \"{}\"", name));
}

// Returns the result of a calculation, found without Python's lock.
design::Result designed(const std::string& name, const py::dict& given) {
  design::Result out;
  with_design(name, [&](auto settings) {
    Keywords keywords(given);
    fields(keywords, settings);
    keywords.refuse_others();
    std::atomic<bool> stop = false;
    do_interruptibly(stop, [&] {
      const host::Stoppable stoppable(&stop);
      out = design::design(settings);
    });
  });
  return out;
}

// Returns the rows of a calculation's settings, see SettingList.
py::object design_settings(const std::string& name) {
  std::string rows;
  with_design(name,
              [&](const auto& settings) { rows = config::SettingList(settings).rows.text(); });
  return parsed(rows);
}

std::string page_of(const design::Result& result) {
  return design::page_of(result, units::atmosphere, SINEW_VERSION);
}

// Returns the file that the design makes, as it would be written at `out`.
std::string file_of(const design::Result& result, const std::string& out) {
  if (!result.file) throw std::invalid_argument("file: found a design that makes none");
  return result.file(out);
}

}  // namespace

void bind_design(py::module_& m) {
  py::class_<design::Result>(m, "Designed", "The result of a design calculation.")
      .def_property_readonly(
          "report", [](const design::Result& r) { return parsed(design::to_json(r).text()); },
          "The result, as `sinew design --json` prints it.")
      .def_property_readonly(
          "refused", [](const design::Result& r) { return r.refused; },
          "Why no design is possible; empty: there is one.")
      .def(
          "text", [](const design::Result& r) { return design::text_of(r); },
          "Returns the result as text, in SI.")
      .def("file", &file_of, py::arg("out"),
           "Returns the file that the design makes, as it would be written at `out`.")
      .def("page", &page_of, "Returns the page with tables and plots, as HTML.")
      .def(
          "cell",
          [](const design::Result& r) {
            return report::has_page() ? in_a_cell(page_of(r)) : py::object(py::none());
          },
          "Returns the page as HTML for a notebook; None without one.");
  m.def("design", &designed, py::arg("name"), py::arg("settings"));
  m.def("design_settings", &design_settings, py::arg("name"));
}

}  // namespace sinew::python
