// live/request.h - what a page may ask of the run that it shows, as text of JSON:
//
//   {"do": "pause"}   {"do": "resume"}   {"do": "pace", "value": 0.5}      0: as fast as it goes
//   {"do": "set", "key": "control.gains.hip.angle", "value": 0.003}        in the key's SI unit
//   {"do": "release", "key": "control.gains.hip.angle"}   {"do": "release all"}
//   {"do": "stop"}      a machine that keeps its own time, in place of pause, resume and pace
#pragma once

#include <string_view>
#include <vector>

#include "sinew/control/gait/change.h"

namespace sinew::live {

struct Request {
  // Names what is asked for.
  enum class Kind { pause, resume, pace, stop, set, release, release_all };

  Kind kind = Kind::pause;
  std::size_t setting = 0;  // its number
  double value = 0;
};

inline constexpr std::size_t longest_request = 1024;  // [bytes]

// Throws std::invalid_argument, which says what was found and what was expected, for anything else.
Request read_request(std::string_view text, const std::vector<gait::Setting>& settings);

}  // namespace sinew::live
