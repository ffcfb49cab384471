// control/link/sequence.h - which frames of the other end are new, and how many of them were lost.
//
// A sender counts its frames, 0 after 255. Ahead of the last one by 1 to 127 is new, what lies
// between was lost; the same or behind it is a repetition and is not taken again. More than 127
// lost in a row look like old ones: identify, which moves nothing, sets the count anew while no
// joint is armed.
#pragma once

#include <cstdint>

namespace sinew::link {

// Sequence numbers of a board that have been seen.
class SequenceWindow {
 public:
  // False: seen before, or older than what was.
  constexpr bool take(std::uint8_t sequence) noexcept {
    const std::uint8_t ahead = static_cast<std::uint8_t>(sequence - last_);
    if (begun_ && (ahead == 0 || ahead > newest_ahead)) {
      ++repeated_;
      return false;
    }
    if (begun_) lost_ += ahead - 1u;
    begun_ = true;
    last_ = sequence;
    return true;
  }

  // The next frame is taken, whatever its number.
  constexpr void restart() noexcept { begun_ = false; }

  // How many frames were lost, and how many came twice.
  constexpr std::uint32_t lost() const noexcept { return lost_; }
  constexpr std::uint32_t repeated() const noexcept { return repeated_; }

 private:
  static constexpr std::uint8_t newest_ahead = 127;

  std::uint32_t lost_ = 0, repeated_ = 0;
  std::uint8_t last_ = 0;
  bool begun_ = false;
};

}  // namespace sinew::link
