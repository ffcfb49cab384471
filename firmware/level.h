// firmware/level.h - which level of a board's outputs gives a coil current, for its port.
#pragma once

namespace sinew::firmware {

// true: 0, as with opto-couplers that hang on the supply. The robot's wiring.polarity says so, and
// `sinew firmware build` compiles it in, because it must hold before any host is heard. It holds
// for the supply's output too.
inline constexpr bool low_gives_current = SINEW_LOW_GIVES_CURRENT;

}  // namespace sinew::firmware
