// The leg's body without muscles, on the table.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "bench/peers/experiments.h"
#include "bench/peers/mujoco_leg.h"
#include "bench/peers/pair.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/world/batch.h"
#include "sinew/world/machine.h"

namespace sinew::bench {

namespace {

constexpr int milliseconds = 1000;  // of one fall

// Setup with preloaded springs at the joints. The leg falls on the table and pushes the trolley
// until all motion has decayed: 0.1 s in the air, then sliding and sticking.
plant::Setup springy(double step) {
  plant::Setup s = run::planar_setup(walk());
  s.muscles.clear();
  s.robot.muscles.clear();
  s.robot.sensors.clear();
  s.steps.body = step;
  constexpr double stiffness = 6.0;      // [N m/rad]
  const double wound[] = {-0.35, 0.25};  // [rad]
  for (std::size_t j = 0; j < 2; ++j) {
    robot::Joint& joint = s.robot.joints[j];
    joint.spring = stiffness;
    joint.spring_angle = s.start.joint_angle[j] + wound[j];
  }
  s.start.joint_angle[0] += 0.1;  // off the table
  return s;
}

// Our leg, repeatedly from the same start.
class OurLeg {
 public:
  explicit OurLeg(double step) : world_(springy(step)), start_(world_.state()) {}

  double fall() {
    world_.restore(start_);
    for (int ms = 1; ms <= milliseconds; ++ms) world_.advance(1e-3 * ms);
    return milliseconds;
  }
  // Appends the trolley's position at the end of each millisecond [m]; returns the share of
  // milliseconds with contact.
  double trace(std::vector<double>& x) {
    world_.restore(start_);
    int on_table = 0;
    for (int ms = 1; ms <= milliseconds; ++ms) {
      const plant::Truth t = world_.truth(1e-3 * ms);
      x.push_back(t.x);
      on_table += t.foot[0].force_y > 0;
    }
    return 1.0 * on_table / milliseconds;
  }

 private:
  plant::ChainWorld<2> world_;
  const plant::ChainWorld<2>::State start_;
};

// Our leg in as many lanes as the processor has.
class OurLegs {
 public:
  OurLegs() : setup_(springy(1e-3)), batch_(plant::Batch::widest(), setup_) {}

  double fall() {
    const int width = batch_.width();
    for (int k = 0; k < width; ++k) batch_.replace(k, setup_);
    std::array<bool, 8> begun{};
    auto turn = [&](int k) noexcept {
      bool& b = begun[static_cast<std::size_t>(k)];
      const double to = b ? plant::Batch::finished : 1e-3 * milliseconds;
      b = true;
      return to;
    };
    while (batch_.run(turn) >= 0) {}
    return 1.0 * milliseconds * width;
  }

 private:
  plant::Setup setup_;
  plant::Batch batch_;
};

class TheirLeg {
 public:
  TheirLeg(int ticks, Integrator integrator)
      : per_ms_(10 / ticks),
        leg_(springy(1e-3), {.body = ticks}, integrator),
        start_(leg_.motion()) {}

  double fall() {
    leg_.place(start_);
    for (int n = 0; n < milliseconds * per_ms_; ++n) leg_.step_body();
    return milliseconds * per_ms_;
  }
  double trace(std::vector<double>& x) {
    leg_.place(start_);
    int on_table = 0;
    for (int ms = 0; ms < milliseconds; ++ms) {
      for (int n = 0; n < per_ms_; ++n) leg_.step_body();
      x.push_back(leg_.motion().x);
      on_table += leg_.touches();
    }
    return 1.0 * on_table / milliseconds;
  }

 private:
  int per_ms_;
  MujocoLeg leg_;
  LegMotion start_;
};

// Adds the largest difference of the trolley's position in two falls, its final position, and the
// share of steps with contact.
template <class Leg>
void judge(const std::string& of, Leg&& coarse, Leg&& fine, std::map<std::string, double>& out) {
  std::vector<double> a, b;
  out[of + "_on_table"] = coarse.trace(a);
  fine.trace(b);
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  out[of + "_error_mm"] = 1e3 * most;
  out[of + "_rest_mm"] = 1e3 * a.back();
}

// Compares several falls of both, for some 10 ms per repetition, by the step of 1 ms.
template <class Ours>
Pair falls(const std::shared_ptr<Ours>& ours, Integrator integrator, const std::string& label) {
  const auto theirs = std::make_shared<TheirLeg>(10, integrator);
  const auto several = [](auto& leg, int times) {
    double steps = 0;
    for (int i = 0; i < times; ++i) steps += leg.fall();
    return steps;
  };
  return {.ours = [=] { return several(*ours, 20); },
          .theirs = [=] { return several(*theirs, 2); },
          .label = label};
}

Pair against_mujoco(Integrator integrator, const std::string& label) {
  Pair pair = falls(std::make_shared<OurLeg>(1e-3), integrator, label);
  judge("our", OurLeg(1e-3), OurLeg(1e-4), pair.figures);
  judge("their", TheirLeg(10, integrator), TheirLeg(1, integrator), pair.figures);
  return pair;
}

const Registration rows([] {
  compare("body/mujoco", [] {
    return against_mujoco(Integrator::euler,
                          "a step of 1 ms of the leg without muscles in contact with the table, "
                          "ours by RK4, against MuJoCo's Euler step");
  });
  // The lanes have the same bits as the single leg, so their accuracy is that of the first row.
  compare("body/mujoco-lanes", [] {
    return falls(std::make_shared<OurLegs>(), Integrator::euler,
                 "the same, ours in the processor's lanes");
  });
  compare("body/mujoco-rk4",
          [] { return against_mujoco(Integrator::rk4, "the first, against MuJoCo's RK4 step"); });
});

}  // namespace

}  // namespace sinew::bench
