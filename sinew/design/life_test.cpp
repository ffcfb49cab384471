#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sinew/actuator/life.h"
#include "sinew/design/methods.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::design {
namespace {

LifeSettings leg() {
  LifeSettings s;
  s.actuator = test::source_dir() + "/robots/leg/actuator.toml";
  s.contraction = "20 %", s.cycles = "0.4 Hz", s.muscles = 8;
  return s;
}

TEST(DesignLife, TheLegLastsAsItsBurstsAllow) {
  // 6.4: three failures in about 200 steps of eight actuators.
  LifeSettings s = leg();
  s.duration = "500 s";  // 200 steps
  const Result r = design(s);
  // The file has whole cycles, rounded outwards.
  const actuator::Bounds of_bursts = actuator::life_from_failures(3, 1600);
  EXPECT_NEAR(r.of("cycles").low, of_bursts.least, 1);
  EXPECT_NEAR(r.of("cycles").high, of_bursts.most, 1);
  // True by construction: eight muscles of the mean life would have failed that often.
  EXPECT_NEAR(r.of("survival").low, std::exp(-1600 / 182.0), 1e-12);
  EXPECT_NEAR(r.of("survival").high, std::exp(-1600 / 2587.0), 1e-12);
}

TEST(DesignLife, MoreMusclesAndMoreContractionNeverLastLonger) {
  LifeSettings s = leg();
  double before = 1e300, cycles = 1e300;
  for (const char* contraction : {"5 %", "10 %", "20 %", "30 %"}) {
    s.contraction = contraction;
    const Result r = design(s);
    EXPECT_LE(r.of("cycles").high, cycles);
    cycles = r.of("cycles").high;
  }
  for (const int muscles : {1, 2, 8, 48}) {
    s.muscles = muscles;
    const double first = design(s).of("first_failure_s").high;
    EXPECT_LE(first, before);
    before = first;
  }
}

TEST(DesignLife, ABoundThatIsNotPublishedStaysUnknown) {
  LifeSettings s = leg();
  s.made = "swaged";
  const Result over = design(s);
  // One muscle without a failure in 120 million cycles: exp(-n/mean) is 2.5 % at the lower end.
  EXPECT_NEAR(over.of("cycles").low, 120e6 / -std::log(0.025), 1e3);
  EXPECT_TRUE(std::isnan(over.of("cycles").high) && std::isnan(over.of("cycles").number));
  s.made = "clamped";
  const Result under = design(s);
  EXPECT_DOUBLE_EQ(under.of("cycles").high, 18000);
  EXPECT_TRUE(std::isnan(under.of("cycles").low));
}

TEST(DesignLife, LatexLasts24TimesAsLongAsSilicone) {
  LifeSettings s = leg();
  const Result latex = design(s);
  s.silicone = true;
  const Result silicone = design(s);
  EXPECT_NEAR(latex.of("cycles").low / silicone.of("cycles").low, 24, 1e-9);
  EXPECT_NEAR(latex.of("cycles").high / silicone.of("cycles").high, 24, 1e-9);
}

TEST(DesignLife, SaysWhatIsWrong) {
  LifeSettings s = leg();
  s.actuator = test::source_dir() + "/examples/13-from-a-lab/truth.toml";
  EXPECT_THAT(test::message([&] { (void)design(s); }),
              testing::HasSubstr("made=clamped or made=swaged"));
  s = leg();
  s.contraction = "0,2";
  EXPECT_THAT(test::message([&] { (void)design(s); }),
              testing::HasSubstr("contraction: found \"0,2\""));
}

}  // namespace
}  // namespace sinew::design
