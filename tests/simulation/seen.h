// tests/simulation/seen.h - all readings of a simulation as one number.
#pragma once

#include <bit>
#include <cstdint>

#include "sinew/run/simulation/simulation.h"

namespace sinew::test {

// FNV-1a of the bits of every channel at ten instants from its current time to its end.
inline std::uint64_t seen_to_the_end(run::Simulation& s) {
  std::uint64_t h = 0xcbf29ce484222325;
  const signals::Tick from = s.last() - s.last() / 20;
  for (int i = 0; i <= 9; ++i) {
    s.advance_to(from + (s.last() - from) * i / 9);
    for (std::size_t c = 0; c < s.channels().size(); ++c)
      h = (h ^ std::bit_cast<std::uint64_t>(s.read(c))) * 0x100000001b3;
  }
  return h;
}

}  // namespace sinew::test
