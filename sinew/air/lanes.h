// air/lanes.h - one number per muscle, in lanes of four, and what they make up: the body's
// motion as the air feels it, and the answer of one evaluation.
//
// S is a double; or a pack of them (units/pack.h), of machines side by side.
#pragma once

#include <array>

namespace sinew::air {

inline constexpr int lanes = 4;  // that are evaluated together

// Four doubles that are added, multiplied, compared and chosen lane by lane: GCC's and Clang's
// vector extension. Without wide registers it is two pairs; the bits are those of four scalars.
using Four = double __attribute__((vector_size(8 * lanes), may_alias));

// One number for each of at most `Most` muscles. Not set when made: `Lanes<8> x{}` is zero.
template <int Most, class S = double>
struct alignas(64) Lanes {
  static_assert(Most % lanes == 0);
  std::array<S, Most> of;

  S& operator[](int i) { return of[static_cast<std::size_t>(i)]; }
  S operator[](int i) const { return of[static_cast<std::size_t>(i)]; }

  // Lanes first ... first + 3.
  const Four& four(int first) const { return reinterpret_cast<const Four&>(of[first]); }
  Four& four(int first) { return reinterpret_cast<Four&>(of[first]); }
};

// The body's motion, as the air feels it: the muscles' lengths and the piston's travel.
template <int Most, class S = double>
struct Ends {
  Lanes<Most, S> length, rate;    // [m], [m/s]
  S travel = 0, travel_rate = 0;  // of a cylinder, upwards [m], [m/s]
};

// The answer of the braids to one evaluation.
template <int Most, class S = double>
struct Pull {
  Lanes<Most, S>
      tension;  // of the bundle, static and viscous, never negative: a cord cannot push [N]
  Lanes<Most, S>
      clamped;  // the same of a muscle that is held at both ends: negative where it pushes [N]
  Lanes<Most, S> pressure;  // absolute [Pa]
  Lanes<Most, S>
      friction_bound;    // bound of the bundle's dry friction, [33], [34]; 0 if not `stick` [N]
  Lanes<Most, S> drift;  // x, how far the density is from the pressure's reference [-]
};

// The series are taken about this density of each muscle: y_ref and 1/sigma_ref [m^3/kg].
template <int Most, class S = double>
struct Reference {
  Lanes<Most, S> y, inverse_sigma;
};

}  // namespace sinew::air
