// firmware/lock_step.h - what the board in the emulator and the simulation around it say to each
// other over two pipes: its valves, its converter, its line, its clock. All numbers little-endian.
//
//   board to host   V  tick u64  open u32  flags u8    valves from that tick on
//                   R  tick u64  channel u8            answered: counts u16, status u8
//                   L  size u16  bytes                 out of the line
//                   W  tick u64                        a period begins; answered: size u16, bytes
//                                                      into the line, or the size `ends`
//                   S  deepest stack u32, its memory u32   before it ends
//
// Ticks are the board's, since its reset.
#pragma once

#include <cstdint>

namespace sinew::firmware {

namespace record {
inline constexpr std::uint8_t valves = 'V', reading = 'R', line = 'L', waits = 'W', sizes = 'S';
}
inline constexpr std::uint16_t ends = 0xffff;
inline constexpr std::uint8_t has_current = 1, has_supply = 2, is_fed = 4;  // flags

}  // namespace sinew::firmware
