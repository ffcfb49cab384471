// docs/reference/analysis.md has every key of a summary.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/summary.h"
#include "tests/places.h"

namespace sinew::analysis::summary_docs_test {
namespace {

using test::constant;
using test::duties;
using test::walk;
using test::walking_leg;

// Returns a log with every channel of a simulated walk, filled with simple curves.
test::Log everything() {
  const Machine m = walking_leg();
  const auto curve = [](double t) { return 0.1 + 0.02 * std::sin(3 * t); };
  test::Log log = walk(3, 0.5, 0.5);
  for (const robot::Joint& j : m.robot.joints)
    for (const char* what : {"/joint/", "/desired/joint/", "/true/joint/"})
      for (const char* field : {"/angle", "/velocity", "/stiffness", "/torque"})
        log.scalar(what + j.name + field, [=](double t) { return 5 + curve(t); });
  for (const robot::Muscle& muscle : m.robot.muscles) {
    duties(log, muscle.name, 0.1, 0.1);
    log.scalar("/sensor/" + muscle.name + "_sensor/count", curve);
    log.scalar("/muscle/" + muscle.name + "/tension", curve);
    for (const char* what : {"tension", "pressure", "length", "air_in"})
      log.scalar("/true/muscle/" + muscle.name + "/" + what, curve);
    log.pulses("/valve/" + muscle.name + "/inlet/open", 1e-3, 2);
    log.pulses("/valve/" + muscle.name + "/exhaust/open", 1e-3, 2);
  }
  for (const char* topic : {"/desired/foot/position", "/true/foot/position", "/true/foot/force"})
    log.vector(topic, curve, curve);
  log.scalar("/plan/unreachable", constant(0));
  log.scalar("/true/trolley/position", [](double t) { return 0.1 * t; });
  log.scalar("/true/trolley/velocity", constant(0.1));
  return log;
}

TEST(Summary, EveryKeyIsInTheDocs) {
  std::ifstream file(sinew::test::source_dir() + "/docs/reference/analysis.md");
  const std::string docs{std::istreambuf_iterator<char>(file), {}};
  Machine m = walking_leg();
  m.robot.trolley.track_length = 10;
  const Summary s = summarize(everything().table, m);
  EXPECT_GT(s.entries().size(), 100u);
  for (const Entry& e : s.entries()) {
    const std::string last = e.key.substr(e.key.rfind('.') + 1);
    EXPECT_TRUE(docs.find(last + "`") != docs.npos) << e.key;
  }
}

}  // namespace
}  // namespace sinew::analysis::summary_docs_test
