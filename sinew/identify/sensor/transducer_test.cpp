// A transducer's values are consistent, and doubts are reported where expected.
#include "sinew/identify/sensor/force_beam.h"

#include <gtest/gtest.h>

namespace sinew::identify::transducer_test {
namespace {

Transducer thesis_transducer() {
  return {.beam = {.length = 0.01905,
                   .width = 0.00762,
                   .height = 0.00381,
                   .gage_distance = 0.009144,
                   .modulus = 6.895e10,
                   .poisson_ratio = 0.33,
                   .yield_stress = 2.758e8},
          .bridge = {.excitation = 5, .gain = 800},
          .load = 60,
          .full_scale = 5};
}

TEST(Transducer, OutputIsSensitivityTimesLoadAndClipsAtFullScale) {
  Transducer t = thesis_transducer();
  for (const double load : {1.0, 20.0, 60.0, 130.0}) {
    t.load = load;
    const TransducerPoint p = evaluate(t);
    EXPECT_NEAR(p.output, p.sensitivity * load, 1e-12 * p.output);
    EXPECT_NEAR(p.bridge_output * t.bridge.gain, p.output, 1e-12 * p.output);
    EXPECT_NEAR(p.clip_load * p.sensitivity, t.full_scale, 1e-12);
    EXPECT_NEAR(p.counts_per_newton * p.clip_load, 4096, 1e-9);
    EXPECT_NEAR(p.factor_of_safety * load, p.yield_load, 1e-9 * p.yield_load);
  }
}

TEST(Transducer, EachDoubtComesWithItsCause) {
  Transducer t = thesis_transducer();
  t.beam.length = 6 * t.beam.height;
  EXPECT_TRUE(doubts(t).empty());

  Transducer overloaded = t;
  overloaded.load = 1.01 * yield_load(t.beam);
  overloaded.full_scale = 1000;
  EXPECT_EQ(doubts(overloaded).size(), 1u);

  Transducer thick = t;
  thick.beam.length = 4.9 * t.beam.height;
  EXPECT_EQ(doubts(thick).size(), 1u);

  Transducer clipped = t;
  clipped.full_scale = 0.99 * evaluate(t).output;
  EXPECT_EQ(doubts(clipped).size(), 1u);
}

}  // namespace
}  // namespace sinew::identify::transducer_test
