// robot/body.fields.h - the keys of a robot's body: trolley, rollers, cylinder, links, foot and
// ground.
#pragma once

#include "sinew/robot/control.fields.h"
#include "sinew/robot/robot.h"
#include "sinew/units/field.h"

namespace sinew::robot {

template <class Visitor>
void fields(Visitor& v, Trolley& trolley) {
  v.flag({.name = "present", .doc = "false: the first joint is fixed to the world"},
         trolley.present);
  v.number({.name = "total_mass",
            .unit = "kg",
            .min = 0,
            .doc = "everything that moves along the track, links and foot included"},
           trolley.total_mass);
  v.number({.name = "drag", .unit = "N", .min = 0, .doc = "dry, against the motion"}, trolley.drag);
  v.number({.name = "breakaway",
            .unit = "N",
            .min = 0,
            .optional = true,
            .doc = "dry friction at rest, where it is above the drag"},
           trolley.breakaway);
  v.number({.name = "track_length", .unit = "m", .min = 0, .doc = "from the start to the stop"},
           trolley.track_length);
  v.number({.name = "stop_stiffness", .unit = "N/m", .min = 0, .doc = "of the track's end"},
           trolley.stop_stiffness);
  v.number({.name = "stop_damping", .unit = "N s/m", .min = 0, .doc = "of the track's end"},
           trolley.stop_damping);
  v.number({.name = "payload",
            .unit = "kg",
            .min = 0,
            .optional = true,
            .doc = "rides on the trolley, in addition to the total mass"},
           trolley.payload);
}

template <class Visitor>
void fields(Visitor& v, Rollers& rollers) {
  const auto at = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "m", .doc = doc}, value);
  };
  v.flag({.name = "present", .doc = "false: no load is reported"}, rollers.present);
  at("front", "ahead of the first joint", rollers.front);
  at("rear", "ahead of the first joint, below 0", rollers.rear);
  at("height", "of the track above the first joint, cylinder extended", rollers.height);
  v.number({.name = "counterweight", .unit = "kg", .min = 0, .doc = "part of the total mass"},
           rollers.counterweight);
  at("counterweight_at", "ahead of the first joint", rollers.counterweight_at);
  at("center_of_mass", "of the trolley without it, ahead of the first joint",
     rollers.center_of_mass);
  at("center_of_mass_up", "the same, above the first joint", rollers.center_of_mass_up);
}

template <class Visitor>
void fields(Visitor& v, Cylinder::Chamber& chamber) {
  const auto bit = units::Field{
      .name = "bit", .min = 0, .max = 31, .optional = true, .doc = "of its board's output ports"};
  v.number({.name = "dead_volume",
            .unit = "m3",
            .min = 0,
            .doc = "of the chamber at its end of the stroke, with its hoses"},
           chamber.dead_volume);
  v.group({.name = "inlet", .optional = true, .doc = "the valve that fills"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, chamber.inlet);
    g.integer(bit, chamber.inlet_bit);
  });
  v.group({.name = "exhaust", .optional = true, .doc = "the valve that empties"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, chamber.exhaust);
    g.integer(bit, chamber.exhaust_bit);
  });
}

// Visits the keys of a position loop and of a regulator.
template <class Visitor>
void mode_fields(Visitor& v, Cylinder& c) {
  const auto share = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "1", .min = 0, .max = 1, .optional = true, .doc = doc}, value);
  };
  board_field(v, c.board);
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 0,
            .optional = true,
            .doc = "regulator: what the chamber `down` is kept at"},
           c.pressure);
  v.number({.name = "position_gain",
            .unit = "1/count",
            .min = 0,
            .optional = true,
            .doc = "valves: of the position loop, B.1"},
           c.position_gain);
  share("up_feedforward", "valves: duty of both valves of `up` at no error, B.1", c.up_feedforward);
  share("down_feedforward", "valves: the same of `down`", c.down_feedforward);
}

template <class Visitor>
void fields(Visitor& v, Cylinder& c) {
  const auto length = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "m", .min = 0, .doc = doc}, value);
  };
  v.flag({.name = "present", .doc = "false: the first joint keeps its height"}, c.present);
  v.choice(
      {.name = "mode", .doc = "locked: at the extended stop; free: without air, the body slides"},
      c.mode,
      {{"locked", Cylinder::Mode::locked},
       {"regulator", Cylinder::Mode::regulator},
       {"valves", Cylinder::Mode::valves},
       {"free", Cylinder::Mode::free}});
  length("bore", "of the cylinder", c.bore);
  length("rod_diameter", "of its rod, on the side of `up`", c.rod_diameter);
  length("stroke", "upwards from the extended stop", c.stroke);
  v.number({.name = "body_mass",
            .unit = "kg",
            .min = 0,
            .least = 1e-9,
            .why = "a body that moves weighs a microgram",
            .doc = "moves up and down, apart from links and foot; part of the total mass"},
           c.body_mass);
  v.number({.name = "friction", .unit = "N", .min = 0, .doc = "of piston and bearings, dry"},
           c.friction);
  v.number({.name = "damping", .unit = "N s/m", .min = 0, .doc = "viscous"}, c.damping);
  v.number({.name = "stop_stiffness", .unit = "N/m", .min = 0, .doc = "of the stroke's ends"},
           c.stop_stiffness);
  v.number({.name = "stop_damping", .unit = "N s/m", .min = 0, .doc = "of the stroke's ends"},
           c.stop_damping);
  v.group({.name = "up", .doc = "the chamber that pushes the body up, on the rod's side"},
          [&](auto& g) { fields(g, c.up); });
  v.group({.name = "down", .doc = "the chamber that pushes the body down"},
          [&](auto& g) { fields(g, c.down); });
  mode_fields(v, c);
}

template <class Visitor>
void fields(Visitor& v, Link& link) {
  v.number({.name = "length", .unit = "m", .min = 1e-4, .doc = "joint to joint, or joint to foot"},
           link.length);
  v.number({.name = "mass",
            .unit = "kg",
            .min = 1e-9,
            .why = "a link has a mass, a cricket's too",
            .doc = "without what is named elsewhere"},
           link.mass);
  v.number({.name = "center_of_mass", .unit = "m", .min = 0, .doc = "from the proximal joint"},
           link.center_of_mass);
  v.number({.name = "inertia",
            .unit = "kg m2",
            .min = 1e-16,
            .why = "a link has an inertia, a cricket's too",
            .doc = "about the centre of mass"},
           link.inertia);
  v.text({.name = "parent",
          .optional = true,
          .doc = "link that it hangs on, or body; absent: the one before, the first on the body"},
         link.parent);
  v.number({.name = "at",
            .unit = "m",
            .optional = true,
            .doc = "along its parent, absent: at its end; on the body: ahead of its origin"},
           link.at);
}

template <class Visitor>
void fields(Visitor& v, Foot& foot) {
  v.flag({.name = "present", .doc = "false: nothing ever touches the ground"}, foot.present);
  v.number({.name = "mass", .unit = "kg", .min = 0, .doc = "at the end of the last link"},
           foot.mass);
  v.number({.name = "radius", .unit = "m", .min = 0, .doc = "of a disc about the ankle"},
           foot.radius);
  v.number(
      {.name = "friction", .unit = "1", .min = 0, .max = 10, .doc = "Coulomb, static = sliding"},
      foot.friction);
  v.each({.name = "point", .optional = true, .doc = "discs in place of the one at the link's end"},
         foot.points, [](auto& g, Foot::Point& p) {
           g.number({.name = "along", .unit = "m", .doc = "from the last joint along its link"},
                    p.along);
           g.number({.name = "across", .unit = "m", .doc = "to the left of the link's direction"},
                    p.across);
           g.number({.name = "radius", .unit = "m", .min = 0, .doc = "of the disc"}, p.radius);
         });
}

template <class Visitor>
void fields(Visitor& v, Leg& leg) {
  v.texts({.name = "joints", .doc = "of the leg, from the body outwards; each <leg>_<name>"},
          leg.joints);
  v.group({.name = "foot", .optional = true, .doc = "in place of [foot]"},
          [&](auto& g) { fields(g, leg.foot); });
  v.text({.name = "plan",
          .optional = true,
          .doc = "[plan.<name>] of the experiment, that it follows; absent: [sequence]"},
         leg.plan);
  v.number({.name = "offset",
            .unit = "1",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "by which its sequence is ahead, as a share of a step"},
           leg.offset);
}

template <class Visitor>
void fields(Visitor& v, Ground& ground) {
  v.flag({.name = "present", .doc = "false: the leg hangs in the air"}, ground.present);
  v.number({.name = "height",
            .unit = "m",
            .doc = "of the ankle point at contact, below the first joint"},
           ground.height);
  v.number({.name = "normal_stiffness", .unit = "N/m", .min = 0, .doc = "of the contact"},
           ground.normal_stiffness);
  v.number({.name = "normal_damping", .unit = "N s/m", .min = 0, .doc = "of the contact"},
           ground.normal_damping);
}

}  // namespace sinew::robot
