// actuator/actuator.h - parameters of one braided pneumatic actuator (McKibben muscle).
//
// The laws are in braid.h (geometry), body.h, bladder.h, pull.h, series.h, tension.h, loss.h,
// hysteresis.h, creep.h, stiffness.h and life.h. All values are in SI units; a pressure is absolute
// unless its name has "gauge". Source: Colbrunn (2000), equation numbers in brackets.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace sinew::actuator {

// [1]-[4]: threads of a fixed length that wind around a cylinder.
struct Braid {
  double thread_length = 0;  // b [m]
  double turns = 0;          // n, turns of one thread [-]
};

// [30]: effective share of the ideal tension, a polynomial of the pressure.
struct Effectiveness {
  enum class Argument { gauge, absolute };  // the text has gauge, appendix A absolute
  double c0 = 1, c1 = 0, c2 = 0;            // [1], [1/Pa], [1/Pa^2]
  double scale = 1;                         // Eff_s, factor of the polynomial [-]
  Argument argument = Argument::gauge;
  double valid_from = 0, valid_to = 7.6e5;  // fitted range of gauge pressures [Pa]
  double threshold = 0;  // gauge pressure at which the bladder touches the mesh [Pa]
};

// [32], [35]: beyond `length` the threads themselves stretch.
struct LongEnd {
  double length = 0;     // L_max [m]
  double stiffness = 0;  // K_braid [N/m]
  double damping = 0;    // C_braid [N s/m]
};

// [31] below the shortest length b/sqrt 3. As printed the tension is zero there, so that nothing
// holds a load beyond it. `stop` is an end stop that pushes back; `empirical` is the line that
// appendix A has commented out, "empirical guesses that match data".
struct ShortEnd {
  // Names the force below the shortest length.
  enum class Law { stop, zero, empirical };
  Law law = Law::stop;
  double stiffness = 0;  // [N/m]
  double damping = 0;    // [N s/m]
};

// [33], [34]: viscous loss, and dry friction between bladder and mesh of at most Q times a
// stiffness.
struct Loss {
  // Names the stiffness that is multiplied with Q.
  enum class Scale { secant, sealed, constant };
  double viscous = 0;         // c [N s/m]
  double coulomb_length = 0;  // Q [m]
  Scale coulomb_scale = Scale::secant;
  double coulomb_stiffness = 0;  // stiffness for Scale::constant [N/m]
  bool stick = true;             // false: sign(v) as printed
};

// The bladder as a separate spring; not in the thesis, see bladder.h.
struct Bladder {
  // Names its size in the mesh, thesis 7.3: stretched by the pressure until it touches the mesh;
  // wider and longer than the mesh ever is; the same, of a film.
  enum class Fit { stretched, oversized, liner };
  Fit fit = Fit::stretched;
  double stiffness = 0;                   // k_1 [N/m]
  double rest_length = 0;                 // L_r [m]
  double quadratic = 0, cubic = 0;        // k_2, k_3 [N/m2] [N/m3]
  double saturating_tension = 0;          // S [N]
  double saturation_length = 0;           // lambda [m]
  double valid_from = 0, valid_to = 1e3;  // fitted range of lengths [m]
};

// Part of the length that does not contract, both ends together; see body.h.
struct Caps {
  double length = 0;  // d [m]
};

// Tapering ends, modelled as a larger contraction; see body.h.
struct Taper {
  double gain = 1;            // kappa_0 [-]
  double extra_gain = 0;      // kappa_low, added without pressure [-]
  double extra_pressure = 0;  // P_low, pressure scale of its decay [Pa]
  double rest_length = 0;     // L_0 [m]
};

// Wall of the tube; see body.h.
struct Wall {
  double thickness = 0;  // h_w [m]
};

// Friction of the mesh, as a pressure that is lost while the pressure rises; not in the thesis, see
// hysteresis.h.
struct Hysteresis {
  double half_width = 0;             // w_0 [Pa]
  double width_per_pressure = 0;     // w_P [-], below 1
  double width_per_contraction = 0;  // w_eps [Pa], contraction relative to L_max
  double width_per_tension = 0;      // w_F [-], share of the tension
  double volume_pressure = 0;        // P_V [Pa]: has the effect of the greatest volume
};

// Tension that follows with a delay; not in the thesis, see creep.h.
struct Creep {
  static constexpr int most = 2;     // number of elements
  std::array<double, most> share{};  // chi_i [-]; 0: no such element
  std::array<double, most> time{};   // t_i [s]
};

// Air volume in addition to that of the braid; not in the thesis, see body.h.
struct AirVolume {
  double offset = 0;  // V_a [m3], below 0: taken by a thick wall or an insert
};

// Elasticity between a muscle's clamps and its braid; not in the thesis, see series.h.
struct Series {
  double compliance = 0;  // C_s [m/N]
};

// Soft beginning of the tension of a slack muscle; not in the thesis, see series.h.
struct Toe {
  double tension = 0;  // F_toe [N], 0: no soft beginning
};

// Number of cycles until an actuator fails, as a range; see life.h. 0: unknown.
struct Life {
  double contraction = 0;                        // reference: range of contraction, of L_max [-]
  double pressure = 0;                           // reference: largest gauge pressure [Pa]
  double cycles_over = 0, cycles_under = 0;      // bounds of the mean life there [-]
  double exponent_least = 0, exponent_most = 0;  // m [-]
  double factor_least = 1, factor_most = 1;      // f, for another bladder [-]
};

// Spread of measured forces about the law's, as written to the actuator's file by an
// identification; not part of any law, see prediction.h. 0: unknown.
struct Prediction {
  double rest_length = 0;               // L_0 of the muscle [m]
  std::vector<double> lengths;          // measured lengths, in ascending order [m]
  double lowest = 0, highest = 0;       // measured range of gauge pressures [Pa]
  double inside_68 = 0, inside_95 = 0;  // half-widths at these lengths, between the pressures [N]
  double per_force_68 = 0, per_force_95 = 0;  // share of the force, added to all as squares [-]
  double between_68 = 0, between_95 = 0;      // halfway in the widest gap between two lengths [N]
  double beyond_68 = 0, beyond_95 = 0;        // a fifth of the range beyond the lengths [N]
  double above_68 = 0, above_95 = 0;          // a fifth of the range beyond the pressures [N]
  double other_68 = 0, other_95 = 0;  // muscles of other rest lengths, of the largest force [-]
  double other_reach = 0;             // |ln(L/L_0)| over which other_* was tested [-]
};

struct Actuator {
  std::string name;
  Braid braid;
  Effectiveness effectiveness;
  LongEnd long_end;
  ShortEnd short_end;
  Loss loss;
  Bladder bladder;
  Caps caps;
  Taper taper;
  Wall wall;
  AirVolume air;
  Series series;
  Toe toe;
  Hysteresis hysteresis;
  Creep creep;
  Life life;
  Prediction prediction;
};

}  // namespace sinew::actuator
