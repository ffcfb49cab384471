#include "python/binding/values.h"

#include "sinew/config/node.h"
#include "sinew/files/values.h"
#include "sinew/units/quantity.h"

namespace sinew::python {

py::object value_of(const config::Node& node, bool quantity) {
  using Kind = config::Node::Kind;
  switch (node.kind) {
    case Kind::table:
      return value_of(*node.find("value"), quantity);
    case Kind::array: {
      py::list out;
      for (const config::Node& child : node.children) out.append(value_of(child, quantity));
      return out;
    }
    case Kind::text: {
      const units::NumberAndUnit read = units::split_number(node.text);
      if (quantity && read.error == std::errc()) return py::float_(read.number);
      return py::str(node.text);
    }
    case Kind::integer:
      return quantity ? py::object(py::float_(static_cast<double>(node.integer)))
                      : py::object(py::int_(node.integer));
    case Kind::real:
      return py::float_(node.real);
    case Kind::flag:
      return py::bool_(node.flag);
  }
  return py::none();
}

py::dict values_of(const config::Node& in_si, const config::Origins& origins) {
  py::dict out;
  for (const config::Origin& origin : origins) {
    const config::Node* node = config::value_at(in_si, origin.path);
    if (node && (!node->is_table() || node->is_value_table()))
      out[py::str(origin.path)] = value_of(*node, !origin.unit.empty());
  }
  return out;
}

py::dict origin_of(const config::Origin& origin) {
  py::dict out;
  out["text"] = origin.text;
  out["unit"] = origin.unit;
  out["source"] = origin.source;
  out["file"] = path_text(origin.where.file);
  out["line"] = origin.where.line;
  out["default"] = origin.is_default;
  out["fit"] = origin.fit;
  out["guess"] = origin.guess;
  out["uncertainty"] = origin.uncertainty;
  out["range"] = origin.range_si
                     ? py::object(py::make_tuple((*origin.range_si)[0], (*origin.range_si)[1]))
                     : py::object(py::none());
  return out;
}

namespace {

// Returns the values and origins of an experiment, rig, robot, actuator, valves or wiring file.
py::tuple read_values(const py::object& path, const py::object& sets) {
  const std::string file = path_of(path);
  const files::Values values = files::values(file, sets_of(sets, file));
  py::dict from;
  for (const config::Origin& origin : values.origins)
    from[py::str(origin.path)] = origin_of(origin);
  return py::make_tuple(values_of(values.in_si, values.origins), from);
}

}  // namespace

void bind_values(py::module_& m) {
  m.def("read_values", &read_values, py::arg("path"), py::arg("sets") = py::none());
}

}  // namespace sinew::python
