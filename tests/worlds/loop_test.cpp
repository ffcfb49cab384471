// A running world does not allocate memory and never goes back in time: the loop relies on both.
#include <gtest/gtest.h>

#include "tests/counted_heap.h"
#include "tests/worlds/drive.h"

namespace sinew::worlds {
namespace {

using test::allocations;
using test::counting;

class Loop : public Worlds {};

TEST_P(Loop, TakesNoMemory) {
  const std::unique_ptr<Body> body = GetParam().make({});
  Channels channels(*body);
  const std::vector<signals::Edge> edges = random_edges(GetParam().taps, 2000, 8);
  std::array<double, most_quantities> numbers{};

  allocations = 0;
  counting = true;
  std::size_t next = 0;
  for (Tick t = 0; t < 2000; ++t) {
    for (; next < edges.size() && edges[next].at == t; ++next) body->port().drive(edges[next]);
    for (std::size_t i = 0; i < channels.count() && t % 10 == 5; ++i) channels.read(i, t);
    if (t % 7 == 0) body->truth(seconds(static_cast<double>(t)), numbers);
    if (t % 13 == 0) body->advance(seconds(static_cast<double>(t)));
  }
  body->port().stop(2000);
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(body->nodes(), 100);

  counting = true;
  ::operator delete(::operator new(1));  // the counter counts
  counting = false;
  EXPECT_EQ(allocations, 1);
}

// An edge before the last node is refused and has no effect; an earlier time gives the last node.
TEST_P(Loop, NeverGoesBack) {
  const std::unique_ptr<Body> body = GetParam().make({}), other = GetParam().make({});
  const std::size_t count = body->quantities().size();
  std::array<double, most_quantities> now{}, earlier{}, later{}, undisturbed{};
  body->advance(0.3505);
  body->truth(body->time(), now);
  body->truth(0.2, earlier);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(earlier[i], now[i]) << body->quantities()[i].name;
  for (const Tap& tap : GetParam().taps)
    for (const Tick t : {Tick{0}, Tick{1000}, Tick{3490}})
      EXPECT_EQ(body->port().drive({.at = t, .valve = {tap.valve}, .open = true, .level = 4000}),
                signals::Status::invalid);
  body->truth(0.5, later);
  other->truth(0.5, undisturbed);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(later[i], undisturbed[i]) << body->quantities()[i].name;
  // At the node itself an edge is still in time.
  if (GetParam().taps.empty()) return;
  EXPECT_EQ(body->port().drive({.at = 5000, .valve = {GetParam().taps[0].valve}, .open = true}),
            signals::Status::ok);
}

// A world that has ended reports it, and accepts no edge.
TEST_P(Loop, StopsForGood) {
  const std::unique_ptr<Body> body = GetParam().make({});
  Channels channels(*body);
  EXPECT_EQ(body->port().stop(100), signals::Status::ok);
  EXPECT_EQ(body->port().drive({.at = 200, .valve = {0}, .open = true}), signals::Status::ended);
  for (std::size_t i = 0; i < channels.count(); ++i)
    EXPECT_EQ(channels.read(i, 201).status, signals::Status::ended);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Loop, ::testing::ValuesIn(subjects()), name_of);

}  // namespace
}  // namespace sinew::worlds
