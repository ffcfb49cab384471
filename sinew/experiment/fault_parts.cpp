#include "sinew/experiment/fault_parts.h"

#include <algorithm>
#include <array>

#include "sinew/robot/boards.h"

namespace sinew::experiment {
namespace {

using What = Fault::What;

constexpr std::array sensor_words = {
    FaultWord{What::open, "open"},      FaultWord{What::shorted, "short"},
    FaultWord{What::stuck, "stuck"},    FaultWord{What::offset, "offset"},
    FaultWord{What::slip, "slip"},      FaultWord{What::noise, "noise"},
    FaultWord{What::dropout, "dropout"}};
constexpr std::array valve_words = {FaultWord{What::stuck_open, "stuck open"},
                                    FaultWord{What::stuck_shut, "stuck shut"},
                                    FaultWord{What::leaking, "leaking"}};
constexpr std::array muscle_words = {FaultWord{What::leaking, "leaking"},
                                     FaultWord{What::ruptured, "ruptured"},
                                     FaultWord{What::blocked, "blocked"}};
constexpr std::array supply_words = {FaultWord{What::failed, "failed"}};

}  // namespace

FaultPart::Kind kind_of_valve(std::span<const gas::Valve> valves, const std::string& name) {
  for (const gas::Valve& v : valves)
    if (v.name == name && v.kind == gas::Valve::Kind::regulator) return FaultPart::Kind::regulator;
  return FaultPart::Kind::valve;
}

std::span<const FaultWord> words_of(FaultPart::Kind kind) {
  using enum FaultPart::Kind;
  if (kind == sensor) return sensor_words;
  if (kind == valve) return valve_words;
  if (kind == muscle) return muscle_words;
  return kind == supply ? std::span<const FaultWord>(supply_words) : std::span<const FaultWord>();
}

bool has_word(FaultPart::Kind kind, What what) {
  return std::ranges::any_of(words_of(kind), [&](const FaultWord& w) { return w.what == what; });
}

std::string_view word_of(What what) {
  for (const auto kind : {FaultPart::Kind::sensor, FaultPart::Kind::valve, FaultPart::Kind::muscle})
    for (const FaultWord& w : words_of(kind))
      if (w.what == what) return w.text;
  return supply_words.front().text;
}

namespace {

// Returns the element's muscle as "bpa", where its air comes by valves also "bpa.inlet",
// "bpa.exhaust" and "supply"; the stand's transducers, so that they can be refused. None where the
// pressure is prescribed: nothing that breaks would change it.
std::vector<FaultPart> parts_of_stand(const Experiment& e) {
  using Kind = FaultPart::Kind;
  const Stand::Element& element = e.stand->element;
  std::vector<FaultPart> out;
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::regulated) return out;
  if (!(element.cylinder.bore > 0)) out.push_back({element.name, Kind::muscle, 0});
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::valves) {
    const auto add = [&](const char* which, const std::string& valve, int index) {
      if (!valve.empty())
        out.push_back({element.name + which, kind_of_valve(e.valves, valve), index});
    };
    add(".inlet", element.inlet, 0);
    add(".exhaust", element.exhaust, 1);
    out.push_back({"supply", Kind::supply, 0});
  }
  for (const robot::Transducer& t : e.stand->sensors) out.push_back({t.name, Kind::transducer, 0});
  return out;
}

}  // namespace

std::vector<FaultPart> fault_parts(const Experiment& e) {
  if (e.stand) return parts_of_stand(e);
  std::vector<FaultPart> out;
  const auto add = [&](std::string name, FaultPart::Kind kind, std::size_t index) {
    out.push_back({std::move(name), kind, static_cast<int>(index)});
  };
  const auto add_pair = [&](const std::string& of, const std::string& inlet,
                            const std::string& exhaust, std::size_t index) {
    add(of + ".inlet", kind_of_valve(e.valves, inlet), index);
    if (!exhaust.empty()) add(of + ".exhaust", kind_of_valve(e.valves, exhaust), index + 1);
  };
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s)
    add(e.robot.sensors[s].name, FaultPart::Kind::sensor, s);
  const std::size_t muscles = e.robot.muscles.size();
  for (std::size_t m = 0; m < muscles; ++m) {
    const robot::Muscle& muscle = e.robot.muscles[m];
    add(muscle.name, FaultPart::Kind::muscle, m);
    add_pair(muscle.name, muscle.inlet, muscle.exhaust, 2 * m);
  }
  const robot::Cylinder& c = e.robot.cylinder;
  if (robot::has_cylinder_joint(e.robot)) {
    add_pair("cylinder_up", c.up.inlet, c.up.exhaust, 2 * muscles);
    add_pair("cylinder_down", c.down.inlet, c.down.exhaust, 2 * muscles + 2);
  }
  add("supply", FaultPart::Kind::supply, 0);
  return out;
}

std::optional<FaultPart> part_of(const Fault& fault, const std::vector<FaultPart>& parts) {
  std::optional<FaultPart> out;
  for (const FaultPart& p : parts)
    if (p.name == fault.of && (!out || has_word(p.kind, fault.what))) out = p;
  return out;
}

}  // namespace sinew::experiment
