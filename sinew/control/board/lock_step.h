// control/board/lock_step.h - records that a board in an emulator and the simulation around it
// exchange over two pipes: valves, converter, line and clock of the board. All numbers are
// little-endian.
//
//   board to host   V  tick i64  open u32  flags u8    valves from that tick on
//                   R  tick i64  channel u8            reply: counts u16, status u8; or ticks
//                                                      u16, a mishap u8: the application stalls
//                                                      and requests it again, or resets
//                   L  size u16  bytes                 output of the line
//                   W  tick i64                        a period begins; reply: size u16, bytes
//                                                      for the line, or the size `ends`
//                   S  deepest stack u32, its memory u32   before it ends
//
// Ticks are the run's, since its first command; -1 outside a run.
#pragma once

#include <cstdint>

namespace sinew::board {

namespace record {
inline constexpr std::uint8_t valves = 'V', reading = 'R', line = 'L', waits = 'W', sizes = 'S';
}
namespace failure {                           // instead of a status
inline constexpr std::uint8_t stalls = 0xf0;  // for a number of ticks
inline constexpr std::uint8_t resets = 0xf1;
}  // namespace failure
// Marks by which a host identifies the two programs for the emulator.
inline constexpr char lock_step_image[] = "sinew firmware in lock step";
inline constexpr char application_image[] = "sinew firmware at a serial line";

inline constexpr std::uint16_t ends = 0xffff;
inline constexpr std::uint8_t has_current = 1, has_supply = 2;  // flags

}  // namespace sinew::board
