// air/lanes.h - arrays with one number per muscle in lanes of four, and types made of them: the
// body's motion as input of the air, and the result of one evaluation.
//
// S is a double, or a pack of doubles (units/pack.h) over several machines.
#pragma once

#include <array>

namespace sinew::air {

inline constexpr int lanes = 4;  // evaluated together

// Four doubles that are added, multiplied, compared and selected lane by lane, by the vector
// extension of GCC and Clang. Without wide registers it is two pairs; the bits are those of four
// scalars.
using Four = double __attribute__((vector_size(8 * lanes), may_alias));

// One number for each of at most `Most` muscles. Uninitialised by default; `Lanes<8> x{}` is zero.
template <int Most, class S = double>
struct alignas(64) Lanes {
  static_assert(Most % lanes == 0);
  std::array<S, Most> of;

  S& operator[](int i) { return of[static_cast<std::size_t>(i)]; }
  S operator[](int i) const { return of[static_cast<std::size_t>(i)]; }

  // Return the lanes first ... first + 3.
  const Four& four(int first) const { return reinterpret_cast<const Four&>(of[first]); }
  Four& four(int first) { return reinterpret_cast<Four&>(of[first]); }
};

// The body's motion, as input of the air: the muscles' lengths and the piston's travel.
template <int Most, class S = double>
struct Ends {
  Lanes<Most, S> length, rate;    // [m], [m/s]
  S travel = 0, travel_rate = 0;  // piston of a cylinder, upwards [m], [m/s]
};

// Result of the braids for one evaluation.
template <int Most, class S = double>
struct Pull {
  Lanes<Most, S> tension;   // static and viscous, never negative: a tendon cannot push [N]
  Lanes<Most, S> clamped;   // same, of a muscle held at both ends: negative where it pushes [N]
  Lanes<Most, S> pressure;  // absolute [Pa]
  Lanes<Most, S>
      friction_bound;    // bound of the bundle's dry friction, [33], [34]; 0 if not `stick` [N]
  Lanes<Most, S> drift;  // x, relative deviation of the density from the reference [-]
};

// Base of the series for each muscle's density: y_ref and 1/sigma_ref [m^3/kg].
template <int Most, class S = double>
struct Reference {
  Lanes<Most, S> y, inverse_sigma;
};

}  // namespace sinew::air
