// bench/peers/drill_wide.h - the widths of drill.h, each in its own library, so that code for wide
// registers is not linked into code for other processors.
#pragma once

#include "bench/peers/drill.h"

namespace sinew::bench {

[[gnu::visibility("default")]] Wide wide_2();
[[gnu::visibility("default")]] Wide wide_4();
[[gnu::visibility("default")]] Wide wide_8();

}  // namespace sinew::bench
