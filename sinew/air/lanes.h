// air/lanes.h - one number per muscle, in lanes of four, and what they make up: the body's
// motion as the air feels it, and the answer of one evaluation.
#pragma once

#include <array>

namespace sinew::air {

inline constexpr int lanes = 4;  // that are evaluated together

// Four doubles that are added, multiplied, compared and chosen lane by lane: GCC's and Clang's
// vector extension. Without wide registers it is two pairs; the bits are those of four scalars.
using Four = double __attribute__((vector_size(8 * lanes), may_alias));

// One number for each of at most `Most` muscles. Not set when made: `Lanes<8> x{}` is zero.
template <int Most>
struct alignas(64) Lanes {
  static_assert(Most % lanes == 0);
  std::array<double, Most> of;

  double& operator[](int i) { return of[static_cast<std::size_t>(i)]; }
  double operator[](int i) const { return of[static_cast<std::size_t>(i)]; }

  // Lanes first ... first + 3.
  const Four& four(int first) const { return reinterpret_cast<const Four&>(of[first]); }
  Four& four(int first) { return reinterpret_cast<Four&>(of[first]); }
};

// The body's motion, as the air feels it: the muscles' lengths and the piston's travel.
template <int Most>
struct Ends {
  Lanes<Most> length, rate;            // [m], [m/s]
  double travel = 0, travel_rate = 0;  // of a cylinder, upwards [m], [m/s]
};

// The answer of the braids to one evaluation.
template <int Most>
struct Pull {
  Lanes<Most> tension;  // of the bundle, static and viscous, never negative: a cord cannot push [N]
  Lanes<Most> clamped;  // the same of a muscle that is held at both ends: it may push [N]
  Lanes<Most> pressure;  // absolute [Pa]
  Lanes<Most>
      friction_bound;  // bound of the bundle's dry friction, [33], [34]; 0 if not `stick` [N]
  Lanes<Most> drift;   // x, how far the density is from the pressure's reference [-]
};

// The series are taken about this density of each muscle: y_ref and 1/sigma_ref [m^3/kg].
template <int Most>
struct Reference {
  Lanes<Most> y, inverse_sigma;
};

}  // namespace sinew::air
