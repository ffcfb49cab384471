// Pins, channels and bits, and the bytes that go to the ports.
#include "sinew/robot/wiring/wiring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "sinew/config/compose.h"
#include "sinew/config/reader.h"
#include "sinew/robot/robot.fields.h"
#include "sinew/robot/wiring/wiring.fields.h"
#include "tests/places.h"

namespace sinew::robot::wiring_test {
namespace {

struct Leg {
  Robot robot;
  Wiring wiring;
};

Leg leg() {
  Leg out;
  const auto root = config::compose(sinew::test::source_dir() + "/robots/leg/robot.toml");
  config::Reader reader(root);
  fields(reader, out.robot);
  fields(reader, out.wiring);
  reader.finish_part();
  return out;
}

std::string wrong(const Leg& l) {
  std::string all;
  for (const Contradiction& c : contradictions(l.wiring, l.robot))
    all += c.key + ": found " + c.found + "; expected " + c.expected + "\n";
  return all;
}

using Bits = std::map<std::string, int>;
Bits bits(const Leg& l) {
  Bits out;
  for (const ValveBit& b : bits_of(l.robot, l.wiring)) out[b.of + " " + b.which] = b.bit;
  return out;
}

// The page has every line of the files.
TEST(Wiring, OfTheLegIsThatOfItsPage) {
  std::ifstream in(sinew::test::source_dir() + "/docs/reference/thesis-wiring.md");
  std::ostringstream all;
  all << in.rdbuf();
  const std::string page = all.str();
  const auto expect_row = [&](std::initializer_list<std::string> cells) {
    std::string row = "|";
    for (const std::string& cell : cells) row += " " + cell + " |";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  };
  const auto code = [](const std::string& name) { return "`" + name + "`"; };
  const auto text = [](int number) { return std::to_string(number); };
  const Leg l = leg();
  for (const Wiring::Signal& s : l.wiring.signals)
    expect_row({text(s.pin), text(s.ground), code(s.name), s.channel < 0 ? "–" : text(s.channel)});
  for (const Wiring::Power& p : l.wiring.power)
    EXPECT_NE(page.find("| " + text(p.pin) + " | " + code(p.name)), std::string::npos) << p.name;
  const Bits of_robot = bits(l);
  for (const Wiring::Valve& v : l.wiring.valves)
    expect_row({text(v.plumbing), code(v.of), text(v.inlet.pin) + ", " + text(v.inlet.common),
                text(v.inlet.bit), text(of_robot.at(v.of + " inlet")),
                text(v.exhaust.pin) + ", " + text(v.exhaust.common), text(v.exhaust.bit),
                text(of_robot.at(v.of + " exhaust"))});
}

// Every pin of table C-1 once, with both numberings as printed.
TEST(Wiring, OfTheLegIsTableC1) {
  Leg l = leg();
  EXPECT_EQ(wrong(l), "");
  std::vector<int> pins;
  for (const auto& s : l.wiring.signals) pins.insert(pins.end(), {s.pin, s.ground});
  for (const auto& v : l.wiring.valves)
    pins.insert(pins.end(), {v.inlet.pin, v.inlet.common, v.exhaust.pin, v.exhaust.common});
  for (const auto& p : l.wiring.power) pins.push_back(p.pin);
  std::sort(pins.begin(), pins.end());
  ASSERT_EQ(pins.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(pins[static_cast<std::size_t>(i)], i + 1);

  const Bits code = {
      {"hip_flexor inlet", 0},     {"hip_flexor exhaust", 8},     {"hip_extensor inlet", 1},
      {"hip_extensor exhaust", 9}, {"knee_flexor inlet", 2},      {"knee_flexor exhaust", 10},
      {"knee_extensor inlet", 3},  {"knee_extensor exhaust", 11}, {"cylinder_up inlet", 4},
      {"cylinder_up exhaust", 12}, {"cylinder_down inlet", 5},    {"cylinder_down exhaust", 13}};
  EXPECT_EQ(bits(l), code);
  l.wiring.bits = Wiring::Bits::table;
  Bits table = code;
  for (auto& [valve, bit] : table)  // the cylinder comes first
    bit += valve.starts_with("cylinder") ? -4 : 2;
  EXPECT_EQ(bits(l), table);
}

TEST(Wiring, CannotHaveTwoOfOne) {
  const auto with = [](auto change) {
    Leg l = leg();
    change(l);
    return wrong(l);
  };
  EXPECT_EQ(with([](Leg& l) { l.wiring.signals[1].pin = 1; }),
            "wiring.signal.hip_angle.pin: found pin 1, which wiring.signal.cylinder_position.pin "
            "has; expected one of its own\n");
  EXPECT_EQ(with([](Leg& l) {
              l.wiring.valves[2].inlet.bit = 0;
            }).find("wiring.valve.3.inlet.bit: found bit 0, which wiring.valve.1.inlet.bit has"),
            0U);
  EXPECT_EQ(
      with([](Leg& l) { l.robot.muscles[0].inlet_bit = 7; }),
      "muscle.hip_flexor.inlet.bit: found 7; expected a bit that a pin of [wiring] carries\n");
  EXPECT_EQ(with([](Leg& l) { l.wiring.signals[1].channel = 31; }),
            "wiring.signal.hip_angle.channel: found 31; expected 25, as "
            "sensor.hip_angle.channel\n");
  EXPECT_NE(with([](Leg& l) { l.wiring.signals[1].channel = 24; }).find("channel 24, which"),
            std::string::npos);
  EXPECT_EQ(with([](Leg& l) { l.wiring.signals[7].spare = false; }),
            "wiring.signal.hip_flexor_pressure: found no sensor of that name; expected a sensor "
            "of the robot\n");
  EXPECT_EQ(with([](Leg& l) {
              l.wiring.valves[5].of = "tail";
            }).find("wiring.valve.6.of: found \"tail\"; expected a muscle"),
            0U);
}

signals::Series edges(const std::string& topic, std::vector<std::int64_t> ticks) {
  signals::Series s{{topic, "", {{"value", "1"}}}, {}, {{}}};
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    s.time_ns.push_back(ticks[i] * 100'000);
    s.columns[0].push_back(i % 2 == 0 ? 1 : 0);
  }
  return s;
}

// B.1: 255 and 255 shut all valves; a bit that falls opens.
TEST(Ports, CarryTheEdgesOfARun) {
  const Leg l = leg();
  signals::Table t;
  t.series = {edges("/valve/hip_flexor/inlet/open", {10, 20}),
              edges("/valve/knee_extensor/exhaust/open", {10, 15})};
  const auto bytes = port_bytes(t, bits_of(l.robot, l.wiring), l.wiring.polarity);
  ASSERT_EQ(bytes.size(), 4U);
  const auto at = [&](std::size_t i) {
    return std::array<int, 3>{static_cast<int>(bytes[i].time_ns / 100'000), bytes[i].port[0],
                              bytes[i].port[1]};
  };
  EXPECT_EQ(at(0), (std::array{0, 255, 255}));
  EXPECT_EQ(at(1), (std::array{10, 254, 247}));
  EXPECT_EQ(at(2), (std::array{15, 254, 255}));
  EXPECT_EQ(at(3), (std::array{20, 255, 255}));
}

// For any map and polarity the states of the valves can be recovered from the bytes.
TEST(Ports, ReportEveryValveAtEveryTime) {
  std::mt19937 random(4);
  Leg l = leg();
  for (int trial = 0; trial < 20; ++trial) {
    l.wiring.bits = trial % 2 ? Wiring::Bits::table : Wiring::Bits::robot;
    l.wiring.polarity = trial % 4 < 2 ? Wiring::Polarity::low_opens : Wiring::Polarity::high_opens;
    const auto map = bits_of(l.robot, l.wiring);
    signals::Table t;
    for (const ValveBit& b : map) {
      std::vector<std::int64_t> ticks = {static_cast<std::int64_t>(random() % 5)};
      while (ticks.size() < 40) ticks.push_back(ticks.back() + 1 + static_cast<int>(random() % 9));
      t.series.push_back(edges("/valve/" + b.of + "/" + b.which + "/open", ticks));
    }
    const auto bytes = port_bytes(t, map, l.wiring.polarity);
    for (std::int64_t tick = 0; tick < 200; ++tick) {
      const auto after = std::ranges::upper_bound(bytes, tick * 100'000, {}, &PortBytes::time_ns);
      const PortBytes& now = *(after - 1);
      for (std::size_t v = 0; v < map.size(); ++v) {
        const auto passed = std::ranges::upper_bound(t.series[v].time_ns, tick * 100'000);
        const bool open = (passed - t.series[v].time_ns.begin()) % 2 == 1;
        const int byte = now.port[static_cast<std::size_t>(map[v].bit / 8)];
        const bool high = byte >> (map[v].bit % 8) & 1;
        ASSERT_EQ(high, open != (l.wiring.polarity == Wiring::Polarity::low_opens)) << tick;
      }
    }
  }
}

}  // namespace
}  // namespace sinew::robot::wiring_test
