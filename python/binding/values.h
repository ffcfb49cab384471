// python/binding/values.h - conversion of file values and their origins to Python objects.
#pragma once

#include "python/binding/bind.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"

namespace sinew::python {

// Returns a value as a Python object. A `quantity` becomes a number in SI; the tree has it as text,
// "5.24 rad".
py::object value_of(const config::Node& node, bool quantity);

// Returns the values of a tree in SI, keyed by path; unset values are left out.
py::dict values_of(const config::Node& in_si, const config::Origins& origins);

// Returns a dict with text as written, unit, source, file, line, whether it is a default, a fit or
// a guess, range and uncertainty.
py::dict origin_of(const config::Origin& origin);

}  // namespace sinew::python
