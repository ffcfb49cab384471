// world/packs/wide/batch_wide.cpp - SINEW_LANES lanes, compiled for the processors that have them
// (cmake/lanes.cmake).
#include "sinew/world/packs/wide/batch_of.h"

namespace sinew::plant {

template <>
const BatchCalls& batch_calls<SINEW_LANES>() {
  static constexpr BatchCalls calls = BatchOf<SINEW_LANES>::calls();
  return calls;
}

}  // namespace sinew::plant
