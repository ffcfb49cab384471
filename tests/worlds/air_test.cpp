// Conservation: air that entered and has not left is present, and energy without losses is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/worlds/drive.h"

namespace sinew::worlds {
namespace {

class Balance : public Worlds {};

// The balances of a world every 10 ms while its valves are driven at random.
std::vector<std::vector<Account>> book(const Subject& s, Tick end) {
  const std::unique_ptr<Body> body = s.make({});
  const Channels channels(*body);
  std::vector<std::vector<Account>> out{body->air(0)};
  Tick asked = 0;
  const auto ask_before = [&](Tick t) {
    for (asked += 100; asked < t; asked += 100)
      out.push_back(body->air(seconds(static_cast<double>(asked))));
    asked -= 100;
  };
  for (const signals::Edge& edge : random_edges(s.taps, end, 7)) {
    ask_before(edge.at);
    EXPECT_EQ(body->port().drive(edge), signals::Status::ok);
  }
  ask_before(end + 1);
  EXPECT_EQ(out.size(), static_cast<std::size_t>(end / 100 + 1));
  EXPECT_FALSE(body->failure());
  return out;
}

// Relative to all the air that has moved or is present: the rounding of some thousand steps, 1e-16
// each. Measured: 1e-13.
constexpr double rounding = 1e-12;

TEST_P(Balance, AirIsNeitherMadeNorLost) {
  const auto books = book(GetParam(), 10000);
  double most = 0;
  for (const std::vector<Account>& now : books)
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Account &a = now[i], &start = books.front()[i];
      const double off = a.held - start.held - (a.entered - a.left - a.leaked);
      const double share = std::abs(off) / (a.held + a.entered + a.left + a.leaked);
      ASSERT_LE(share, rounding) << a.of;
      most = std::max(most, share);
    }
  RecordProperty("share", std::to_string(1e15 * most) + "e-15");
}

// Every part with a valve takes in and releases air; otherwise the balance would test nothing.
TEST_P(Balance, EveryPathOfTheAirActs) {
  const auto books = book(GetParam(), 10000);
  if (GetParam().taps.empty()) return;
  for (const Account& a : books.back()) {
    EXPECT_TRUE(a.entered > 1e-6 || a.of == "machine" || a.of == "stand") << a.of;  // 1 mg
    EXPECT_GT(a.left, 1e-6) << a.of;
  }
}

// Drift of the energy over a second, or until a tendon is slack: from there on a muscle that pushes
// has nothing to push against.
double drift(const Subject& s, double step) {
  const std::unique_ptr<Body> body =
      s.make({.step = step, .pressure = 3e5, .displaced = true, .lossless = true});
  const std::vector<Quantity>& what = body->quantities();
  std::array<double, most_quantities> numbers{};
  const double before = body->energy(0);
  double worst = 0, seen = 0;
  bool slack = false;
  for (int k = 1; k <= 1000 && !slack; ++k) {
    seen = 1e-3 * k;
    body->truth(seen, numbers);
    for (std::size_t i = 0; i < what.size(); ++i)
      slack = slack || (what[i].kind == Kind::tension && !(numbers[i] > 0));
    if (!slack) worst = std::max(worst, std::abs(body->energy(seen) - before) / before);
  }
  EXPECT_GT(seen, 0.05) << "slack at once";
  EXPECT_FALSE(body->failure());
  return worst;
}

// Sealed and without losses, body, springs, air and the room's air together keep their energy
// except for the error of RK4: half the step, a thirty-second of the drift, down to what the series
// of the pressures contributes (2e-11 of a pressure, 2e-13 of the energy that moves).
TEST_P(Balance, EnergyIsKeptWithoutLosses) {
  const Subject& s = GetParam();
  if (!s.conserves) return;
  const double coarse = drift(s, s.step), fine = drift(s, 0.5 * s.step);
  EXPECT_LE(coarse, s.limits.energy);
  EXPECT_LE(fine, std::max(0.1 * coarse, 1e-12)) << coarse;
  RecordProperty("drift", std::to_string(1e12 * coarse) + "e-12");
}

INSTANTIATE_TEST_SUITE_P(Worlds, Balance, ::testing::ValuesIn(subjects()), name_of);

}  // namespace
}  // namespace sinew::worlds
