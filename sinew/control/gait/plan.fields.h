// control/gait/plan.fields.h - keys of [control], [sequence], [phase.<name>] and [[change]].
//
// Tables with one key per joint need the robot's joints, so the plan must come from
// plan_for(robot).
#pragma once

#include <string>

#include "sinew/control/gait/plan.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::gait {

template <class Visitor>
void fields(Visitor& v, Coordinate& c, bool of_x) {
  if (of_x)
    v.choice({.name = "of",
              .optional = true,
              .doc = "variable of the polynomial: s, 0 to 1 over the phase, or the foot's x"},
             c.of, {{"s", Coordinate::Of::s}, {"x", Coordinate::Of::x}});
  v.polynomial({.name = "polynomial",
                .unit = "m",
                .optional = true,
                .doc = "coordinate as a polynomial in s or x, lowest order first"},
               c.polynomial, c.of == Coordinate::Of::x ? "m" : "1");

  v.number({.name = "from",
            .unit = "m",
            .optional = true,
            .doc = "value at the phase's start, without a polynomial"},
           c.from);
  v.number({.name = "to",
            .unit = "m",
            .optional = true,
            .doc = "value at the phase's end, linear in time"},
           c.to);
}

template <class Visitor>
void fields(Visitor& v, Points& p) {
  v.numbers({.name = "x", .unit = "m", .doc = "x of the corners"}, p.x);
  v.numbers({.name = "y", .unit = "m", .doc = "y of the corners"}, p.y);
}

template <class Visitor>
void fields(Visitor& v, GainProfiles& g) {
  const auto gain = [&](std::string_view name, std::string_view unit, std::string_view doc,
                        Profile& profile) {
    v.numbers({.name = name, .unit = unit, .min = 0, .optional = true, .doc = doc}, profile);
  };
  gain("angle", "1/count", "gain of the angle law, G_theta [59]", g.angle);
  gain("stiffness", "1/(N m/rad)", "gain of the stiffness law, G_k [58]", g.stiffness);
  gain("velocity", "s/count", "gain of the velocity, G_v, thesis 6.5", g.velocity);
}

// Visits duties. The chambers of a cylinder are up and down in place of flexor and extensor.
template <class Visitor>
void fields(Visitor& v, DutyProfiles& d, bool cylinder = false) {
  const auto duty = [&](std::string_view name, Profile& profile) {
    v.numbers({.name = name,
               .unit = "1",
               .min = 0,
               .max = 1,
               .optional = true,
               .doc = "share of the period in which it is open"},
              profile);
  };
  duty(cylinder ? "up_inlet" : "flexor_inlet", d.flexor_inlet);
  duty(cylinder ? "up_exhaust" : "flexor_exhaust", d.flexor_exhaust);
  duty(cylinder ? "down_inlet" : "extensor_inlet", d.extensor_inlet);
  duty(cylinder ? "down_exhaust" : "extensor_exhaust", d.extensor_exhaust);
}

template <class Visitor>
void fields(Visitor& v, GroundForce& g) {
  v.number({.name = "desired", .unit = "N", .doc = "desired normal force on the foot [75]"},
           g.desired);
  units::amount(v, "gain", "m/N", "change of the path's height per force", g.gain);
  units::amount(v, "limit", "m", "largest correction of the height", g.limit);
}

template <class Visitor>
void fields(Visitor& v, CylinderPhase& c) {
  v.choice({.name = "of",
            .optional = true,
            .doc = "variable of the polynomial: s, 0 to 1 over the phase, or the foot's height"},
           c.of, {{"s", CylinderPhase::Of::s}, {"foot_y", CylinderPhase::Of::foot_y}});
  v.polynomial({.name = "polynomial",
                .unit = "m",
                .optional = true,
                .doc = "travel as a polynomial in s or the foot's height, lowest order first"},
               c.polynomial, c.of == CylinderPhase::Of::foot_y ? "m" : "1");
  v.numbers({.name = "position",
             .unit = "m",
             .optional = true,
             .doc = "travel up from the extended stop, over the phase"},
            c.position);
  v.group({.name = "feedforward",
           .optional = true,
           .doc = "duties (open loop) in place of the law in this phase"},
          [&](auto& g) { fields(g, c.feedforward, true); });
}

template <class Visitor>
void fields(Visitor& v, Until& until) {
  constexpr std::string_view measures =
      "foot.normal_force, foot.friction_force, joint.<name>.angle, joint.<name>.stiffness or "
      "muscle.<name>.tension";
  v.text({.name = "measure", .optional = true, .doc = measures}, until.measure);
  v.choice({.name = "is", .optional = true, .doc = "side of the level on which the phase ends"},
           until.is, {{"above", Until::Is::above}, {"below", Until::Is::below}});

  // Without a measure a level has no unit; only the missing measure is reported.
  const std::string_view unit = unit_of(until.measure);
  if (unit.empty() && !until.measure.empty()) {
    units::report_conflict(v, "measure", "\"" + until.measure + "\"", "a measured quantity",
                           std::string(measures));
    std::string level;
    v.text({.name = "level", .optional = true, .doc = "level that ends the phase"}, level);
    return;
  }
  v.number({.name = "level",
            .unit = unit.empty() ? "1" : unit,
            .optional = until.measure.empty(),
            .doc = "level that ends the phase"},
           until.level);
}

// Visits tables whose keys are the driven joints.
template <class Visitor>
void joint_fields(Visitor& v, const Plan& plan, Phase& phase) {
  phase.joints.resize(plan.joints.size());

  const auto profiles = [&](units::Field table, units::Field value, auto of) {
    v.group(table, [&](auto& g) {
      for (std::size_t i = 0; i < phase.joints.size(); ++i) {
        if (!plan.joints[i].driven) continue;
        value.name = plan.joints[i].name;
        g.numbers(value, of(phase.joints[i]));
      }
    });
  };
  const auto groups = [&](units::Field table, auto of) {
    v.group(table, [&](auto& g) {
      for (std::size_t i = 0; i < phase.joints.size(); ++i)
        if (plan.joints[i].driven)
          g.group({.name = plan.joints[i].name, .optional = true},
                  [&](auto& joint) { fields(joint, of(phase.joints[i])); });
    });
  };

  profiles(
      {.name = "joint_angles", .optional = true, .doc = "joint angles in place of the foot path"},
      {.unit = "rad", .optional = true, .doc = "desired angle over the phase"},
      [](JointPhase& j) -> Profile& { return j.angle; });
  profiles({.name = "stiffness", .optional = true, .doc = "desired stiffness from this phase on"},
           {.unit = "N m/rad",
            .min = 0,
            .max = 1e5,
            .why = "the joint controller accepts no more",
            .optional = true,
            .doc = "desired stiffness, K_des [58]"},
           [](JointPhase& j) -> Profile& { return j.stiffness; });
  groups({.name = "gains", .optional = true, .doc = "gains from this phase on"},
         [](JointPhase& j) -> GainProfiles& { return j.gains; });
  groups({.name = "feedforward",
          .optional = true,
          .doc = "duties (open loop) in place of the laws in this phase"},
         [](JointPhase& j) -> DutyProfiles& { return j.feedforward; });
}

template <class Visitor>
void fields(Visitor& v, const Plan& plan, Phase& phase) {
  v.number({.name = "duration",
            .unit = "s",
            .min = 0,
            .least = 1e-4,
            .why = "a tick",
            .doc = "duration of the phase; `until` may end it earlier"},
           phase.duration);
  units::optional_amount(v, "thesis_duration", "s",
                         "duration with thesis_timing, if it differs; 0: the same",
                         phase.thesis_duration);

  v.group({.name = "x", .optional = true, .doc = "x of the foot"},
          [&](auto& g) { fields(g, phase.x, false); });
  v.group({.name = "y", .optional = true, .doc = "y of the foot"},
          [&](auto& g) { fields(g, phase.y, true); });
  v.group({.name = "points",
           .optional = true,
           .doc = "polyline in place of x and y, at constant speed"},
          [&](auto& g) { fields(g, phase.points); });
  v.group({.name = "ground_force",
           .optional = true,
           .doc = "correction of the path's height by the measured normal force"},
          [&](auto& g) { fields(g, phase.ground_force); });
  v.group({.name = "cylinder", .optional = true, .doc = "travel of the body's air cylinder"},
          [&](auto& g) { fields(g, phase.cylinder); });

  joint_fields(v, plan, phase);
  v.texts({.name = "disabled", .optional = true, .doc = "joints that are not controlled"},
          phase.disabled);
  v.group({.name = "until", .optional = true, .doc = "measured quantity that ends the phase early"},
          [&](auto& g) { fields(g, phase.until); });
}

template <class Visitor>
void fields(Visitor& v, robot::Gains& g) {
  units::optional_amount(v, "angle", "1/count", "gain of the angle law, G_theta [59]", g.angle);
  units::optional_amount(v, "stiffness", "1/(N m/rad)", "gain of the stiffness law, G_k [58]",
                         g.stiffness);
  units::optional_amount(v, "velocity", "s/count", "gain of the velocity, G_v, thesis 6.5",
                         g.velocity);
}

// Keys of [control].
template <class Visitor>
void control_fields(Visitor& v, Plan& plan) {
  v.number({.name = "high_level_period",
            .unit = "s",
            .min = 1e-3,
            .max = 1,
            .optional = true,
            .doc = "period of the gait controller, a multiple of the joint controller's"},
           plan.high_level_period);
  v.group({.name = "stiffness", .doc = "desired stiffness, K_des [58], until a phase sets another"},
          [&](auto& g) {
            for (JointPlan& joint : plan.joints)
              if (joint.driven)
                g.number({.name = joint.name,
                          .unit = "N m/rad",
                          .min = 0,
                          .max = 1e5,
                          .why = "the joint controller accepts no more",
                          .doc = "desired stiffness"},
                         joint.stiffness);
          });
  v.group({.name = "joint_range",
           .optional = true,
           .doc = "limits of the desired angles in every phase"},
          [&](auto& g) {
            for (JointPlan& joint : plan.joints)
              if (joint.driven)
                g.numbers({.name = joint.name,
                           .unit = "rad",
                           .optional = true,
                           .doc = "lowest and highest angle"},
                          joint.range);
          });
  v.group({.name = "gains", .optional = true, .doc = "gains in place of the robot's"},
          [&](auto& g) {
            for (JointPlan& joint : plan.joints)
              if (joint.driven)
                g.group({.name = joint.name, .optional = true},
                        [&](auto& gains) { fields(gains, joint.gains); });
          });
}

template <class Visitor>
void fields(Visitor& v, Change& c) {
  constexpr std::string_view keys =
      "control.angle.<joint>, control.stiffness.<joint>, or control.gains.<joint>.angle, "
      ".stiffness or .velocity";
  units::amount(v, "time", "s", "time of the change; it takes effect at the next period start",
                c.time);
  v.text({.name = "key", .doc = keys}, c.key);
  v.text(
      {.name = "leg", .optional = true, .doc = "leg, of a robot with several; absent: every leg"},
      c.leg);
  v.flag({.name = "release", .optional = true, .doc = "true: the plan's own value again"},
         c.release);

  // Without a key the value has no unit; only the missing key is reported.
  const std::string_view unit = unit_of_setting(c.key);
  if (unit.empty() && !c.key.empty()) {
    units::report_conflict(v, "key", "\"" + c.key + "\"", std::string(keys));
    std::string value;
    v.text({.name = "value", .optional = true, .doc = "value in place of the plan's"}, value);
    return;
  }
  v.number({.name = "value",
            .unit = unit.empty() ? "1" : unit,
            .min = 0,
            .max = Setting::most,
            .optional = true,
            .doc = "value in place of the plan's, until the end or its release"},
           c.value);
}

template <class Visitor>
void fields(Visitor& v, Plan& plan) {
  v.group({.name = "control", .doc = "values until a phase sets others"},
          [&](auto& g) { control_fields(g, plan); });
  v.group({.name = "sequence", .doc = "phases of a step"}, [&](auto& g) {
    g.texts({.name = "phases", .doc = "names of the phases in their order"}, plan.sequence);
    g.integer({.name = "repeat", .min = 1, .max = 1e6, .optional = true, .doc = "number of steps"},
              plan.repeat);
    g.choice({.name = "finish",
              .optional = true,
              .doc = "vent: exhausts open, then shut; hold: the last command stays"},
             plan.finish, {{"vent", Plan::Finish::vent}, {"hold", Plan::Finish::hold}});
    g.flag({.name = "thesis_timing",
            .optional = true,
            .doc = "true: one more period per phase, as in the thesis's program"},
           plan.thesis_timing);
  });
  v.each({.name = "plan", .optional = true, .doc = "other sequences of phases, for legs"},
         plan.others, [](auto& g, Sequence& other) {
           g.texts({.name = "phases", .doc = "names of the phases in their order"}, other.phases);
         });
  v.each({.name = "phase", .doc = "phases, by name"}, plan.phases,
         [&](auto& g, Phase& phase) { fields(g, plan, phase); });
  v.list({.name = "change",
          .optional = true,
          .doc = "changes of stiffness, angle or gains during the run"},
         plan.changes, [](auto& g, Change& c) { fields(g, c); });
}

}  // namespace sinew::gait
