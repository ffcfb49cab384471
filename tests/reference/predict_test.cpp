// predict.dat in data/reference.json: the shipped legs have its table, which follows from its rule.
#include <gtest/gtest.h>

#include <cstdint>

#include "sinew/signals/timing.h"
#include "tests/reference/reference.h"

namespace sinew::reference::predict_test {
namespace {

TEST(Reference, PredictDat) {
  const json& p = reference()["predict_dat"];
  EXPECT_EQ(p["identity"], "0,0,101 / d,d,100 / 100,101,100");
  for (const experiment::Experiment* e : {&leg(), &as_printed()}) {
    EXPECT_EQ(e->timing.closing[0], 0);
    EXPECT_EQ(e->timing.opening[0], 101);
    for (std::size_t d = 1; d < 100; ++d) {
      EXPECT_EQ(e->timing.closing[d], d);
      EXPECT_EQ(e->timing.opening[d], 100);
    }
    EXPECT_EQ(e->timing.closing[100], 101);
    EXPECT_EQ(e->timing.opening[100], 100);
  }

  // open = 100 - to; close = d - tc for d > tc.
  const auto opening = p["inlet_to_tc_ticks"][0].get<std::uint16_t>();
  const auto closing = p["inlet_to_tc_ticks"][1].get<std::uint16_t>();
  EXPECT_NEAR(opening, si("t_inlet_open_leg") / si("isr_period"), 1e-9);
  EXPECT_NEAR(closing, si("t_inlet_close_leg") / si("isr_period"), 1e-9);
  const signals::ValveTiming t = signals::compensated_timing(opening, closing);
  for (std::size_t d = 1; d < 100; ++d) {
    EXPECT_EQ(t.opening[d], 100u - opening);
    EXPECT_EQ(t.closing[d], d > closing ? d - closing : 0u);
  }
}

}  // namespace
}  // namespace sinew::reference::predict_test
