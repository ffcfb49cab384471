#include "python/binding/numbers.h"

#include <fmt/format.h>

namespace sinew::python {

namespace {

// Refuses masked arrays, whose masked elements hold meaningless numbers.
void refuse_masked(const py::handle& given, const char* name) {
  if (!py::isinstance<py::array>(given) || !py::hasattr(given, "mask")) return;
  const auto masked =
      py::module_::import("numpy").attr("ma").attr("count_masked")(given).cast<py::ssize_t>();
  if (masked > 0)
    throw std::invalid_argument(fmt::format(
        "{0}: found a masked array, with {1} masked; expected numbers alone; {0}[~{0}.mask].data "
        "leaves these out, in the arrays that belong to it as well",
        name, masked));
}

}  // namespace

Numbers numbers(const py::handle& given, const char* name) {
  refuse_masked(given, name);
  if (Numbers::check_(given)) return py::reinterpret_borrow<Numbers>(given);
  const py::array any = py::array::ensure(given);
  constexpr std::string_view real = "fiub";
  if (!any || real.find(any.dtype().kind()) == real.npos) {
    auto found = py::repr(given).cast<std::string>();
    if (found.size() > 60) found = found.substr(0, 60) + " …";
    throw py::type_error(fmt::format("{}: found {}; expected real numbers", name, found));
  }
  return Numbers(any);
}

void check_shape(const py::array& numbers, std::initializer_list<std::size_t> shape,
                 const char* name) {
  const auto is = [&] {
    if (numbers.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
    py::ssize_t i = 0;
    for (const std::size_t n : shape)
      if (numbers.shape(i++) != static_cast<py::ssize_t>(n)) return false;
    return true;
  };
  if (is()) return;
  py::tuple expected(shape.size());
  std::size_t i = 0;
  for (const std::size_t n : shape) expected[i++] = n;
  throw std::invalid_argument(fmt::format("{}: found an array of shape {}; expected {}", name,
                                          py::str(numbers.attr("shape")).cast<std::string>(),
                                          py::str(expected).cast<std::string>()));
}

}  // namespace sinew::python
