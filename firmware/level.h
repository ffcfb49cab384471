// firmware/level.h - output level at which a board gives current to a coil.
#pragma once

namespace sinew::firmware {

// true: level 0, as for opto-couplers that are connected to the supply. The value is the robot's
// wiring.polarity. `sinew firmware build` compiles it in, because it has to be right before a host
// is connected. It applies to the supply's output too.
inline constexpr bool low_gives_current = SINEW_LOW_GIVES_CURRENT;

}  // namespace sinew::firmware
