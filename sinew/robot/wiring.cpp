#include "sinew/robot/wiring.h"

#include <algorithm>
#include <map>

namespace sinew::robot {
namespace {

using List = std::vector<Contradiction>;

constexpr std::string_view up = "cylinder_up", down = "cylinder_down";

// Numbers that only one may have.
class Taken {
 public:
  explicit Taken(std::string what) : what_(std::move(what)) {}

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
  Taken pins("pin");
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
  Taken channels("channel");
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

// The robot's own bits: B.1's masks.
std::vector<ValveBit> robot_bits(const Robot& robot) {
  std::vector<ValveBit> out;
  for (const Muscle& m : robot.muscles) {
    out.push_back({m.name, "inlet", m.inlet_bit});
    if (!m.exhaust.empty()) out.push_back({m.name, "exhaust", m.exhaust_bit});
  }
  if (!robot.cylinder.present) return out;
  for (const auto& [of, chamber] :
       {std::pair{up, &robot.cylinder.up}, std::pair{down, &robot.cylinder.down}}) {
    if (!chamber->inlet.empty()) out.push_back({std::string(of), "inlet", chamber->inlet_bit});
    if (!chamber->exhaust.empty())
      out.push_back({std::string(of), "exhaust", chamber->exhaust_bit});
  }
  return out;
}

void check_bits(const Wiring& w, const Robot& robot, List& out) {
  Taken by_table("bit"), by_robot("bit");
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
    by_robot.take(b.bit, key, out);
    if (w.present && !by_table.has(b.bit))
      out.push_back({key, std::to_string(b.bit), "a bit that a pin of [wiring] carries", ""});
  }
}

}  // namespace

std::vector<Contradiction> contradictions(const Wiring& w, const Robot& robot) {
  List out;
  if (w.present) {
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
    const signals::Series* s = table.find("/valve/" + b.of + "/" + b.which + "/open");
    for (std::size_t i = 0; s && i < s->time_ns.size(); ++i)
      edges.push_back({s->time_ns[i], b.bit, s->columns[0][i] > 0.5});
  }
  std::ranges::stable_sort(edges, {}, &Edge::time_ns);

  const bool low = polarity == Wiring::Polarity::low_opens;
  const std::uint8_t shut = low ? 0xFF : 0x00;
  std::vector<PortBytes> out = {{0, {shut, shut}}};
  for (const Edge& e : edges) {
    if (e.time_ns > out.back().time_ns) out.push_back({e.time_ns, out.back().port});
    std::uint8_t& byte = out.back().port[static_cast<std::size_t>(e.bit / 8)];
    const auto mask = static_cast<std::uint8_t>(1U << (e.bit % 8));
    const bool high = e.open != low;
    byte = static_cast<std::uint8_t>(high ? byte | mask : byte & ~mask);
    // An edge to where the valve stands already writes nothing new.
    if (out.size() > 1 && out.back().port == out[out.size() - 2].port) out.pop_back();
  }
  return out;
}

}  // namespace sinew::robot
