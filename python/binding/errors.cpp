// python/binding/errors.cpp - conversion of the library's errors to Python exceptions with the same
// messages.
#include <pybind11/stl.h>

#include <filesystem>

#include "python/binding/bind.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/utf8.h"
#include "sinew/log/file.h"
#include "sinew/port/comedi/comedi_port.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::python {

namespace {

// Raises `type` with the message, and with the problems as its attribute.
void raise_input_error(const py::handle& type, const config::Error& error) {
  py::object exception = py::reinterpret_borrow<py::object>(type)(error.what());
  exception.attr("problems") = py::cast(error.problems());
  PyErr_SetObject(type.ptr(), exception.ptr());
}

// Raises `type` with the message, which may contain a file name that is not UTF-8.
void raise(const py::handle& type, const std::exception& error) {
  PyErr_SetString(type.ptr(), config::printable(error.what()).c_str());
}

}  // namespace

py::handle new_exception(py::module_& m, const char* name, const char* doc,
                         const py::handle& base) {
  const std::string full = std::string("sinew.") + name;
  py::object type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(full.c_str(), doc, base.ptr(), nullptr));
  if (!type) throw py::error_already_set();
  m.attr(name) = type;
  return type.release();  // lives as long as the interpreter
}

void bind_errors(py::module_& m) {
  py::class_<config::Problem>(m, "Problem", "One thing that is wrong with a file or a setting.")
      .def_property_readonly(
          "file", [](const config::Problem& p) { return path_text(p.where.file); },
          "The file; may be empty.")
      .def_property_readonly(
          "line", [](const config::Problem& p) { return p.where.line; },
          "The line, from 1 on; 0 where the place has no lines.")
      .def_property_readonly(
          "column", [](const config::Problem& p) { return p.where.column; },
          "The column, from 1 on; 0 where the place has none.")
      .def_readonly("key", &config::Problem::key, "The key, dotted; may be empty.")
      .def_readonly("found", &config::Problem::found, "What was found.")
      .def_readonly("expected", &config::Problem::expected, "What is expected.")
      .def_readonly("try_this", &config::Problem::try_this, "What to do; may be empty.")
      .def("__str__", [](const config::Problem& p) { return config::to_text(p); })
      .def("__repr__",
           [](const config::Problem& p) { return "<sinew.Problem " + config::to_text(p) + ">"; });

  static const py::handle input = new_exception(
      m, "InputError", "A file or a setting is wrong. `problems` has each thing that is.",
      PyExc_ValueError);
  static const py::handle log =
      new_exception(m, "LogError", "A log cannot be read or written.", PyExc_OSError);
  static const py::handle run = new_exception(
      m, "RunError",
      "A run ended before its plan did; the text states the reason, and the last state.",
      PyExc_RuntimeError);
  static const py::handle board = new_exception(
      m, "BoardError", "A board, or a card, is not there, or not as it should be.", PyExc_OSError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const config::Error& e) {
      raise_input_error(input, e);
    } catch (const log::Error& e) {
      raise(log, e);
    } catch (const RunError& e) {
      raise(run, e);
    } catch (const plant::BoardError& e) {
      raise(board, e);
    } catch (const plant::CardError& e) {
      raise(board, e);
    } catch (const std::filesystem::filesystem_error& e) {
      raise(PyExc_OSError, e);
    }
  });
}

}  // namespace sinew::python
