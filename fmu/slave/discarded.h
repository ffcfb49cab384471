// fmu/slave/discarded.h - what an importer may do otherwise and go on: a value out of range, a step
// that is too long. The interface answers "discard".
#pragma once

#include <stdexcept>

namespace sinew::fmu {

struct Discarded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sinew::fmu
