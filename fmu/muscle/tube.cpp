#include "fmu/muscle/tube.h"

#include <algorithm>
#include <tuple>

#include "fmu/muscle/muscle_fields.h"
#include "fmu/slave/discarded.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"

namespace sinew::fmu {

namespace {

struct TubeParts {
  actuator::Actuator& actuator;
  gas::Air& air;
  int& count;
  double& external_volume;
};

template <class Visitor>
void fields(Visitor& v, TubeParts parts) {
  bundle_fields(v, parts.count, parts.external_volume);
  v.group({.name = "actuator"}, [&](auto& g) { actuator::fields(g, parts.actuator); });
  v.group({.name = "air"}, [&](auto& g) { gas::fields(g, parts.air); });
}

}  // namespace

Description Tube::describe(const actuator::Actuator& actuator, const gas::Air& air, int count,
                           double external_volume) {
  actuator::Actuator a = actuator;  // visitors take fields by non-const reference
  gas::Air surroundings = air;
  Lister list("");
  fields(list, {a, surroundings, count, external_volume});
  Description out;
  out.add("kind", std::string(kind));
  write(list.found, out);
  return out;
}

Tube::Tube(const Description& description) {
  const std::vector<Parameter> read = parameters_of(description);
  Filler fill(read, "");
  fields(fill, {actuator_, air_, count_, external_volume_});
  Lister list("");
  fields(list, {actuator_, air_, count_, external_volume_});
  place_variables(list.found);
}

void Tube::place_variables(const std::vector<Parameter>& list) {
  using C = Variable::Causality;
  std::tie(at_.length, at_.rate) =
      add_length(sheet_, actuator_.long_end.length, "from end to end, with its caps");
  at_.pressure = sheet_.add({.name = "gauge_pressure",
                             .causality = C::input,
                             .unit = "Pa",
                             .min = -air_.atmosphere,
                             .max = 1e7,
                             .doc = "of its air, above the atmosphere"});
  const std::vector<int> all{static_cast<int>(at_.length), static_cast<int>(at_.rate),
                             static_cast<int>(at_.pressure)};
  const std::vector<int> still{all[0], all[2]};
  const auto output = [&](const char* name, const char* unit, const char* doc,
                          const std::vector<int>& follows) {
    return sheet_.add(
        {.name = name, .causality = C::output, .unit = unit, .doc = doc, .follows = follows});
  };
  at_.tension = output("tension", "N", "pull on both ends, without dry friction", all);
  at_.friction = output("friction", "N", "bound of the dry friction [33], [34]", still);
  at_.stiffness = output("stiffness", "N/m", "dF/dL at constant pressure [26]", still);
  at_.volume = output("volume", "m3", "of its air, with hoses", {all[0]});
  sheet_.add(list, is_idle);
}

void Tube::begin() {
  const std::vector<Parameter> set = sheet_.parameters();
  Filler fill(set, "");
  fields(fill, {actuator_, air_, count_, external_volume_});
}

double Tube::output(std::size_t place) const {
  const double length = sheet_.value(at_.length), pressure = sheet_.value(at_.pressure);
  if (const std::string why = wrong_length(actuator_, "length", length); !why.empty())
    throw Discarded(why);
  const double room = air_.atmosphere, n = count_;
  const actuator::Actuator& a = actuator_;
  if (place == at_.volume) return n * actuator::volume(a, length) + external_volume_;
  if (place == at_.tension) {
    const double rate = sheet_.value(at_.rate);
    return n * actuator::tension(a, length, rate, pressure, room);
  }
  if (place == at_.stiffness)
    return n * (actuator::stiffness_at_constant_pressure(a, length, pressure, room) +
                actuator::passive_stiffness(a, length, pressure, room));
  double sealed = 0;
  if (a.loss.coulomb_scale == actuator::Loss::Scale::sealed)
    sealed = actuator::stiffness_sealed(a, length, pressure + room, room, external_volume_ / n,
                                        air_.polytropic_exponent);
  return n * actuator::coulomb_bound(a, length, pressure, room, sealed);
}

}  // namespace sinew::fmu
