// tune/largest.h - the largest value for which something holds, from below.
//
// Goes up along the given values to the first that does not hold, then halves the interval between
// it and the one before. What holds again further up is not looked for, so of something that is not
// monotone this is the end of the lowest part, as finely as the values see it.
#pragma once

#include <cstddef>
#include <vector>

namespace sinew::tune {

struct Largest {
  enum class Is { never, between, to_the_end };  // not even the first; found; even the last holds

  Is is = Is::never;
  double value = 0;  // the largest that held; of no meaning for `never`
  double fails = 0;  // the smallest above it that did not; of no meaning for `to_the_end`
};

// `values` in the order in which they are tried. `holds(double) -> bool` is asked at most
// values.size() + halvings times.
template <class Holds>
Largest largest(const std::vector<double>& values, int halvings, Holds holds) {
  std::size_t n = 0;
  while (n < values.size() && holds(values[n])) ++n;
  if (n == 0) return {};
  Largest out{Largest::Is::to_the_end, values[n - 1], 0};
  if (n == values.size()) return out;

  out.is = Largest::Is::between;
  out.fails = values[n];
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (out.value + out.fails);
    (holds(middle) ? out.value : out.fails) = middle;
  }
  return out;
}

}  // namespace sinew::tune
