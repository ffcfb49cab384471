// tests/worlds/drive.h - valves driven by a seeded random pattern, and a world that is observed
// while it moves, seldom or at every instant.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <random>
#include <vector>

#include "tests/worlds/body.h"

namespace sinew::worlds {

using signals::Tick;

inline double seconds(double ticks) { return ticks * signals::tick_seconds; }

// Edges of random valves, one each 0.1 to 6 ms, more often where there are many valves. Uses the
// raw numbers of a generator, which are the same on every system.
inline std::vector<signals::Edge> random_edges(const std::vector<Tap>& taps, Tick end,
                                               unsigned seed) {
  std::vector<signals::Edge> out;
  if (taps.empty()) return out;
  std::mt19937 random(seed);
  std::vector<bool> open(taps.size(), false);
  const std::size_t longest = taps.size() > 16 ? 16 * 60 / taps.size() : 60;  // [ticks]
  for (Tick t = 3; t < end; t += 1 + static_cast<Tick>(random() % longest)) {
    const std::size_t i = random() % taps.size();
    open[i] = !open[i];
    signals::Edge edge{.at = t, .valve = {taps[i].valve}, .open = open[i]};
    if (taps[i].regulator) {
      edge.level = static_cast<std::uint16_t>(random() % signals::max_level);
      edge.open = edge.level > 0;
    }
    out.push_back(edge);
  }
  return out;
}

// Conversions of all channels, a tick apart, each read a tick after it began.
class Channels {
 public:
  explicit Channels(Body& body) : count_(body.channels()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto start = static_cast<std::uint16_t>(2 * (i % 49));
      all_[i] = {{static_cast<std::uint8_t>(i)}, start, static_cast<std::uint16_t>(start + 1)};
    }
    start(body);
  }

  void start(Body& body) {
    body_ = &body;
    EXPECT_EQ(body.port().start({.period = 100, .conversions = {all_.data(), count_}}),
              signals::Status::ok);
  }

  std::size_t count() const { return count_; }
  signals::Reading read(std::size_t channel, Tick now) {
    return body_->port().read({static_cast<std::uint8_t>(channel)}, now);
  }

 private:
  Body* body_ = nullptr;
  std::size_t count_ = 0;
  std::array<signals::Conversion, 192> all_{};  // six boards full
};

// Observations of a world in addition to the recording.
struct ExtraReads {
  bool every_tick = false;  // the truth at each tick, and a node if one is due
  unsigned truths = 0;      // at most, at random instants of each tick
  bool advances = false;    // calls that commit nodes, at random instants
  bool restores = false;    // another body continues from a save, at random instants
};

// Truth each 3.7 ms, readings of all channels each millisecond.
struct Record {
  std::vector<double> truth;
  std::vector<std::uint16_t> readings;
  double entered = 0;  // air through the valves [kg]
};

// Runs a world from its start to `end` with an observer. A conversion that begins at a tick is
// read a tick later, and calls never go back in time, so there is no observation between the two.
inline Record follow(const Subject& subject, const Variant& variant, Tick end, unsigned seed,
                     const ExtraReads& extra = {}) {
  std::unique_ptr<Body> body = subject.make(variant);
  Channels channels(*body);
  const std::vector<signals::Edge> edges = random_edges(subject.taps, end, seed);
  std::mt19937 random(99);
  std::array<double, most_quantities> numbers{}, unused{};
  const std::size_t count = body->quantities().size();

  Record out;
  std::size_t next = 0;
  for (Tick t = 0; t <= end; ++t) {
    for (; next < edges.size() && edges[next].at == t; ++next)
      EXPECT_EQ(body->port().drive(edges[next]), signals::Status::ok) << subject.name << " " << t;
    if (t % 10 == 5)
      for (std::size_t i = 0; i < channels.count(); ++i)
        out.readings.push_back(channels.read(i, t).counts);
    if (t % 37 == 0) {
      body->truth(seconds(static_cast<double>(t)), numbers);
      out.truth.insert(out.truth.end(), numbers.begin(),
                       numbers.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (extra.every_tick) {
      body->advance(seconds(static_cast<double>(t)));
      body->truth(seconds(static_cast<double>(t)), unused);
    }
    if (t % 10 == 4) continue;  // a conversion is under way
    double within = 0;
    const auto later = [&] {
      within += (1.0 - within) * static_cast<double>(random() % 1000) / 1000;
      return seconds(static_cast<double>(t) + within);
    };
    if (extra.advances && random() % 5 == 0) body->advance(later());
    if (extra.restores && random() % 50 == 0) {
      std::unique_ptr<Body> other = subject.make(variant);
      channels.start(*other);
      other->restore(body->save());
      body = std::move(other);
    }
    for (unsigned i = extra.truths > 0 ? random() % (extra.truths + 1) : 0; i > 0; --i)
      body->truth(later(), unused);
  }
  for (const Account& a : body->air(seconds(static_cast<double>(end)))) out.entered += a.entered;
  EXPECT_FALSE(body->failure()) << subject.name;
  return out;
}

inline void PrintTo(const Subject& s, std::ostream* out) { *out << s.name; }

// One test per subject.
class Worlds : public ::testing::TestWithParam<Subject> {};

inline std::string name_of(const ::testing::TestParamInfo<Subject>& info) {
  return info.param.name;
}

}  // namespace sinew::worlds
