// Identified values as files: in SI units, and read back unchanged.
#include "sinew/identify/contest/provenance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/actuator/body.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::identify::provenance_test {
namespace {

// Files are in SI for any number: with sixteen digits another unit might need one digit less and be
// used, "0.000458414332647958 in/lbf".
TEST(Digits, FilesAreInUnitsOfSi) {
  actuator::Actuator a = actuator::thesis_actuator();
  a.name = "m";
  a.long_end.length = actuator::shortest_length(a);
  for (int k = 1; k < 50; ++k) {
    a.series.compliance = 2.6e-6 * std::sqrt(k);
    a.bladder.saturating_tension = 100 * std::sqrt(k + 0.5);
    a.bladder.saturation_length = 3e-3 * std::sqrt(k + 0.3);
    a.prediction = {.rest_length = 0.25,
                    .lengths = {0.2 + 0.001 * std::sqrt(k), 0.25},
                    .highest = 1e5 * std::sqrt(k),
                    .inside_95 = std::sqrt(k)};
    const actuator::Actuator short_one = without_idle_digits(a);
    EXPECT_NEAR(short_one.series.compliance, a.series.compliance, 1e-9 * a.series.compliance);
    EXPECT_NEAR(short_one.prediction.inside_95, a.prediction.inside_95, 1e-3 * std::sqrt(k));
    EXPECT_GE(short_one.long_end.length, actuator::shortest_length(short_one));
    const std::string file = actuator_file(short_one, {});
    for (const char* unit : {"in/lbf\"", " lbf\"", " ft\""})
      EXPECT_EQ(file.find(unit), file.npos) << unit << " in\n" << file;
  }
}

}  // namespace
}  // namespace sinew::identify::provenance_test
