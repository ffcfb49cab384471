#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>

#include "bench/peers/stand_events.h"

namespace sinew::bench {

namespace {

// odeint has one tolerance for all variables, so they are scaled to the same size.
class Odeint {
 public:
  explicit Odeint(double tolerance)
      : stepper_(boost::numeric::odeint::make_dense_output(
            tolerance, tolerance, boost::numeric::odeint::runge_kutta_dopri5<StandState>())) {}

  void restart(double t, const StandState& x, int side, int valve) {
    side_ = side;
    valve_ = valve;
    StandState scaled;
    for (std::size_t i = 0; i < 4; ++i) scaled[i] = x[i] / scale_of_state[i];
    stepper_.initialize(scaled, t, 1e-4);
  }
  double one_step(double) {
    return stepper_
        .do_step([this](const StandState& s, StandState& rates, double) {
          double x[4];
          for (std::size_t i = 0; i < 4; ++i) x[i] = s[i] * scale_of_state[i];
          appendix_a_rates(valve_, side_, x, rates.data());
          for (std::size_t i = 0; i < 4; ++i) rates[i] /= scale_of_state[i];
        })
        .second;
  }
  StandState state_at(double t) const {
    StandState x;
    stepper_.calc_state(t, x);
    for (std::size_t i = 0; i < 4; ++i) x[i] *= scale_of_state[i];
    return x;
  }

 private:
  boost::numeric::odeint::result_of::make_dense_output<
      boost::numeric::odeint::runge_kutta_dopri5<StandState>>::type stepper_;
  int side_ = 0, valve_ = 1;
};

void simulate(double tolerance, int every, Lengths& lengths) {
  Odeint stepper(tolerance);
  StandRun().go(stepper, every, lengths);
}

}  // namespace

StandPeer odeint_stand() {
  return {"odeint",
          std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000),
          simulate};
}

}  // namespace sinew::bench
