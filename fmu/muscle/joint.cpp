#include "fmu/muscle/joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "fmu/muscle/muscle_fields.h"
#include "fmu/slave/discarded.h"
#include "fmu/slave/saved.h"
#include "sinew/robot/muscle.fields.h"

namespace sinew::fmu {

namespace {

using Causality = Variable::Causality;

// Visits the fields of a joint that a muscle's route needs.
template <class Visitor>
void route_fields(Visitor& v, robot::Joint& joint) {
  using Flexion = robot::Joint::Flexion;
  v.number({.name = "rest_angle",
            .unit = "rad",
            .min = 0,
            .max = 6.283185307179586,
            .doc = "where its muscles have their mount_length"},
           joint.rest_angle);
  v.choice({.name = "flexion", .doc = "effect of a shorter flexor on the angle"}, joint.flexion,
           {{"raises angle", Flexion::raises_angle}, {"lowers angle", Flexion::lowers_angle}});
  v.number({.name = "moment_arm", .unit = "m", .min = 1e-4, .doc = "radius of the cam"},
           joint.moment_arm);
}

template <class Visitor>
void route_fields(Visitor& v, robot::Muscle& muscle) {
  using Role = robot::Muscle::Role;
  const auto role = [](auto& g, Role& value) {
    g.choice({.name = "role", .doc = "which way it pulls"}, value,
             {{"flexor", Role::flexor}, {"extensor", Role::extensor}});
  };
  v.text({.name = "joint", .doc = "that it pulls"}, muscle.joint);
  role(v, muscle.role);
  v.number({.name = "mount_length", .unit = "m", .min = 1e-4, .doc = "at the rest angle"},
           muscle.mount_length);
  robot::fields(v, muscle.cam);
  v.group({.name = "second"}, [&](auto& g) {
    g.text({.name = "joint", .doc = "another one that it runs across"}, muscle.second.joint);
    role(g, muscle.second.role);
    robot::fields(g, muscle.second.cam);
  });
}

bool crosses(const robot::Muscle& m, const std::string& joint) {
  return m.joint == joint || m.second.joint == joint;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns the robot's joint of that name. Throws if it does not exist or if no muscle crosses it.
const robot::Joint& pulled_joint(const robot::Robot& robot, const std::string& name) {
  const int at = robot::find_joint(robot, name);
  if (at < 0) throw std::invalid_argument("joint: found \"" + name + "\", which the robot has not");
  if (std::ranges::none_of(robot.muscles, [&](const auto& m) { return crosses(m, name); }))
    throw std::invalid_argument("joint: found \"" + name + "\", which no muscle pulls");
  return robot.joints[static_cast<std::size_t>(at)];
}

void refuse_unnamed(const robot::Muscle& m, const std::vector<std::string>& joints) {
  for (const std::string& crossed : {m.joint, m.second.joint})
    if (!crossed.empty() && !has(joints, crossed))
      throw std::invalid_argument("joint: muscle " + m.name + " also crosses " + crossed +
                                  "; expected both joints in one FMU: name " + crossed + " too");
}

}  // namespace

template <class Visitor>
void Joint::visit(Visitor& v) {
  for (robot::Joint& joint : robot_.joints)
    v.group({.name = "joint"}, [&](auto& all) {
      all.group({.name = joint.name}, [&](auto& g) { route_fields(g, joint); });
    });
  for (std::size_t m = 0; m < pulls_.size(); ++m)
    v.group({.name = "muscle"}, [&](auto& all) {
      all.group({.name = pulls_[m].muscle.name}, [&](auto& g) {
        route_fields(g, robot_.muscles[m]);
        fields(g, pulls_[m].muscle);
      });
    });
  v.group({.name = "air"}, [&](auto& g) { gas::fields(g, air_, supply_); });
}

Description Joint::describe(const robot::Robot& robot, const std::vector<air::Muscle>& muscles,
                            const std::vector<std::string>& joints, const gas::Air& air,
                            const gas::Supply& supply, double pressure) {
  if (supply.kind == gas::Supply::Kind::tank)
    throw std::invalid_argument(
        "air.supply.kind: found a tank, which several muscles would empty together; expected "
        "\"constant\" for a joint's FMU: try air.supply.kind=constant");
  Description out;
  out.add("kind", std::string(kind));
  out.add("start.pressure", text_of(pressure));

  std::vector<Parameter> list;
  const auto keep = [&](const std::string& prefix, const auto& describe) {
    Lister lister(prefix);
    describe(lister);
    list.insert(list.end(), lister.found.begin(), lister.found.end());
  };
  for (const std::string& name : joints) {
    robot::Joint joint = pulled_joint(robot, name);
    out.add("joint", name);
    keep("joint." + name + ".", [&](Lister& v) { route_fields(v, joint); });
  }
  for (std::size_t m = 0; m < robot.muscles.size(); ++m) {
    robot::Muscle route = robot.muscles[m];
    if (!has(joints, route.joint) && !has(joints, route.second.joint)) continue;
    refuse_unnamed(route, joints);
    air::Muscle muscle = muscles[m];
    out.add("muscle", route.name);
    keep("muscle." + route.name + ".", [&](Lister& v) {
      route_fields(v, route);
      fields(v, muscle);
    });
  }
  gas::Air a = air;
  gas::Supply s = supply;
  keep("air.", [&](Lister& v) { gas::fields(v, a, s); });
  write(list, out);
  return out;
}

Joint::Joint(const Description& description) {
  const std::vector<Parameter> read = parameters_of(description);
  for (const std::string& name : description.all("joint")) robot_.joints.emplace_back().name = name;
  for (const std::string& name : description.all("muscle")) {
    robot_.muscles.emplace_back().name = name;
    air::Muscle& muscle = pulls_.emplace_back().muscle;
    muscle.name = name;
    muscle.inlet.kind = inlet_kind(read, "muscle." + name + ".");
  }
  Filler fill(read, "");
  visit(fill);
  place_variables(number_of("start.pressure", description.at("start.pressure")));
}

void Joint::place_variables(double pressure) {
  constexpr double turns = 100;  // [rad]
  for (const robot::Joint& joint : robot_.joints) {
    Places& at = at_.emplace_back();
    at.angle = sheet_.add({.name = structured(joint.name) + ".angle",
                           .causality = Causality::input,
                           .unit = "rad",
                           .start = joint.rest_angle,
                           .min = -turns,
                           .max = turns,
                           .doc = "at the step's begin, counter-clockwise",
                           .rate = static_cast<int>(sheet_.variables().size()) + 1});
    at.rate = sheet_.add({.name = structured(joint.name) + ".rate",
                          .causality = Causality::input,
                          .unit = "rad/s",
                          .min = -1e5,
                          .max = 1e5,
                          .doc = "of the angle, > 0 raises it"});
  }
  for (Pull& pull : pulls_)
    pull.valves = add_valves(sheet_, pull.muscle, structured(pull.muscle.name) + ".");
  place_outputs();
  initial_pressure_ = sheet_.add({.name = "initial_pressure",
                                  .unit = "Pa",
                                  .start = pressure,
                                  .min = 1e3,
                                  .max = 1e7,
                                  .doc = "of every muscle's air at the start, absolute"});
  Lister list("");
  visit(list);
  sheet_.add(list.found, is_idle);
}

void Joint::place_outputs() {
  const auto output = [&](const std::string& name, const char* unit, const char* doc) {
    return sheet_.add({.name = name, .causality = Causality::output, .unit = unit, .doc = doc});
  };
  for (std::size_t j = 0; j < at_.size(); ++j) {
    const std::string name = structured(robot_.joints[j].name);
    at_[j].torque = output(name + ".torque", "N m", "of its muscles; > 0 raises the angle");
    at_[j].friction = output(name + ".friction", "N m", "bound of the meshes' dry friction");
  }
  for (Pull& pull : pulls_) {
    const std::string name = structured(pull.muscle.name);
    pull.tension = output(name + ".tension", "N", "pull on both ends");
    pull.pressure = output(name + ".pressure", "Pa", "of its air, absolute");
    pull.length = output(name + ".length", "m", "by the cams");
    pull.mass = output(name + ".air_mass", "kg", "that muscle and hose hold");
  }
}

void Joint::lengths_at(std::span<const double> angles, Lengths& lengths,
                       Arms& arms) const noexcept {
  static constexpr std::array<double, robot::max_joints> still{};
  Lengths rates;
  routing_->at<most>(angles.data(), still.data(), lengths, rates, arms);
}

// Returns the name and length of a muscle with an impossible length; empty if all are possible.
std::string Joint::wrong_at(std::span<const double> angles) const {
  Lengths lengths;
  Arms arms{};
  lengths_at(angles, lengths, arms);
  for (std::size_t m = 0; m < pulls_.size(); ++m) {
    const air::Muscle& muscle = pulls_[m].muscle;
    const double length = lengths[static_cast<int>(m)];
    std::string why = wrong_length(muscle.actuator, muscle.name + ".length", length);
    if (!why.empty()) return why + ", by the angles of its joints, which are in rad";
  }
  return {};
}

std::vector<double> Joint::angles_after(double step) const {
  std::vector<double> out;
  for (const Places& at : at_) out.push_back(sheet_.value(at.angle) + sheet_.value(at.rate) * step);
  return out;
}

std::string Joint::refusal(double step) const { return wrong_at(angles_after(step)); }

void Joint::begin() {
  const std::vector<Parameter> set = sheet_.parameters();
  Filler fill(set, "");
  visit(fill);
  routing_.emplace(robot_);
  angles_ = angles_after(0);
  if (const std::string why = wrong_at(angles_); !why.empty()) throw Discarded(why);
  Lengths lengths;
  lengths_at(angles_, lengths, arms_);
  for (std::size_t m = 0; m < pulls_.size(); ++m) {
    pulls_[m].driven.emplace(pulls_[m].muscle, air_, supply_, lengths[static_cast<int>(m)],
                             sheet_.value(initial_pressure_));
    pulls_[m].commanded = {};
  }
}

// Returns the torque of the muscles, or the bound of their dry friction [N m].
double Joint::of_joint(std::size_t joint, bool friction) const noexcept {
  double sum = 0;
  routing_->each(arms_, [&](int m, std::size_t j, double arm) {
    const air::DrivenMuscle& muscle = *pulls_[static_cast<std::size_t>(m)].driven;
    if (j == joint) sum += friction ? std::abs(arm) * muscle.friction() : arm * muscle.tension();
  });
  return sum;
}

double Joint::output(std::size_t place) const {
  for (std::size_t j = 0; j < at_.size(); ++j)
    if (place == at_[j].torque || place == at_[j].friction)
      return of_joint(j, place == at_[j].friction);
  for (const Pull& pull : pulls_) {
    if (place == pull.tension) return pull.driven->tension();
    if (place == pull.pressure) return pull.driven->pressure();
    if (place == pull.length) return pull.driven->length();
    if (place == pull.mass) return pull.driven->air_mass();
  }
  return 0;  // all outputs are handled above
}

const char* Joint::advance(double, double step) noexcept {
  for (std::size_t j = 0; j < at_.size(); ++j)
    angles_[j] = sheet_.value(at_[j].angle) + sheet_.value(at_[j].rate) * step;
  Lengths lengths;
  lengths_at(angles_, lengths, arms_);
  for (std::size_t m = 0; m < pulls_.size(); ++m) {
    Pull& pull = pulls_[m];
    command(*pull.driven, sheet_, pull.valves, pull.commanded);
    pull.driven->advance(step, lengths[static_cast<int>(m)]);
    if (pull.driven->failed())
      return "a muscle's state is not finite: an angle or a parameter is beyond what the "
             "laws hold for";
  }
  return nullptr;
}

std::vector<std::byte> Joint::save() const {
  std::vector<std::byte> out;
  for (const double angle : angles_) append(out, angle);
  for (const Pull& pull : pulls_) {
    append(out, pull.driven->state());
    append(out, pull.commanded);
  }
  return out;
}

void Joint::restore(std::span<const std::byte> saved) {
  for (double& angle : angles_) angle = take<double>(saved);
  Lengths lengths;
  lengths_at(angles_, lengths, arms_);
  for (Pull& pull : pulls_) {
    pull.driven->restore(take<air::DrivenMuscle::State>(saved));
    pull.commanded = take<Commanded>(saved);
  }
}

}  // namespace sinew::fmu
