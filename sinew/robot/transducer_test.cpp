// A transducer's errors, each against its formula.
#include "sinew/robot/transducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::robot::transducer_test {
namespace {

Transducer gauge() { return {.name = "gauge", .of = Transducer::Of::pressure, .high = 8e5}; }

// An ideal one has an error of half a count at most.
TEST(Transducer, ShowsWhatThereIsToHalfACount) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anything(0, 8e5);
  const Transducer t = gauge();
  for (int i = 0; i < 1000; ++i) {
    const double p = anything(random);
    EXPECT_NEAR(shown(t, counts(t, p, 0)), p, 0.5 * 8e5 / 4095 + 1e-9);
  }
}

TEST(Transducer, ClipsAtItsRange) {
  const Transducer t = gauge();
  EXPECT_EQ(counts(t, -1e3, 0), 0);
  EXPECT_EQ(counts(t, 9e5, 0), 4095);
  EXPECT_EQ(shown(t, counts(t, 9e5, 0)), 8e5);
}

TEST(Transducer, ScaleAndOffsetMoveTheLine) {
  Transducer t = gauge();
  t.scale = 1.02;
  t.offset = -8e3;
  for (const double p : {1e5, 3e5, 6e5})
    EXPECT_NEAR(shown(t, counts(t, p, 0)), 1.02 * p - 8e3, 0.5 * 8e5 / 4095 + 1e-9);
}

// A dial is read to its divisions.
TEST(Transducer, ResolutionIsADials) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anything(0, 7e5);
  Transducer t = gauge();
  t.resolution = 6894.757;
  for (int i = 0; i < 1000; ++i) {
    const double p = anything(random), read = shown(t, counts(t, p, 0));
    EXPECT_NEAR(read / t.resolution, std::round(read / t.resolution), 1e-9);
    EXPECT_NEAR(read, p, 0.5 * t.resolution + 0.5 * 8e5 / 4095 + 1e-6);
  }
}

TEST(Transducer, NoiseIsInItsUnit) {
  Transducer t = gauge();
  t.noise = 5e3;
  const double quiet = shown(t, counts(t, 3e5, 0));
  EXPECT_NEAR(shown(t, counts(t, 3e5, 2)) - quiet, 1e4, 8e5 / 4095);
  EXPECT_NEAR(shown(t, counts(t, 3e5, -1)) - quiet, -5e3, 8e5 / 4095);
}

}  // namespace
}  // namespace sinew::robot::transducer_test
