// recording/wrap.h - counters of a clock that begin again at a power of two.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::recording {

// Continues a counter of 8, 16, 24, 32, 53 or 64 bits, with or without sign, over its end. It may
// count thousandths of the numbers: micros() / 1000 begins again at 4294967.296 ms.
class Unwrapper {
 public:
  // Returns a time as a clock would show it that does not begin again. A step back is a wrap only
  // where a power of two explains it to within one sample: any other is left as it is.
  double operator()(double time);

  // Returns how often it has begun again.
  std::size_t wraps() const { return wraps_; }
  int bits() const { return bits_; }  // of the counter, once it has begun again

 private:
  std::optional<double> range_of(double time) const;

  double added_ = 0, last_ = 0, step_ = 0;  // in the file's numbers
  std::size_t count_ = 0, wraps_ = 0;
  mutable int bits_ = 0;
};

// Returns a note on a clock's counter that began again.
std::string wraps_text(std::string_view column, const Unwrapper& clock);

}  // namespace sinew::recording
