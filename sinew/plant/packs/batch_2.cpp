// plant/packs/batch_2.cpp - two lanes, which every processor has.
#include "sinew/plant/packs/wide/batch_of.h"

namespace sinew::plant {

template <>
const BatchCalls& batch_calls<2>() {
  return BatchOf<2>::calls;
}

}  // namespace sinew::plant
