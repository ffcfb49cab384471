// gas/series.h - the pressure between restrictions that hold no air between them.
//
// What flows into the node flows out: sum of inflows(y) = 0. Every restriction's flow into the node
// falls as the node's y rises, so there is one root, and it lies between the lowest and the highest
// of the outer pressures.
#pragma once

namespace sinew::gas {

// y where the falling function `surplus` passes zero, surplus(low) >= 0 >= surplus(high). False
// position with the Illinois halving; stops where two neighbouring numbers enclose it or at a zero.
template <class Function>
double balance(const Function& surplus, double low, double high) noexcept {
  double f_low = surplus(low), f_high = surplus(high);
  if (!(f_low > 0)) return low;
  if (!(f_high < 0)) return high;
  int side = 0;
  for (int k = 0; k < 200 && high - low > 4e-16 * high; ++k) {
    // Every fourth guess halves: no function can be slower than that.
    double y = k % 4 == 3 ? 0.5 * (low + high) : low + (high - low) * (f_low / (f_low - f_high));
    if (!(y > low && y < high)) y = 0.5 * (low + high);
    const double f = surplus(y);
    if (f == 0) return y;
    if (f > 0) {
      low = y;
      f_low = f;
      if (side == 1) f_high *= 0.5;
      side = 1;
    } else {
      high = y;
      f_high = f;
      if (side == -1) f_low *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace sinew::gas
