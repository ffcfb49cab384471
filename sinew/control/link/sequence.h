// control/link/sequence.h - detection of repeated and lost frames by their sequence numbers.
//
// A sender counts its frames, 0 after 255. A frame 1 to 127 ahead of the last one is new, and the
// ones between were lost; an equal number or one behind is a repetition and is not accepted. More
// than 127 consecutive lost frames are taken for repetitions: identify, which moves nothing,
// restarts the count while no joint is armed.
#pragma once

#include <cstdint>

namespace sinew::link {

// Sequence numbers of a board that have been seen.
class SequenceWindow {
 public:
  // Returns whether a frame is new.
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

  // Accepts the next frame with any number.
  constexpr void restart() noexcept { begun_ = false; }

  // Return the number of lost and of repeated frames.
  constexpr std::uint32_t lost() const noexcept { return lost_; }
  constexpr std::uint32_t repeated() const noexcept { return repeated_; }

 private:
  static constexpr std::uint8_t newest_ahead = 127;

  std::uint32_t lost_ = 0, repeated_ = 0;
  std::uint8_t last_ = 0;
  bool begun_ = false;
};

}  // namespace sinew::link
