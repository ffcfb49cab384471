#include "sinew/robot/wiring/wiring.h"

#include <algorithm>
#include <map>

#include "sinew/robot/boards.h"
#include "sinew/robot/legs.h"

namespace sinew::robot {
namespace {

using List = std::vector<Contradiction>;

constexpr std::string_view up = "cylinder_up", down = "cylinder_down";

// Numbers that may be used only once.
class UsedNumbers {
 public:
  explicit UsedNumbers(std::string what) : what_(std::move(what)) {}

  void take(int number, const std::string& key, List& out) {
    const auto [it, is_new] = by_.emplace(number, key);
    if (!is_new)
      out.push_back({key, what_ + " " + std::to_string(number) + ", which " + it->second + " has",
                     "one of its own", ""});
  }
  bool has(int number) const { return by_.count(number) > 0; }

 private:
  std::string what_;
  std::map<int, std::string> by_;
};

void check_pins(const Wiring& w, List& out) {
  UsedNumbers pins("pin");
  for (const Wiring::Signal& s : w.signals) {
    pins.take(s.pin, "wiring.signal." + s.name + ".pin", out);
    pins.take(s.ground, "wiring.signal." + s.name + ".ground", out);
  }
  for (const Wiring::Valve& v : w.valves)
    for (const auto& [which, line] : {std::pair{"inlet", &v.inlet}, {"exhaust", &v.exhaust}}) {
      const std::string key = "wiring.valve." + v.name + "." + which;
      pins.take(line->pin, key + ".pin", out);
      pins.take(line->common, key + ".common", out);
    }
  for (const Wiring::Power& p : w.power) pins.take(p.pin, "wiring.power." + p.name + ".pin", out);
}

void check_signals(const Wiring& w, const Robot& robot, List& out) {
  UsedNumbers channels("channel");
  for (const Wiring::Signal& s : w.signals) {
    const std::string key = "wiring.signal." + s.name;
    if (s.channel >= 0) channels.take(s.channel, key + ".channel", out);
    const int sensor = find_sensor(robot, s.name);
    if (sensor < 0 && !s.spare)
      out.push_back({key, "no sensor of that name", "a sensor of the robot", "spare = true"});
    if (sensor < 0 || s.channel < 0) continue;
    const int channel = robot.sensors[static_cast<std::size_t>(sensor)].channel;
    if (channel != s.channel)
      out.push_back({key + ".channel", std::to_string(s.channel),
                     std::to_string(channel) + ", as sensor." + s.name + ".channel", ""});
  }
}

// Returns the robot's own bits: B.1's masks.
std::vector<ValveBit> robot_bits(const Robot& robot) {
  std::vector<ValveBit> out;
  const auto add = [&](const std::string& of, const char* which, int bit, std::size_t board) {
    const std::string topic = "/valve/" + of + "/" + which + "/open";
    out.push_back({of, which, bit, static_cast<int>(board) + 1, logged_topic(robot, topic)});
  };
  const std::vector<Board> boards = boards_of(robot);
  for (std::size_t b = 0; b < boards.size(); ++b) {
    for (const int i : boards[b].muscles) {
      const Muscle& m = robot.muscles[static_cast<std::size_t>(i)];
      add(m.name, "inlet", m.inlet_bit, b);
      if (!m.exhaust.empty()) add(m.name, "exhaust", m.exhaust_bit, b);
    }
    const bool here = boards.size() == 1 || boards[b].cylinder;
    if (!robot.cylinder.present || !here) continue;
    for (const auto& [of, chamber] :
         {std::pair{up, &robot.cylinder.up}, std::pair{down, &robot.cylinder.down}}) {
      if (!chamber->inlet.empty()) add(std::string(of), "inlet", chamber->inlet_bit, b);
      if (!chamber->exhaust.empty()) add(std::string(of), "exhaust", chamber->exhaust_bit, b);
    }
  }
  return out;
}

void check_bits(const Wiring& w, const Robot& robot, List& out) {
  UsedNumbers by_table("bit");
  for (const Wiring::Valve& v : w.valves) {
    const std::string key = "wiring.valve." + v.name;
    by_table.take(v.inlet.bit, key + ".inlet.bit", out);
    by_table.take(v.exhaust.bit, key + ".exhaust.bit", out);
    if (v.of != up && v.of != down && find_muscle(robot, v.of) < 0)
      out.push_back(
          {key + ".of", "\"" + v.of + "\"", "a muscle, cylinder_up or cylinder_down", ""});
  }
  for (const ValveBit& b : robot_bits(robot)) {
    const bool muscle = find_muscle(robot, b.of) >= 0;
    const std::string chamber = b.of == up ? "cylinder.up" : "cylinder.down";
    const std::string key = (muscle ? "muscle." + b.of : chamber) + "." + b.which + ".bit";
    if (w.present && !by_table.has(b.bit))
      out.push_back({key, std::to_string(b.bit), "a bit that a pin of [wiring] carries", ""});
  }
}

}  // namespace

std::vector<Contradiction> contradictions(const Wiring& w, const Robot& robot) {
  List out;
  if (w.present) {
    const std::size_t boards = boards_of(robot).size();
    if (boards > 1)
      out.push_back({"wiring", "a machine of " + std::to_string(boards) + " boards",
                     "one board, whose terminals it lists", "no [wiring]"});
    check_pins(w, out);
    check_signals(w, robot, out);
  }
  check_bits(w.present ? w : Wiring{}, robot, out);
  return out;
}

std::vector<ValveBit> bits_of(const Robot& robot, const Wiring& w) {
  std::vector<ValveBit> out = robot_bits(robot);
  if (!w.present || w.bits == Wiring::Bits::robot) return out;
  std::erase_if(out, [&](ValveBit& b) {
    const auto valve = std::ranges::find(w.valves, b.of, &Wiring::Valve::of);
    if (valve == w.valves.end()) return true;
    b.bit = b.which == "inlet" ? valve->inlet.bit : valve->exhaust.bit;
    return false;
  });
  return out;
}

std::vector<PortBytes> port_bytes(const signals::Table& table, const std::vector<ValveBit>& bits,
                                  Wiring::Polarity polarity) {
  struct Edge {
    std::int64_t time_ns;
    int bit;
    bool open;
  };
  std::vector<Edge> edges;
  for (const ValveBit& b : bits) {
    const signals::Series* s = table.find(b.topic);
    for (std::size_t i = 0; s && i < s->time_ns.size(); ++i)
      edges.push_back({s->time_ns[i], b.bit, s->columns[0][i] > 0.5});
  }
  std::ranges::stable_sort(edges, {}, &Edge::time_ns);

  const bool low = polarity == Wiring::Polarity::low_opens;
  const std::uint8_t shut = low ? 0xFF : 0x00;
  std::vector<PortBytes> out(1);
  out.front().port.fill(shut);
  for (const Edge& e : edges) {
    if (e.time_ns > out.back().time_ns) out.push_back({e.time_ns, out.back().port});
    std::uint8_t& byte = out.back().port[static_cast<std::size_t>(e.bit / 8)];
    const auto mask = static_cast<std::uint8_t>(1U << (e.bit % 8));
    const bool high = e.open != low;
    byte = static_cast<std::uint8_t>(high ? byte | mask : byte & ~mask);
    // An edge to the present position of a valve changes no byte.
    if (out.size() > 1 && out.back().port == out[out.size() - 2].port) out.pop_back();
  }
  return out;
}

}  // namespace sinew::robot
