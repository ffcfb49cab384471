// plant/world/cut.h - where a step has to be cut: the instant at which a law breaks off.
#pragma once

namespace sinew::plant {

// Returns an instant at most `within` after the one at which `gap` passes zero between 0 and h
// (Illinois' rule, which is a secant that keeps both sides). `gap` is above 0 where it has broken
// and nowhere else; it was `before`, not above 0, at 0 and is `after` at h. The last call of `gap`
// that answered above 0 was for the instant returned; without one it is h.
template <class Gap>
double cut(double h, double before, double after, double within, Gap gap) {
  constexpr int most = 60;  // a bisection alone would take no more
  double low = 0, high = h;
  int side = 0;  // the one that moved last
  for (int i = 0; i < most && high - low > within; ++i) {
    double at = 0.5 * (low + high);
    if (before < 0) at = (low * after - high * before) / (after - before) + 0.5 * within;
    const double least = low + 0.5 * within, greatest = high - 0.5 * within;
    at = at > least ? at : least;
    at = at < greatest ? at : greatest;
    const double g = gap(at);
    if (g > 0) {
      high = at;
      after = g;
      if (side > 0) before *= 0.5;
      side = 1;
    } else {
      low = at;
      before = g;
      if (side < 0) after *= 0.5;
      side = -1;
    }
  }
  return high;
}

}  // namespace sinew::plant
