// air/braid_law.h - air volume and tension of a bundle of braided actuators, [31]-[34], as
// functions of its length and of y = (P/P_atm)^(1/7) of its air.
//
// actuator/tension.h and loss.h have the same laws in direct form, and a test compares both. Here
// constant products are multiplied out beforehand and nothing branches. S is a double or a pack
// (units/pack.h) over the muscles of a machine, or over one muscle of several machines.
//
// Holds for muscles for which lanes_support() is true. The caller completes the dry friction where
// its bound depends on the sealed stiffness (Loss::Scale::sealed) and where an actuator does not
// stick.
#pragma once

#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/power_series.h"
#include "sinew/units/pack.h"

namespace sinew::air {

// Returns whether lanes include every part of this muscle's law.
bool lanes_support(const Muscle& muscle);

// Constants of a bundle, multiplied with its number of actuators.
template <class S>
struct BraidConstants {
  S thread2, cubic, linear, external;  // b^2; volume: external + l (linear - cubic l^2)
  S c0, c1, c2, low, high;             // effectiveness, as a function of the gauge pressure
  S viscous, bladder, bladder_rest;    // passive
  S long_length, long_stiffness, long_damping;     // [32], [35]
  S short_length, short_stiffness, short_damping;  // end stop
  S short_zero;                  // 1 if [31] sets the tension to 0 below the shortest length
  S mesh_secant, mesh_constant;  // Q for [34], or the bound itself
};

// Returns the constants of a bundle for this air.
BraidConstants<double> braid_constants(const Muscle& muscle, const gas::Air& air);

// Absolute pressure [Pa]; tension of the bundle, and that of a bundle held at both ends, which is
// negative where it pushes [N]; bound of the dry friction [N].
template <class S>
struct BraidPull {
  S pressure, tension, clamped, friction_bound;
};

// Inputs of a bundle's pull: its length [m], the length's rate [m/s], its mass of air [kg], and the
// reference of its density.
template <class S>
struct BraidState {
  S length, rate, mass, y_ref, inverse_sigma;
};

// Returns y of a density by the power itself, for densities outside the series' range [-].
// `inverse_reference`: 1 over the density at the atmosphere [m^3/kg].
double exact_root(double density, double inverse_reference, double exponent) noexcept;

// Returns the volume of the bundle's air [m^3].
template <class S>
[[gnu::always_inline]] inline S braid_volume(const BraidConstants<S>& k, const S& length) {
  const S inside = length * (k.linear - k.cubic * (length * length));
  return units::select(inside > 0.0, inside, 0.0) + k.external;
}

// Returns the pressure and the tensions of a bundle at a length [m], its rate [m/s] and y.
template <class S>
[[gnu::always_inline]] inline BraidPull<S> braid_pull(const BraidConstants<S>& k,
                                                      const S& atmosphere, const S& length,
                                                      const S& rate, const S& y) {
  // These terms do not depend on the pressure.
  const S lever = k.cubic * (3.0 * (length * length) - k.thread2);
  const S stretch = length - k.long_length, squeeze = length - k.short_length;
  const S braid = k.long_stiffness * stretch + k.long_damping * rate;
  const S passive = (k.bladder * (length - k.bladder_rest) + k.viscous * rate) +
                    units::select(stretch > 0.0, braid, 0.0);
  const S stop = k.short_stiffness * squeeze + k.short_damping * rate;
  const S squeezed = units::select(squeeze < 0.0, stop, 0.0);
  const S secant = k.mesh_secant * (length + k.short_length);

  // Gauge pressure times effectiveness, and the tension.
  const S y2 = y * y, y4 = y2 * y2;
  const S pressure = (atmosphere * y4) * (y2 * y);
  const S gauge = pressure - atmosphere;
  const S raised = units::select(gauge < k.low, k.low, gauge);
  const S bounded = units::select(raised > k.high, k.high, raised);
  const S share = k.c0 + bounded * (k.c1 + bounded * k.c2);
  const S drive = gauge * share;
  const S pull = drive * lever + (passive + squeezed);
  const auto nothing = units::select(squeeze < 0.0, k.short_zero, 0.0) > 0.0;  // [31] as printed
  const S all = units::select(nothing, 0.0, pull);
  const S friction = units::select(nothing, 0.0, drive * secant + k.mesh_constant);
  return {.pressure = pressure,
          .tension = units::select(all > 0.0, all, 0.0),
          .clamped = all,
          .friction_bound = units::select(friction > 0.0, friction, 0.0)};
}

// Writes x, the density's deviation from the reference, and y by the series. The result is valid
// while |x| is within the series' reach.
template <class S, class Series>
[[gnu::always_inline]] inline void braid_root(const BraidConstants<S>& k, const BraidState<S>& at,
                                              const Series& series, S& x, S& y) {
  x = (at.mass * at.inverse_sigma) / braid_volume(k, at.length) - 1.0;
  S power;
  series.raise(x, power);
  y = at.y_ref * power;
}

// Returns the pressure and the tensions of a bundle, with x and y; far(x, y) corrects y beyond the
// series' `reach`.
template <class S, class Series, class Far>
[[gnu::always_inline]] inline BraidPull<S> braid_at(const BraidConstants<S>& k,
                                                    const BraidState<S>& at, const S& atmosphere,
                                                    const Series& series, const S& reach,
                                                    const Far& far, S& x, S& y) {
  braid_root(k, at, series, x, y);
  if (const auto outside = (x > reach) | (x < -reach); units::any(outside)) far(outside, x, y);
  return braid_pull(k, atmosphere, at.length, at.rate, y);
}

}  // namespace sinew::air
