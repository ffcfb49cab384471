// world/packs/batch_2.cpp - two lanes, which every processor has.
#include "sinew/world/packs/wide/batch_of.h"

namespace sinew::plant {

template <>
const BatchCalls& batch_calls<2>() {
  static constexpr BatchCalls calls = BatchOf<2>::calls();
  return calls;
}

}  // namespace sinew::plant
