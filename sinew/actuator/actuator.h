// actuator/actuator.h - one braided pneumatic actuator (McKibben muscle): its parameters.
//
// The laws are in braid.h (geometry), body.h, bladder.h, pull.h, series.h, tension.h, loss.h,
// hysteresis.h, creep.h and stiffness.h. Everything is SI; pressure is absolute unless a
// name says gauge. Sources: Colbrunn (2000), equation numbers in brackets.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace sinew::actuator {

// [1]-[4]: threads of a fixed length that wind around a cylinder.
struct Braid {
  double thread_length = 0;  // b [m]
  double turns = 0;          // n [-] of one thread
};

// [30]: share of the ideal tension that arrives, a polynomial of the pressure.
struct Effectiveness {
  enum class Argument { gauge, absolute };  // the text has gauge, appendix A absolute
  double c0 = 1, c1 = 0, c2 = 0;            // [1], [1/Pa], [1/Pa^2]
  double scale = 1;                         // Eff_s, times the polynomial [-]
  Argument argument = Argument::gauge;
  double valid_from = 0, valid_to = 7.6e5;  // gauge pressures that were fitted [Pa]
  double threshold = 0;  // gauge pressure that the bladder needs to reach the mesh [Pa]
};

// [32], [35]: beyond `length` the threads themselves stretch.
struct LongEnd {
  double length = 0;     // L_max [m]
  double stiffness = 0;  // K_braid [N/m]
  double damping = 0;    // C_braid [N s/m]
};

// [31] below the shortest length b/sqrt 3. As printed the tension is zero there, so that nothing
// holds a load that has gone past it; `stop` is an end stop that pushes back, `empirical` the line
// that appendix A has commented out, "empirical guesses that match data".
struct ShortEnd {
  // Which force holds a length below the shortest one.
  enum class Law { stop, zero, empirical };
  Law law = Law::stop;
  double stiffness = 0;  // [N/m]
  double damping = 0;    // [N s/m]
};

// [33], [34]: viscous loss, and dry friction between bladder and mesh of at most Q times a
// stiffness.
struct Loss {
  // Which stiffness the dry friction is Q times of.
  enum class Scale { secant, sealed, constant };
  double viscous = 0;         // c [N s/m]
  double coulomb_length = 0;  // Q [m]
  Scale coulomb_scale = Scale::secant;
  double coulomb_stiffness = 0;  // the stiffness for Scale::constant [N/m]
  bool stick = true;             // false: sign(v) as printed
};

// The bladder as a spring of its own; not in the thesis, see bladder.h.
struct Bladder {
  double stiffness = 0;                   // k_1 [N/m]
  double rest_length = 0;                 // L_r [m]
  double quadratic = 0, cubic = 0;        // k_2, k_3 [N/m2] [N/m3]
  double saturating_tension = 0;          // S [N]
  double saturation_length = 0;           // lambda [m]
  double valid_from = 0, valid_to = 1e3;  // lengths that were fitted [m]
};

// Of the length what does not contract, at both ends together; see body.h.
struct Caps {
  double length = 0;  // d [m]
};

// Ends that taper, as a larger contraction; see body.h.
struct Taper {
  double gain = 1;            // kappa_0 [-]
  double extra_gain = 0;      // kappa_low, without pressure [-]
  double extra_pressure = 0;  // P_low, over which it goes [Pa]
  double rest_length = 0;     // L_0 [m]
};

// Of the tube; see body.h.
struct Wall {
  double thickness = 0;  // h_w [m]
};

// Friction of the mesh as a pressure that is missing while it rises; not in the thesis, see
// hysteresis.h.
struct Hysteresis {
  double half_width = 0;             // w_0 [Pa]
  double width_per_pressure = 0;     // w_P [-], below 1
  double width_per_contraction = 0;  // w_eps [Pa], contraction counted from L_max
  double volume_pressure = 0;        // P_V [Pa]: pressure that turns it as the greatest volume does
};

// Tension that comes late; not in the thesis, see creep.h.
struct Creep {
  static constexpr int most = 2;     // elements
  std::array<double, most> share{};  // chi_i [-]; 0: no such element
  std::array<double, most> time{};   // t_i [s]
};

// Holds the air that a muscle has in addition to that of its braid; not in the thesis, see body.h.
struct AirVolume {
  double offset = 0;  // V_a [m3], below 0: a thick wall or an insert takes it
};

// What gives way between a muscle's clamps and its braid; not in the thesis, see series.h.
struct Series {
  double compliance = 0;  // C_s [m/N]
};

// Softens where a slack muscle begins to pull; not in the thesis, see series.h.
struct Toe {
  double tension = 0;  // F_toe [N], 0: it begins at once
};

// How far a measured force lies from the law's, as an identification left it in the actuator's
// file; no part of any law, see prediction.h. 0: not known.
struct Prediction {
  double rest_length = 0;                 // L_0 of the muscle [m]
  std::vector<double> lengths;            // that were measured, in ascending order [m]
  double lowest = 0, highest = 0;         // gauge pressures that were measured [Pa]
  double inside_68 = 0, inside_95 = 0;    // half-widths at these lengths, between the pressures [N]
  double between_68 = 0, between_95 = 0;  // halfway in the widest gap between two lengths [N]
  double beyond_68 = 0, beyond_95 = 0;    // a fifth of the range beyond the lengths [N]
  double above_68 = 0, above_95 = 0;      // a fifth of the range beyond the pressures [N]
  double other_68 = 0, other_95 = 0;      // of muscles of other rest lengths, of the force [-]
  double other_reach = 0;                 // |ln(L/L_0)| over which that was tried [-]
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
  Prediction prediction;
};

}  // namespace sinew::actuator
