// python/binding/values.h - values of files as Python has them, and where they came from.
#pragma once

#include "python/binding/bind.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"

namespace sinew::python {

// Returns a value as Python has it. A `quantity` is a number in SI, which the tree has as text,
// "5.24 rad".
py::object value_of(const config::Node& node, bool quantity);

// Returns the values of a tree in SI by their keys; those that are not set are left out.
py::dict values_of(const config::Node& in_si, const config::Origins& origins);

// Returns text as written, unit, source, file, line, whether it is a default, a fit or a guess,
// range and uncertainty.
py::dict origin_of(const config::Origin& origin);

}  // namespace sinew::python
