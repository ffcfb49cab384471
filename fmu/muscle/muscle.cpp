#include "fmu/muscle/muscle.h"

#include <tuple>

#include "fmu/muscle/muscle_fields.h"
#include "fmu/slave/discarded.h"
#include "fmu/slave/saved.h"

namespace sinew::fmu {

namespace {

using Causality = Variable::Causality;
using Kind = gas::Valve::Kind;

template <class Visitor>
void all_fields(Visitor& v, air::Muscle& muscle, gas::Air& air, gas::Supply& supply) {
  fields(v, muscle);
  v.group({.name = "air"}, [&](auto& g) { gas::fields(g, air, supply); });
}

}  // namespace

ValvePlaces add_valves(Sheet& sheet, const air::Muscle& muscle, const std::string& prefix) {
  ValvePlaces out;
  const auto current = [&](const char* name, const char* doc) {
    return sheet.add({.name = prefix + name,
                      .type = Variable::Type::boolean,
                      .causality = Causality::input,
                      .min = 0,
                      .max = 1,
                      .doc = doc});
  };
  if (muscle.inlet.kind == Kind::regulator) {
    out.set_point = sheet.add({.name = prefix + "set_point",
                               .causality = Causality::input,
                               .min = 0,
                               .max = 1,
                               .doc = "of the pressure regulator, a share of its range"});
    return out;
  }
  const bool three_way = muscle.inlet.kind == Kind::three_way;
  out.inlet =
      current("inlet", three_way ? "has the 3-way valve's coil current? on: supply, off: room"
                                 : "has the inlet's coil current? on: it opens");
  if (!three_way) out.exhaust = current("exhaust", "has the exhaust's coil current? on: it opens");
  return out;
}

Kind inlet_kind(const std::vector<Parameter>& list, const std::string& prefix) {
  Kind out = Kind::two_way;
  for (const Parameter& p : list) {
    if (p.name != prefix + "inlet.kind") continue;
    if (p.word == "3-way") out = Kind::three_way;
    if (p.word == "regulator") out = Kind::regulator;
  }
  return out;
}

void command(air::DrivenMuscle& muscle, const Sheet& sheet, const ValvePlaces& at,
             Commanded& commanded) noexcept {
  const auto changed = [&](std::size_t place, double& before) {
    if (place == 0 || sheet.value(place) == before) return false;
    before = sheet.value(place);
    return true;
  };
  if (changed(at.inlet, commanded.inlet)) muscle.inlet(commanded.inlet != 0);
  if (changed(at.exhaust, commanded.exhaust)) muscle.exhaust(commanded.exhaust != 0);
  if (changed(at.set_point, commanded.set_point)) muscle.set_point(commanded.set_point);
}

Description Muscle::describe(const air::Muscle& muscle, const gas::Air& air,
                             const gas::Supply& supply, const MuscleStart& start) {
  air::Muscle m = muscle;  // visitors take fields by non-const reference
  gas::Air a = air;
  gas::Supply s = supply;
  Lister list("");
  all_fields(list, m, a, s);
  Description out;
  out.add("kind", std::string(kind));
  out.add("start.length", text_of(start.length));
  out.add("start.pressure", text_of(start.pressure));
  write(list.found, out);
  return out;
}

Muscle::Muscle(const Description& description) {
  const std::vector<Parameter> read = parameters_of(description);
  muscle_.inlet.kind = inlet_kind(read, "");
  Filler fill(read, "");
  all_fields(fill, muscle_, air_, supply_);
  Lister list("");
  all_fields(list, muscle_, air_, supply_);
  place_variables(list.found, {number_of("start.length", description.at("start.length")),
                               number_of("start.pressure", description.at("start.pressure"))});
}

void Muscle::place_variables(const std::vector<Parameter>& list, const MuscleStart& start) {
  std::tie(at_.length, at_.rate) =
      add_length(sheet_, start.length, "from end to end at the step's begin, with its caps");
  at_.valves = add_valves(sheet_, muscle_, "");
  const auto output = [&](const char* name, const char* unit, const char* doc) {
    return sheet_.add({.name = name, .causality = Causality::output, .unit = unit, .doc = doc});
  };
  at_.tension = output("tension", "N", "pull on both ends, static and viscous");
  at_.friction = output("friction", "N", "bound of the dry friction [33], [34]");
  at_.pressure = output("pressure", "Pa", "of its air, absolute");
  at_.gauge = output("gauge_pressure", "Pa", "of its air, above the atmosphere");
  at_.mass = output("air_mass", "kg", "that muscle and hose hold");
  at_.used = output("air_used", "kg", "that has come through the inlet");
  at_.initial_pressure = sheet_.add({.name = "initial_pressure",
                                     .unit = "Pa",
                                     .start = start.pressure,
                                     .min = 1e3,
                                     .max = 1e7,
                                     .doc = "of its air at the start, absolute"});
  sheet_.add(list, is_idle);
}

void Muscle::begin() {
  const std::vector<Parameter> set = sheet_.parameters();
  Filler fill(set, "");
  all_fields(fill, muscle_, air_, supply_);
  const double length = sheet_.value(at_.length);
  if (const std::string why = wrong_length(muscle_.actuator, "length", length); !why.empty())
    throw Discarded(why);
  driven_.emplace(muscle_, air_, supply_, length, sheet_.value(at_.initial_pressure));
  commanded_ = {};
}

double Muscle::output(std::size_t place) const {
  if (place == at_.tension) return driven_->tension();
  if (place == at_.friction) return driven_->friction();
  if (place == at_.pressure) return driven_->pressure();
  if (place == at_.gauge) return driven_->pressure() - air_.atmosphere;
  if (place == at_.mass) return driven_->air_mass();
  return driven_->account().in;
}

std::string Muscle::refusal(double step) const {
  return wrong_length(muscle_.actuator, "length + rate x step", length_after(step));
}

const char* Muscle::advance(double, double step) noexcept {
  command(*driven_, sheet_, at_.valves, commanded_);
  driven_->advance(step, length_after(step));
  return driven_->failed() ? "the muscle's state is not finite: its length or its "
                             "parameters are beyond what the laws hold for"
                           : nullptr;
}

std::vector<std::byte> Muscle::save() const {
  std::vector<std::byte> out;
  append(out, driven_->state());
  append(out, commanded_);
  return out;
}

void Muscle::restore(std::span<const std::byte> saved) {
  const auto state = take<air::DrivenMuscle::State>(saved);
  commanded_ = take<Commanded>(saved);
  driven_->restore(state);
}

}  // namespace sinew::fmu
