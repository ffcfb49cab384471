// fmu/slave/discarded.h - exception for requests that an importer can change, such as a value
// out of range or a step that is too long. The interface returns the status "discard".
#pragma once

#include <stdexcept>

namespace sinew::fmu {

struct Discarded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sinew::fmu
