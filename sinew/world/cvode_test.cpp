// The stand against SUNDIALS CVODE: [37], [40] with length, velocity and pressure as states, the
// laws implemented independently from the thesis, restarted at every edge of the valve and wherever
// the load reverses, stops or starts to move.
#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sinew/world/stand.h"
#include "sinew/world/test_stands.h"

namespace sinew::plant::cvode_test {
namespace {

constexpr double pi = std::numbers::pi, gamma_air = 1.4;

// One valve state: 0 shut, 1 to the supply, 2 to the room.
struct Stretch {
  double until = 0;
  int valve = 0;
};

class Reference {
 public:
  Reference(const StandSetup& setup, double length, double pressure) : setup_(setup) {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(3, context_);
    x(0) = length, x(1) = 0, x(2) = pressure;
    matrix_ = SUNDenseMatrix(3, 3, context_);
    solver_ = SUNLinSol_Dense(state_, matrix_, context_);
  }
  ~Reference() {
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  // Integrates to the end of the stretch and calls see(t, length) at every multiple of `every`.
  template <class See>
  void go(const Stretch& stretch, double every, See see) {
    valve_ = stretch.valve;
    while (t_ < stretch.until) {
      settle();
      restart();
      while (t_ < stretch.until) {
        const double sample = every * (std::floor(t_ / every + 1e-9) + 1);
        const double to = sample < stretch.until ? sample : stretch.until;
        CVodeSetStopTime(memory_, stretch.until);
        const int got = CVode(memory_, to, state_, &t_, CV_NORMAL);
        ASSERT_GE(got, 0);
        loose_ = got == CV_ROOT_RETURN && side_ == 0;
        if (got == CV_ROOT_RETURN) break;
        if (t_ >= to) t_ = to;
        if (to == sample) see(t_, x(0));
      }
      CVodeFree(&memory_);
    }
  }

 private:
  double& x(int i) { return NV_Ith_S(state_, i); }

  double volume(double l) const {
    const double b = setup_.muscle.actuator.braid.thread_length;
    const double n = setup_.muscle.actuator.braid.turns;
    return l * (b * b - l * l) / (4 * pi * n * n) + setup_.muscle.external_volume;
  }
  double volume_slope(double l) const {
    const double b = setup_.muscle.actuator.braid.thread_length;
    const double n = setup_.muscle.actuator.braid.turns;
    return (b * b - 3 * l * l) / (4 * pi * n * n);
  }
  // [31] without damping, [33] dry, [32].
  double pull(double l, double p) const {
    const auto& a = setup_.muscle.actuator;
    const double b = a.braid.thread_length, n = a.braid.turns;
    const double gauge = (p - setup_.air.atmosphere) / psi;
    const double share = 0.9969 + 0.0005 * gauge - 0.00002 * gauge * gauge;
    return gauge * psi * b * b / (4 * pi * n * n) * (3 * l * l / (b * b) - 1) * share;
  }
  double dry(double l, double p) const {
    const auto& a = setup_.muscle.actuator;
    return a.loss.coulomb_length * pull(l, p) / (l - a.braid.thread_length / std::sqrt(3.0));
  }
  double weight() const { return setup_.load.mass.at(0) * setup_.load.gravity; }
  double asks(double l, double p) const { return weight() - pull(l, p); }

  // [42]-[44].
  double flow(double up, double down) const {
    const double r = setup_.air.gas_constant, ratio = down / up;
    const auto& f = setup_.muscle.inlet.flow;
    const double choked =
        std::sqrt(gamma_air / r * std::pow(2 / (gamma_air + 1), (gamma_air + 1) / (gamma_air - 1)));
    const double free =
        std::sqrt(2 * gamma_air / (r * (gamma_air - 1)) *
                  (std::pow(ratio, 2 / gamma_air) - std::pow(ratio, (gamma_air + 1) / gamma_air)));
    const double limit = std::pow(2 / (gamma_air + 1), gamma_air / (gamma_air - 1));
    return f.area * f.efficiency * up / std::sqrt(setup_.air.temperature) *
           (ratio <= limit ? choked : free);
  }

  // Mass by [40]: all air is on the adiabat through the room's.
  double mass(double l, double p) const {
    const double room = setup_.air.atmosphere;
    return room / (setup_.air.gas_constant * setup_.air.temperature) *
           std::pow(p / room, 1 / gamma_air) * volume(l);
  }

  void slope(const double* s, double* out) const {
    const double l = s[0], v = side_ == 0 ? 0.0 : s[1], p = s[2];
    const double force = pull(l, p) + setup_.muscle.actuator.loss.viscous * v + side_ * dry(l, p);
    double in = 0;
    if (valve_ == 1) in = flow(setup_.supply.pressure, p);
    if (valve_ == 2) in = -flow(p, setup_.air.atmosphere);
    out[0] = v;
    out[1] = side_ == 0 ? 0.0 : (weight() - force) / setup_.load.mass.at(0);
    out[2] = gamma_air * p * (in / mass(l, p) - volume_slope(l) * v / volume(l));
  }

  // Reversed or at rest: the next side follows from the remaining force.
  void settle() {
    if (side_ != 0 && x(1) * side_ > 1e-9) return;
    x(1) = 0;
    const double wanted = asks(x(0), x(2)), bound = dry(x(0), x(2));
    side_ = 0;
    if (loose_ || std::fabs(wanted) > bound) side_ = wanted > 0 ? 1 : -1;
    loose_ = false;
  }

  static int right(double, N_Vector s, N_Vector out, void* self) {
    static_cast<const Reference*>(self)->slope(NV_DATA_S(s), NV_DATA_S(out));
    return 0;
  }
  // In motion the velocity; at rest the margin to the bound.
  static int event(double, N_Vector s, double* out, void* self) {
    const auto& r = *static_cast<const Reference*>(self);
    const double *y = NV_DATA_S(s), l = y[0], p = y[2];
    out[0] = r.side_ != 0 ? y[1] : r.dry(l, p) - std::fabs(r.asks(l, p));
    return 0;
  }

  void restart() {
    memory_ = CVodeCreate(CV_BDF, context_);
    CVodeInit(memory_, right, t_, state_);
    CVodeSStolerances(memory_, 1e-11, 1e-13);
    CVodeSetUserData(memory_, this);
    CVodeSetLinearSolver(memory_, solver_, matrix_);
    CVodeSetMaxNumSteps(memory_, 1000000);
    CVodeSetMaxStep(memory_, 1e-3);
    CVodeRootInit(memory_, 1, event);
  }

  const StandSetup& setup_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* memory_ = nullptr;
  double t_ = 0;
  int valve_ = 0, side_ = 0;
  bool loose_ = false;  // the bound was just reached
};

// Trapped air: agreement within 1e-6 in during the oscillation and after.
TEST(Cvode, AgreesOnTrappedAir) {
  for (const auto& [gauge, load] : {std::pair{60, 6}, {80, 11}, {60, 11}}) {
    const StandSetup s = trapped(gauge, load);
    Stand stand(s);
    const StandTruth at_start = stand.truth(0);
    Reference reference(s, at_start.length, at_start.pressure);
    double worst = 0;
    reference.go({3.0, 0}, 1e-3, [&](double t, double length) {
      worst = std::max(worst, std::fabs(stand.truth(t).length - length));
    });
    EXPECT_LT(worst / inch, 1e-6) << gauge << " psi " << load << " lb";
    EXPECT_TRUE(stand.truth(3.0).sticks);
  }
}

// A pulsed valve: the same during the transient and fifty periods.
TEST(Cvode, AgreesOnPulsedValves) {
  struct Case {
    double load, frequency, open;
  };
  for (const Case& c : {Case{5, 50, 0.007}, {5, 40, 0.0105}}) {
    StandSetup s = pulsed(c.load);
    s.muscle.inlet.flow.linear_below = 1e-9;
    s.start = {.pressure = s.air.atmosphere + 40 * psi};  // equilibrium, short of both ends
    Stand stand(s);
    Reference reference(s, stand.truth(0).length, s.start.pressure);
    double worst = 0;
    const auto see = [&](double t, double length) {
      worst = std::max(worst, std::fabs(stand.truth(t).length - length));
    };
    for (int k = 0; k < 50; ++k) {
      const double begin = k / c.frequency, shut = begin + c.open, end = (k + 1) / c.frequency;
      const auto tick = [](double t) { return static_cast<signals::Tick>(std::lround(1e4 * t)); };
      stand.drive({.at = tick(begin), .open = true});
      reference.go({shut, 1}, 1e-3, see);
      stand.drive({.at = tick(shut), .open = false});
      reference.go({end, 2}, 1e-3, see);
    }
    EXPECT_GT(std::fabs(stand.truth(1).length - hanging_length(s)) / inch, 1e-3);
    EXPECT_LT(worst / inch, 1e-6) << c.load << " lb " << c.frequency << " Hz";
  }
}

}  // namespace
}  // namespace sinew::plant::cvode_test
