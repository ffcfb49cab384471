// Frames on a disturbed line, in quantity: a changed frame is never accepted, and the commands that
// are carried out are those that were sent, once, in order and in their time.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

#include "sinew/control/link/command_queue.h"
#include "sinew/control/link/sequence.h"
#include "sinew/control/link/test_wire.h"

namespace sinew::link {
namespace {

using signals::Tick;

constexpr Tick period = 100;

// Counts the tries of this process: ctest gives each test one of its own.
struct Tally {
  std::int64_t flipped = 0, bursts = 0, sent = 0, whole = 0, obeyed = 0, passed = 0;
};
Tally tally;

class Tell : public ::testing::Environment {
 public:
  void TearDown() override {
    const auto say = [](std::int64_t n, const char* what) {
      if (n > 0) std::printf("guard: %lld %s\n", static_cast<long long>(n), what);
    };
    if (tally.passed > 0) return say(tally.passed, "spoiled frames passed");
    say(tally.flipped, "frames with up to three flipped bits, none passed");
    say(tally.bursts, "with a burst of up to 16, none passed");
    if (tally.sent > 0)
      std::printf(
          "guard: %lld commands over a bad line, %lld came whole, %lld periods obeyed one\n",
          static_cast<long long>(tally.sent), static_cast<long long>(tally.whole),
          static_cast<long long>(tally.obeyed));
  }
};
const auto* const tell = ::testing::AddGlobalTestEnvironment(new Tell);

// A try is 100,000 changed frames, and some periods of commands.
constexpr int flipped_a_try = 50'000, bursts_a_try = 50'000, commands_a_try = 5'000;

int count() {
  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  return asked ? std::max(1, std::atoi(asked)) : 10;
}

// splitmix64: a simple generator is sufficient for this many tries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t roll() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  std::size_t below(std::size_t n) { return (roll() >> 32) * n >> 32; }

 private:
  std::uint64_t state_;
};

// All frames that a decoder returns until the line is silent.
template <class Use>
void whole_of(Decoder& decoder, std::span<const std::uint8_t> bytes, Use use) {
  decoder.push(bytes);
  decoder.silent();
  while (const Frame* f = decoder.next()) use(*f);
}

// Tries n frames that `spoil` has changed; sometimes a new frame, and a good one after it.
template <class Spoil>
void spoil_frames(int n, std::uint64_t seed, Spoil spoil) {
  Dice dice(seed);
  std::mt19937 random(static_cast<unsigned>(seed));
  Decoder decoder;
  Bytes frame, good;
  for (int i = 0; i < n; ++i) {
    if (i % 32 == 0) {
      frame = any_frame(random, static_cast<std::uint8_t>(i / 32));
      good = any_frame(random, static_cast<std::uint8_t>(i / 32 + 1));
    }
    std::array<std::uint8_t, 2 * max_frame> line;
    std::copy(frame.begin(), frame.end(), line.begin());
    spoil(std::span(line).first(frame.size()), dice);
    const bool followed = i % 8 == 0;
    if (followed)
      std::copy(good.begin(), good.end(), line.begin() + static_cast<long>(frame.size()));
    int found = 0, as_sent = 0;
    whole_of(decoder, std::span(line).first(frame.size() + (followed ? good.size() : 0)),
             [&](const Frame& f) {
               ++found;
               as_sent += followed && bytes_of(f) == good;
             });
    if (found == as_sent && as_sent == followed) continue;
    ++tally.passed;
    ADD_FAILURE() << "type " << int{frame[2]} << ", try " << i << ": " << found << " found";
  }
}

TEST(Wire, ThreeFlippedBitsNeverPass) {
  const int n = count() * flipped_a_try;
  spoil_frames(n, 1, [](std::span<std::uint8_t> frame, Dice& dice) {
    const std::size_t bits = 8 * frame.size();
    const std::size_t a = dice.below(bits), b = dice.below(bits), c = dice.below(bits);
    flip(frame, a);
    if (b != a) flip(frame, b);
    if (c != a && c != b) flip(frame, c);
  });
  tally.flipped = n;
}

TEST(Wire, BurstsOfSixteenNeverPass) {
  const int n = count() * bursts_a_try;
  spoil_frames(n, 2, [](std::span<std::uint8_t> frame, Dice& dice) {
    burst(frame, dice.below(8 * frame.size() - 15),
          static_cast<std::uint32_t>(dice.below(0x10000)) | 1u);
  });
  tally.bursts = n;
}

// The result depends on the whole frame after sync, type, sequence and length: every burst at every
// place, for each type. A part of them where there is no time for all.
TEST(Wire, BurstsOverTheHeadOfEachTypeNeverPass) {
  const std::uint32_t step = count() >= 500 ? 2 : 2 * 127;
  std::mt19937 random(3);
  Decoder decoder;
  each_message([&](auto m) {
    Bytes frame = frame_of(any<decltype(m)>(random));
    for (std::size_t at = 0; at < 8 * header_size; ++at)
      for (std::uint32_t pattern = 1; pattern < 0x10000; pattern += step) {
        burst(frame, at, pattern);
        int found = 0;
        whole_of(decoder, frame, [&](const Frame&) { ++found; });
        burst(frame, at, pattern);
        ++tally.bursts;
        if (found == 0) continue;
        ++tally.passed;
        ADD_FAILURE() << "type " << int{frame[2]} << ", bit " << at << ", pattern " << pattern;
      }
  });
}

// --- commands over a disturbed line -------------------------------------------------------------

// The effect of the line on a frame in transit.
class BadLine {
 public:
  explicit BadLine(unsigned seed) : random_(seed) {}

  // The bytes that arrive in this period.
  Bytes carry(const Bytes& frame) {
    Bytes out = std::move(late_);
    late_.clear();
    if (one_in(20)) append(out, noise(300));
    Bytes now = frame;
    if (one_in(2)) spoil(now);
    if (one_in(30)) append(late_, now);  // again, or only, in the next period
    if (!one_in(30)) append(out, now);
    if (one_in(100)) append(out, seen_[random_() % seen_.size()]);  // an old one once more
    seen_[random_() % seen_.size()] = frame;
    return out;
  }
  bool pauses() { return one_in(4); }

 private:
  bool one_in(unsigned n) { return random_() % n == 0; }
  static void append(Bytes& to, const Bytes& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  Bytes noise(unsigned most) {
    Bytes out(random_() % most);
    for (std::uint8_t& b : out)
      b = one_in(3) ? (one_in(2) ? sync_first : sync_second) : static_cast<std::uint8_t>(random_());
    return out;
  }

  void spoil(Bytes& frame) {
    const auto place = [&] { return frame.begin() + static_cast<long>(random_() % frame.size()); };
    switch (random_() % 6) {
      case 0:
        for (unsigned k = 1 + random_() % 8; k > 0; --k)
          flip(frame, random_() % (8 * frame.size()));
        break;
      case 1:
        frame.resize(random_() % frame.size());
        break;
      case 2:
        frame.erase(place());
        break;
      case 3:
        frame.insert(place(), static_cast<std::uint8_t>(random_()));
        break;
      case 4:
        *place() = static_cast<std::uint8_t>(random_());
        break;
      default:  // its end is another's
        const Bytes& other = seen_[random_() % seen_.size()];
        const std::size_t n = random_() % frame.size();
        for (std::size_t i = n; i < frame.size() && i < other.size(); ++i) frame[i] = other[i];
    }
  }

  std::mt19937 random_;
  Bytes late_;
  std::array<Bytes, 64> seen_;
};

// A board's end of the line, for commands only.
struct Board {
  Decoder decoder;
  SequenceWindow window;
  CommandQueue queue{period};

  void hear(const Bytes& bytes, Tick begun) {
    feed(decoder, bytes, [&](const Frame& f) {
      CommandFor command;
      if (f.envelope.board != 1 || !window.take(f.envelope.sequence) ||
          decode(f, command) != Code::done)
        return;
      ++tally.whole;
      queue.put(command, begun);
    });
  }
};

CommandFor any_command(std::mt19937& random, Tick from) {
  auto out = any<CommandFor>(random);
  out.from = from;
  out.periods = static_cast<std::uint8_t>(1 + random() % 3);
  return out;
}

TEST(Wire, WhatIsObeyedWasSentForThatPeriod) {
  const int periods = count() * commands_a_try;
  std::mt19937 random(4);
  BadLine line(5);
  Board board;
  std::map<Tick, Bytes> sent;  // by their period
  Tick last = 0;
  for (int i = 0; i < periods; ++i) {
    const Tick begun = i * period;
    const CommandFor command = any_command(random, begun + period);
    const Bytes frame = frame_of(command, {.board = 1, .sequence = static_cast<std::uint8_t>(i)});
    sent[command.from] = frame_of(command);
    if (sent.size() > 200) sent.erase(sent.begin());
    board.hear(line.carry(frame), begun);
    if (line.pauses()) {
      board.decoder.silent();
      board.hear({}, begun);
    }
    const CommandFor* found = board.queue.at(begun + period);
    if (!found) continue;
    ++tally.obeyed;
    const bool right = sent.contains(found->from) && frame_of(*found) == sent[found->from] &&
                       found->from <= begun + period &&
                       begun + period < found->from + found->periods * period &&
                       found->from >= last;
    last = found->from;
    tally.passed += !right;
    ASSERT_TRUE(right) << "period " << i;
  }
  tally.sent = periods;
  EXPECT_GT(tally.obeyed, periods / 2);
}

}  // namespace
}  // namespace sinew::link
