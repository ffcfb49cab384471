// recording/wrap.h - correction of clock counters that overflow and restart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::recording {

// Continues a counter of 8, 16, 24, 32, 53 or 64 bits, signed or unsigned, after an overflow. Its
// numbers may be in thousandths, millionths or billionths: micros() / 1000 restarts at 4294967.296
// ms.
class Unwrapper {
 public:
  // Returns the time as a counter without overflow would show it. A step back counts as an overflow
  // only if a power of two explains it to within one sample; other steps back are left as they are.
  double operator()(double time);

  // Returns the number of overflows.
  std::size_t wraps() const { return wraps_; }
  int bits() const { return bits_; }  // width of the counter, after the first overflow

 private:
  std::optional<double> range_of(double time) const;

  double added_ = 0, last_ = 0, step_ = 0;  // in the file's numbers
  std::size_t count_ = 0, wraps_ = 0;
  mutable int bits_ = 0;
};

// Returns a note about a clock's counter that overflowed.
std::string wraps_text(std::string_view column, const Unwrapper& clock);

}  // namespace sinew::recording
