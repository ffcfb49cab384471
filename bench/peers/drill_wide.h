// bench/peers/drill_wide.h - the widths of drill.h, one library each, so that nothing of what is
// compiled for a wide processor gets into another.
#pragma once

#include "bench/peers/drill.h"

namespace sinew::bench {

[[gnu::visibility("default")]] Wide wide_2();
[[gnu::visibility("default")]] Wide wide_4();
[[gnu::visibility("default")]] Wide wide_8();

}  // namespace sinew::bench
