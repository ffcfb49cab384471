// python/binding/numbers.h - arrays of numbers as arguments.
#pragma once

#include <pybind11/numpy.h>

#include <initializer_list>
#include <stdexcept>
#include <string>

#include "python/binding/bind.h"

namespace sinew::python {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Returns the argument `name` as an array: a number, lists of numbers, or arrays of any real type.
// Throws TypeError for text, complex numbers, and objects that are not arrays.
Numbers numbers(const py::handle& given, const char* name);

// Throws std::invalid_argument for an array of another shape.
void check_shape(const py::array& numbers, std::initializer_list<std::size_t> shape,
                 const char* name);

// Returns `law` of each pair of numbers, broadcast as in numpy; a number if both are numbers.
// Throws std::invalid_argument for shapes that cannot be broadcast.
template <class Law>
py::object over(const Numbers& a, const Numbers& b, Law law) try {
  return py::vectorize(law)(a, b);
} catch (const std::runtime_error&) {  // pybind11's, for the shapes
  throw std::invalid_argument(
      "arrays: found shapes " + py::str(a.attr("shape")).cast<std::string>() + " and " +
      py::str(b.attr("shape")).cast<std::string>() + "; expected shapes that can be broadcast");
}

}  // namespace sinew::python
