// A state between two nodes is close to the node, and a world converges with its order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tests/worlds/drive.h"

namespace sinew::worlds {
namespace {

class Accuracy : public Worlds {};

using Numbers = std::array<double, most_quantities>;

// Records a measured figure, for --gtest_output.
void record(const std::string& key, double figure) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", figure);
  ::testing::Test::RecordProperty(key, text);
}

// The state extrapolated from the last node to just before the next one, compared with that node,
// by kind of quantity: the longest extrapolation there is. The largest differences in a second.
std::map<Kind, double> preview_errors(const Subject& s, const Variant& variant) {
  const std::unique_ptr<Body> body = s.make(variant);
  const Channels channels(*body);
  const std::vector<signals::Edge> edges = random_edges(s.taps, 10000, 11);
  std::map<Kind, double> worst;
  std::size_t next = 0;
  Numbers preview{}, node{};
  for (int k = 1; k <= static_cast<int>(std::lround(1 / s.step)); ++k) {
    const double at = k * s.step;
    for (; next < edges.size() && seconds(static_cast<double>(edges[next].at)) < at - 1e-5; ++next)
      EXPECT_EQ(body->port().drive(edges[next]), signals::Status::ok);
    // Two nanoseconds are 1e-8 rad of a joint that turns with 5 rad/s.
    body->truth(at - 1e-9, preview);
    body->truth(at + 1e-9, node);
    EXPECT_GE(body->time(), at - 1e-12);
    for (std::size_t i = 0; i < body->quantities().size(); ++i) {
      double& w = worst[body->quantities()[i].kind];
      w = std::max(w, std::abs(node[i] - preview[i]));
    }
  }
  EXPECT_FALSE(body->failure());
  return worst;
}

// No friction: dry friction is constant within a step and jumps at its end.
TEST_P(Accuracy, PreviewsAgreeWithNodes) {
  const Subject& s = GetParam();
  std::map<Kind, double> worst = preview_errors(s, {.smooth = true});
  EXPECT_LE(worst[Kind::angle], s.limits.preview_angle);
  EXPECT_LE(worst[Kind::place], s.limits.preview_place);
  EXPECT_LE(worst[Kind::tension], s.limits.preview_tension);
  EXPECT_LE(worst[Kind::pressure], s.limits.preview_pressure);
  EXPECT_LE(worst[Kind::mass], s.limits.preview_mass);
  record("angle", worst[Kind::angle]);
  record("place", worst[Kind::place]);
  record("tension", worst[Kind::tension]);
  record("pressure", worst[Kind::pressure]);
  record("mass", worst[Kind::mass]);
}

// On its ground and with all friction.
TEST_P(Accuracy, PreviewsAgreeWithNodesUnderFriction) {
  const Subject& s = GetParam();
  std::map<Kind, double> worst = preview_errors(s, {});
  EXPECT_LE(worst[Kind::angle], s.limits.rubbing_angle);
  EXPECT_LE(worst[Kind::place], s.limits.rubbing_place);
  EXPECT_LE(worst[Kind::tension], s.limits.rubbing_tension);
  record("angle", worst[Kind::angle]);
  record("place", worst[Kind::place]);
  record("tension", worst[Kind::tension]);
}

// Released away from its rest position, and followed for 64 ms.
Numbers swing(const Subject& s, double step, bool driven) {
  const std::unique_ptr<Body> body =
      s.make({.step = step, .pressure = 3e5, .displaced = true, .smooth = true});
  const Channels channels(*body);
  const std::vector<Tap> taps = driven ? s.taps : std::vector<Tap>{};
  for (const signals::Edge& e : random_edges(taps, 640, 5))
    EXPECT_EQ(body->port().drive(e), signals::Status::ok);
  Numbers out{};
  body->truth(0.064, out);
  EXPECT_FALSE(body->failure());
  return out;
}

// The largest error of an angle or a position; where nothing can move, of the mass of its air [g].
double error(const std::vector<Quantity>& what, const Numbers& a, const Numbers& exact) {
  double place = 0, mass = 0;
  for (std::size_t i = 0; i < what.size(); ++i) {
    const double off = std::abs(a[i] - exact[i]);
    if (what[i].kind == Kind::angle || what[i].kind == Kind::place) place = std::max(place, off);
    if (what[i].kind == Kind::mass) mass = std::max(mass, 1e3 * off);
  }
  return place > 0 ? place : mass;
}

void expect_order(const Subject& s, bool driven, double order, double largest) {
  const std::vector<Quantity> what = s.make({})->quantities();
  const Numbers exact = swing(s, 2.5e-5, driven);
  const double coarse = error(what, swing(s, 1e-3, driven), exact),
               fine = error(what, swing(s, 2.5e-4, driven), exact);
  EXPECT_LE(coarse, largest);
  const bool nothing_moves = coarse == 0 && fine == 0;
  if (nothing_moves) return;
  const double found = 0.5 * std::log2(coarse / fine);
  EXPECT_GE(found, order) << coarse << " at 1 ms, " << fine << " at 0.25 ms";
  record("order", found);
  record("error", coarse);
}

TEST_P(Accuracy, ConvergesWithTheFourthOrder) {
  expect_order(GetParam(), false, GetParam().limits.order, GetParam().limits.error);
}

TEST_P(Accuracy, ConvergesWhileValvesMove) {
  if (GetParam().taps.empty()) return;
  expect_order(GetParam(), true, GetParam().limits.driven_order, GetParam().limits.driven_error);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Accuracy, ::testing::ValuesIn(subjects()), name_of);

}  // namespace
}  // namespace sinew::worlds
