// Damping from turns: chapter 3's numbers, closed forms of linear decays, and unusable records.
#include "sinew/identify/motion/decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "sinew/identify/contest/refusal.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::identify::decay_test {
namespace {

using units::inch;
constexpr double pi = std::numbers::pi;

// M x'' + c x' + k x = -+ k Q from rest at `first`, half period by half period in closed form.
struct Linear {
  double decrement = 0.05;  // of half a period, -ln s
  double coulomb_length = 1e-4, first = 5e-3, center = 0.08, period = 0.2;

  double at(double t) const {
    if (t < 0) return center + first;
    const double half = period / 2, w = pi / half, decay = decrement / half;
    double amplitude = first, side = 1;
    for (; t > half; t -= half) {
      if (amplitude <= coulomb_length) return center + side * amplitude;
      amplitude = std::exp(-decrement) * amplitude - coulomb_length * (1 + std::exp(-decrement));
      side = -side;
    }
    if (amplitude <= coulomb_length) return center + side * amplitude;
    const double wave = std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    return center + side * (coulomb_length + (amplitude - coulomb_length) * wave);
  }
};

struct Samples {
  std::vector<double> time, value;
};

Samples sampled(const Linear& truth, double noise = 0, unsigned seed = 1, double from = 0,
                double to = 3, double step = 0.004) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Samples out;
  for (double t = from; t < to; t += step) {
    out.time.push_back(t);
    out.value.push_back(truth.at(t) + noise * normal(random));
  }
  return out;
}

Oscillation turns_of(const Samples& s) { return find_turns(s.time, s.value, "decay.csv: length"); }

std::string refused(const Samples& s) {
  try {
    turns_of(s);
  } catch (const Refusal& e) {
    return e.what();
  }
  return "not refused";
}

TEST(TwoPoint, AsPrintedItGivesChapter3sConstants) {
  const auto data = nlohmann::json::parse(
      std::ifstream(sinew::test::source_dir() + "/data/reference.json"))["verification_summary"];
  const std::pair<const char*, double> tests[] = {
      {"A 60psi 6lb", 6}, {"B 80psi 11lb", 11}, {"C 60psi 11lb", 11}};
  for (const auto& [name, pounds] : tests)
    for (const char* variant : {"thesis_1ms", "code_conv", "equations"}) {
      const auto& r = data[name][variant];
      const auto number = [&](const char* key) { return r[key].get<double>(); };
      const Damping d = two_point(number("X1") * inch, number("dx1") * inch, number("X3") * inch,
                                  number("dx3") * inch, pounds * units::pound_mass,
                                  1e-3 * number("Td_mean_ms"), DecayForm::printed);
      EXPECT_NEAR(d.coulomb_length / inch, number("ident_Q_in"), 1e-12) << name << variant;
      // [52] uses the period of the first swings there.
      const double c = d.viscous / (units::pound_force / inch);
      EXPECT_NEAR(c, number("ident_c"), 3e-4 * c) << name << variant;
      EXPECT_NEAR(d.ratio, number("zeta_eq1"), 1e-12) << name << variant;
    }
}

// Amplitudes that decrease by 4 Q per period: both forms agree.
TEST(TwoPoint, DryFrictionAloneTakesFourQPerPeriod) {
  const double q = 1.3e-4, x1 = 5e-3, x2 = x1 - 12 * q;
  for (const DecayForm form : {DecayForm::printed, DecayForm::exact}) {
    const Damping d = two_point(x1, 4 * q, x2, 4 * q, 3, 0.2, form);
    EXPECT_NEAR(d.coulomb_length, q, 1e-15);
    EXPECT_NEAR(d.viscous, 0, 1e-12);
  }
}

TEST(TwoPoint, ViscousDampingAloneLeavesAConstantShare) {
  const double zeta = 0.04, kept = std::exp(-2 * pi * zeta / std::sqrt(1 - zeta * zeta));
  const double x1 = 5e-3, x2 = x1 * std::pow(kept, 3), mass = 3, period = 0.2;
  for (const DecayForm form : {DecayForm::printed, DecayForm::exact}) {
    const Damping d = two_point(x1, x1 * (1 - kept), x2, x2 * (1 - kept), mass, period, form);
    EXPECT_NEAR(d.coulomb_length, 0, 1e-15);
    EXPECT_NEAR(d.viscous, -2 * mass / period * std::log(kept), 1e-9);
    if (form == DecayForm::exact) {
      EXPECT_NEAR(d.ratio, zeta, 1e-12);
    }
  }
}

// Value of the errata: [49] is low by (1 + sqrt b)^2/4.
TEST(TwoPoint, ThePrintedFormHasQATenthLowAtChapter3sDamping) {
  const double zeta = 0.035, s = std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta)), q = 1.1e-4;
  const auto next = [&](double a) { return s * (s * a - q * (1 + s)) - q * (1 + s); };
  const double x1 = 5e-3, x2 = next(next(x1));
  const auto found = [&](DecayForm form) {
    return two_point(x1, x1 - next(x1), x2, x2 - next(x2), 3, 0.2, form).coulomb_length;
  };
  EXPECT_NEAR(found(DecayForm::exact), q, 1e-15);
  EXPECT_NEAR(found(DecayForm::printed) / q, 0.25 * (1 + s) * (1 + s), 1e-9);
  EXPECT_NEAR(found(DecayForm::printed) / q, 0.90, 0.01);
}

// The whole chain with three decrements: samples, turns, damping.
TEST(Decay, TurnsOfCleanRecordsGiveBothConstantsBack) {
  for (const double decrement : {0.0, 0.02, 0.1})
    for (const double q : {0.0, 5e-5, 1.5e-4}) {
      if (decrement == 0 && q == 0) continue;
      const Linear truth{.decrement = decrement, .coulomb_length = q};
      const Oscillation o = turns_of(sampled(truth, 0, 1, 0, 6));
      EXPECT_NEAR(o.period, truth.period, 1e-3 * truth.period);
      const DecayFit fit = decay_fit(o, 3);
      EXPECT_NEAR(fit.solution["decrement"].value, decrement, 1e-3) << decrement << " " << q;
      EXPECT_NEAR(fit.damping.coulomb_length, q, 1.5e-6) << decrement << " " << q;
      if (!std::isfinite(o.rest)) continue;
      const TwoPoints p = two_points(o, truth.center, "decay");
      const Damping d = two_point(p.x1, p.dx1, p.x2, p.dx2, 3, o.period, DecayForm::exact);
      EXPECT_NEAR(d.coulomb_length, q, 5e-6) << decrement << " " << q;
    }
}

TEST(Decay, TheTurnsStandWhereTheyShould) {
  const Linear truth;
  const auto amplitude = [&](int k) {
    double a = truth.first;
    const double s = std::exp(-truth.decrement);
    for (; k > 0; --k) a = s * a - truth.coulomb_length * (1 + s);
    return a;
  };
  const double noise = 2e-5;
  for (const double from : {-0.5, 0.0, 0.03}) {  // held first, released, or already moving
    const Oscillation o = turns_of(sampled(truth, noise, 7, from));
    EXPECT_NEAR(o.noise, noise, 0.2 * noise);
    ASSERT_GE(o.turns.size(), 8u);
    const int first = from > 0 ? 1 : 0;  // the record begins after it
    for (int i = 0; i < 8; ++i) {
      const Turn& turn = o.turns[static_cast<std::size_t>(i)];
      const int k = i + first;
      EXPECT_EQ(turn.upper, k % 2 == 0);
      const double side = turn.upper ? 1 : -1;
      EXPECT_NEAR(turn.value, truth.center + side * amplitude(k), 1.5 * noise) << from << " " << k;
      EXPECT_NEAR(turn.time, 0.1 * k, 0.004) << from << " " << k;
    }
    EXPECT_NEAR(o.rest, truth.center, truth.coulomb_length);
  }
}

TEST(Decay, SpikesMakeNoTurns) {
  Samples s = sampled({}, 1e-5, 3);
  const Oscillation clean = turns_of(s);
  for (const std::size_t i : {40u, 133u, 310u, 420u}) s.value[i] += 0.02;
  const Oscillation spiked = turns_of(s);
  ASSERT_EQ(spiked.turns.size(), clean.turns.size());
  for (std::size_t i = 0; i < clean.turns.size(); ++i)
    EXPECT_NEAR(spiked.turns[i].value, clean.turns[i].value, 2e-5);
}

TEST(Decay, IntervalsOfBothConstantsCoverTheTruth) {
  int friction = 0, viscous = 0;
  double bias_friction = 0, bias_viscous = 0;
  const Linear truth;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const DecayFit fit = decay_fit(turns_of(sampled(truth, 5e-5, seed)), 3);
    const Estimate &q = fit.solution["coulomb_length"], &d = fit.solution["decrement"];
    friction += q.low <= truth.coulomb_length && truth.coulomb_length <= q.high;
    viscous += d.low <= truth.decrement && truth.decrement <= d.high;
    bias_friction += (q.value / truth.coulomb_length - 1) / 200;
    bias_viscous += (d.value / truth.decrement - 1) / 200;
  }
  EXPECT_GE(friction, 180);
  EXPECT_GE(viscous, 180);
  EXPECT_LE(friction, 199);
  EXPECT_LE(viscous, 199);
  EXPECT_LT(std::abs(bias_friction), 0.01);
  EXPECT_LT(std::abs(bias_viscous), 0.01);
}

TEST(Decay, RecordsThatCannotBeUsedAreReported) {
  Samples constant = sampled({}, 0);
  for (double& x : constant.value) x = 0.08;
  EXPECT_NE(refused(constant).find("0 turning points; expected at least 5"), std::string::npos)
      << refused(constant);

  const Samples one = sampled({}, 1e-5, 1, 0, 0.17);  // to the first lower turn and back a little
  EXPECT_NE(refused(one).find("turning point"), std::string::npos) << refused(one);

  Samples clipped = sampled({}, 1e-5);
  for (double& x : clipped.value) x = std::min(x, 0.0825);
  EXPECT_NE(refused(clipped).find("samples that stay at 0.0825"), std::string::npos)
      << refused(clipped);

  const Samples slow = sampled({}, 0, 1, 0, 3, 0.02);
  EXPECT_NE(refused(slow).find("samples per period; expected at least 20"), std::string::npos)
      << refused(slow);
}

// Rounding repeats values at every turn, which is not clipping.
TEST(Decay, ACoarseConverterIsNotTakenForAClippedOne) {
  Samples s = sampled({}, 5e-6);
  for (double& x : s.value) x = std::round(x / 2e-5) * 2e-5;
  const Oscillation o = turns_of(s);
  EXPECT_GE(o.turns.size(), 8u);
}

}  // namespace
}  // namespace sinew::identify::decay_test
