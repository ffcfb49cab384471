// world/kernel/cut.h - search for the instant of a discontinuity at which a step is cut.
#pragma once

namespace sinew::plant {

namespace detail {

struct Sample {
  double at = 0, gap = 0;
};

// Returns the time at which the parabola at(gap) through three samples has a gap of 0.
inline double parabola(const Sample& a, const Sample& b, const Sample& c) {
  const double ab = a.gap - b.gap, bc = b.gap - c.gap, ca = c.gap - a.gap;
  return -(a.at * (b.gap / ab) * (c.gap / ca) + b.at * (a.gap / ab) * (c.gap / bc) +
           c.at * (a.gap / ca) * (b.gap / bc));
}

}  // namespace detail

// Returns an instant at most `within` after the one at which `gap` crosses zero between 0 and h.
// `gap` is positive beyond the discontinuity and nowhere else; it is `before` (not positive) at 0
// and `after` at h. The last call of `gap` with a positive result was for the returned instant; if
// there was no such call, the result is h.
//
// The next instant is the zero of a parabola through both sides and the sample before them, or of
// the chord if that is not between them, or the middle if these have gained little. Half of
// `within` is added, so that the far side approaches as quickly as the near side.
template <class Gap>
double cut(double h, double before, double after, double within, Gap gap) {
  using detail::Sample;
  constexpr int most = 100;  // a bisection alone would take fewer
  Sample low{0, before}, high{h, after}, third;
  int samples = 2, slow = 0;  // number of steps in a row that gained less than half
  for (int i = 0; i < most && high.at - low.at > within; ++i) {
    const double width = high.at - low.at;
    double root = 0.5 * (low.at + high.at);
    if (low.gap < 0 && slow < 2) {
      root = (low.at * high.gap - high.at * low.gap) / (high.gap - low.gap);
      const double bent = samples > 2 ? detail::parabola(low, high, third) : root;
      root = bent > low.at && bent < high.at ? bent : root;
    }
    // If the zero is close enough to the far side, a sample just before it on the near side ends
    // the search.
    const bool last = high.at - root < 0.9 * within;
    const double at = last ? root - 0.4 * within : root + 0.5 * within;
    const double least = last ? high.at - 0.9 * within : low.at + 0.5 * within;
    const double greatest = high.at - 0.5 * within;
    const double next = at > least ? (at < greatest ? at : greatest) : least;
    const double g = gap(next);
    (g > 0 ? third = high : third = low);
    (g > 0 ? high : low) = {next, g};
    slow = slow < 2 && high.at - low.at > 0.5 * width ? slow + 1 : 0;
    samples = 3;
  }
  return high.at;
}

}  // namespace sinew::plant
