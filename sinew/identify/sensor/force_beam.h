// identify/sensor/force_beam.h - cantilever with strain gages as a force transducer, with its
// bridge and amplifier.
//
//   |<------- l_beam ------->|       F    load at the free end  [N]
//   F   x_g -> gages    mount ]      x_g  from the load to the middle of the gages
//
//   sigma_b  F x_g/(w h^2/6)              stress at the surface, w_beam wide and h_beam high  [Pa]
//   eps_g    sigma_b/E                    strain under the gages  [-]
//   y_b      F l_beam^3/(3 E w h^3/12)    deflection of the load  [m]
//   V_out    G_amp V_ex k_gage f_B eps_g  after the amplifier: its gain, gage and bridge factor
//
// Source: Colbrunn 4.4, which prints dimensions and results; the equations are the elastic
// theory of slender beams. Bridge factors f_B for gages in bending, with Poisson's ratio nu:
//
//   quarter  1/4          one gage along the beam (slightly nonlinear: 1 % at 10000e-6)
//   half     1/2          one above, one below
//   poisson  (1 + nu)/2   above and below one along and one across
//   bending  1            two above, two below
//
// Valid below the yield stress, for l_beam >= 5 h_beam. Departures: the flange's notch (radius
// 0.063 in in the thesis, from finite elements) is one factor on the stress at the mount; gages
// measure the strain at their middle; temperature and lead resistance are neglected.
#pragma once

#include <string>
#include <vector>

namespace sinew::identify {

struct ForceBeam {
  double length = 0;         // l_beam, from the load to the mount [m]
  double width = 0;          // [m]
  double height = 0;         // in the direction of the load [m]
  double gage_distance = 0;  // x_g [m]
  double modulus = 0;        // E [Pa]
  double poisson_ratio = 0;
  double yield_stress = 0;          // [Pa]
  double stress_concentration = 1;  // at the mount
};

// Strain gages on a beam, and their amplifier.
struct Bridge {
  // Number and position of the gages: see the table at the head of this file.
  enum class Arms { quarter, half, poisson, bending };

  Arms arms = Arms::poisson;
  double gage_factor = 2;
  double excitation = 0;  // [V]
  double gain = 1;        // gain of the amplifier
};

double bending_stress(const ForceBeam& beam, double load, double distance);  // [Pa]
// Returns the strain under the gages [-].
double gage_strain(const ForceBeam& beam, double load);
double mount_stress(const ForceBeam& beam, double load);  // including the concentration [Pa]
double yield_load(const ForceBeam& beam);                 // [N]
// Returns the ratio of the yield load to this load [-].
double factor_of_safety(const ForceBeam& beam, double load);
double deflection(const ForceBeam& beam, double load);  // [m]

// Returns f_B by the table at the head of this file [-].
double bridge_factor(Bridge::Arms arms, double poisson_ratio);
// Returns the output before the amplifier [V].
double bridge_output(const ForceBeam& beam, const Bridge& bridge, double load);
// Returns the sensitivity after the amplifier [V/N].
double sensitivity(const ForceBeam& beam, const Bridge& bridge);
// Returns the gage distance that gives the sensitivity [m]; beyond the mount if that is impossible.
double gage_distance_for(const ForceBeam& beam, const Bridge& bridge, double wanted_sensitivity);

// --- a force beam with its bridge and converter ---

// A force beam with its bridge, its amplifier and the converter.
struct Transducer {
  ForceBeam beam;
  Bridge bridge;
  double load = 0;        // load at which it is evaluated [N]
  double full_scale = 0;  // full scale of the converter [V]
  int bits = 12;
};

// State of the transducer under its load.
struct TransducerPoint {
  double strain = 0, stress = 0;  // at the gages, and at the mount [Pa]
  double factor_of_safety = 0;
  double yield_load = 0, deflection = 0;  // [N], [m]
  double bridge_output = 0, output = 0;   // before and after the amplifier [V]
  double sensitivity = 0;                 // [V/N]
  double counts_per_newton = 0;           // [count/N]
  double clip_load = 0;                   // load at the converter's limit [N]
};

// Returns the state of beam, bridge and converter under the load.
TransducerPoint evaluate(const Transducer& t);

// Returns doubts about the design under the load, in words: the beam yields, is not slender, or the
// converter clips.
std::vector<std::string> doubts(const Transducer& t);

}  // namespace sinew::identify
