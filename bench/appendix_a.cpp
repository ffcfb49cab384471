#include "bench/appendix_a.h"

#include <array>
#include <cmath>

namespace sinew::bench {
namespace {

constexpr double L_trap = 37.;                // number of lengthwise trapezoids on actuator
constexpr double C_trap = 16.;                // number of circumferential trapezoids on actuator
constexpr double Trap_size = 0.057;           // length of trapezoid side (in)
constexpr double VIS_DAMP_CONST = .02;        // viscous damping constant
constexpr double COULOMB_DAMP_CONST = .0045;  // pressure proportional Coulomb damping constant
constexpr double MESH_STIFFNESS = 500;        // mesh stiffness
constexpr double MESH_DAMPING = .7;           //
constexpr double EXT_VOL = 0.495;             // volume downstream of valve (in^3)
constexpr double VALVE_EFF = .85;             // valve efficiency
constexpr double Supply_p = 112.7;            // supply pressure (psia)
constexpr double GAS_CONST = 1.4;             // gas constant for air
constexpr double DENSITY = 0.000001349;       // density of air at standard conditions (slug/in^3)
constexpr double MASS = 5. / 386.088;         // deadweight applied mass (slugs)
constexpr double g = 386.088;                 // gravitational constant (in/s^2)
constexpr double PI = 3.14159265;
constexpr int eqn_order = 4;

int valve_state = 0;
double h, h2, h3, h6;
double x_mid1[4], x_mid2[4], x_end[4];
double xdot_init[4], xdot_mid1[4], xdot_mid2[4], xdot_end[4];
double B, N, length_min;

void pressures(const double* x, double* xdot) {
  double flowrate, highp = 0, lowp = 0;
  int flowdir = 0;
  double act_vol, vol[2];
  act_vol = x[0] / (4. * PI * N * N) * (B * B - x[0] * x[0]);
  if (x[0] >= B) act_vol = 0.;
  vol[0] = act_vol + EXT_VOL;
  vol[1] = x[1] * (std::pow(Trap_size * C_trap, 2.) / PI - 3. / (4. * PI * N * N) * x[0] * x[0]);
  switch (valve_state) {
    case 0:  // cylinder chamber sealed
      flowdir = 0;
      break;
    case 1:  // open to supply
      if (Supply_p >= x[2]) {
        highp = Supply_p;
        lowp = x[2];
        flowdir = 1;
      } else {
        lowp = Supply_p;
        highp = x[2];
        flowdir = -1;
      }
      break;
    case 2:  // open to atmosphere
      if (x[2] >= 14.7) {
        lowp = 14.7;
        highp = x[2];
        flowdir = -1;
      } else {
        highp = 14.7;
        lowp = x[2];
        flowdir = 1;
      }
      break;
  }
  if (flowdir) {
    if (highp >= (1.89 * lowp))  // choked
      flowrate = flowdir * 83.66 * 0.0165 * highp * VALVE_EFF;
    else  // not choked
      flowrate = flowdir * 83.66 * 0.064 * highp * VALVE_EFF *
                 std::sqrt(std::pow(lowp / highp, 2. / 1.4) - std::pow(lowp / highp, 2.4 / 1.4));
  } else {
    flowrate = 0.0;
  }
  xdot[2] = x[2] * GAS_CONST * ((flowrate * DENSITY) / x[3] - vol[1] / vol[0]);
  xdot[3] = flowrate * DENSITY;
}

void fnc_xdot(const double* x, double* xdot, int sign) {
  double fact, fact_damping, fext, act_eff;
  act_eff = -0.00002 * x[2] * x[2] + 0.0005 * x[2] + 0.9969;
  fact = PI / 4. * std::pow(B / (N * PI), 2.) * std::fabs(x[2] - 14.7) *
         ((3 * x[0] * x[0]) / (B * B) - 1) * act_eff;
  fact_damping = x[1] * VIS_DAMP_CONST + COULOMB_DAMP_CONST * fact / (x[0] - length_min) * sign;
  fact = fact + fact_damping;
  if (x[0] > (B - 0.3)) fact = fact + (MESH_STIFFNESS * (x[0] - (B - 0.3))) + MESH_DAMPING * x[1];
  if (x[0] < length_min) fact = 0.0;
  fext = 0.0;
  xdot[0] = x[1];
  xdot[1] = g - (fact - fext) / MASS;
  pressures(x, xdot);
}

void fnc_xdot(const double* x, double* xdot) {
  int sign;
  if (x[1] >= 0.0)
    sign = 1;
  else
    sign = -1;
  fnc_xdot(x, xdot, sign);
}

void rk4(const double* x_in, double* t_ptr, double* x_out) {
  int i;
  *t_ptr += h;
  fnc_xdot(x_in, xdot_init);
  for (i = 0; i < eqn_order; i++) x_mid1[i] = x_in[i] + h2 * xdot_init[i];
  fnc_xdot(x_mid1, xdot_mid1);
  for (i = 0; i < eqn_order; i++) x_mid2[i] = x_in[i] + h2 * xdot_mid1[i];
  fnc_xdot(x_mid2, xdot_mid2);
  for (i = 0; i < eqn_order; i++) x_end[i] = x_in[i] + h * xdot_mid2[i];
  fnc_xdot(x_end, xdot_end);
  for (i = 0; i < eqn_order; i++)
    x_out[i] = x_in[i] + h6 * (xdot_init[i] + xdot_end[i]) + h3 * (xdot_mid1[i] + xdot_mid2[i]);
}

void set_mesh() {
  B = 2 * L_trap * Trap_size;
  N = L_trap / C_trap;
  length_min = std::sqrt(std::pow(2 * Trap_size * L_trap, 2.) / 3);
}

}  // namespace

void appendix_a(int steps_per_ms, double* length) {
  int j, k = 0;
  double t = 0.0;
  std::array<double, 4> start = appendix_a_start();
  double* x = start.data();  // (in, in/s, psia, slugs)
  h = 0.001 / steps_per_ms;
  h2 = h / 2.0;
  h3 = h / 3.0;
  h6 = h / 6.0;
  j = 16;
  for (int i = 0; i < appendix_a_milliseconds; i++) {
    if (k >= 40) k = 0;
    if (k < j)
      valve_state = 1;
    else
      valve_state = 2;
    for (int n = 0; n < steps_per_ms; n++) rk4(x, &t, x);
    k++;
    length[i] = x[0];
  }
}

std::array<double, 4> appendix_a_start() {
  set_mesh();
  std::array<double, 4> x = {3.4, 0.0, 14.7, 0.0};
  const double vol_initial = x[0] / (4. * PI * N * N) * (B * B - x[0] * x[0]) + EXT_VOL;
  x[3] = vol_initial * DENSITY * std::pow(x[2] / 14.7, (1. / GAS_CONST));
  return x;
}

void appendix_a_rates(int valve, int side, const double* x, double* rates) {
  valve_state = valve;
  if (side == 0) {
    const double at_rest[4] = {x[0], 0.0, x[2], x[3]};
    fnc_xdot(at_rest, rates, 0);
    rates[0] = rates[1] = 0;
    return;
  }
  fnc_xdot(x, rates, side);
}

AppendixFriction appendix_a_friction(const double* x) {
  double without[4], with[4];
  const double at_rest[4] = {x[0], 0.0, x[2], x[3]};
  fnc_xdot(at_rest, without, 0);
  fnc_xdot(at_rest, with, 1);
  return {.bound = (without[1] - with[1]) * MASS, .unbalanced = without[1] * MASS};
}

}  // namespace sinew::bench
