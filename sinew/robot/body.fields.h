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
  units::amount(v, "total_mass", "kg",
                "mass of all that moves along the track, links and foot included",
                trolley.total_mass);
  units::amount(v, "drag", "N", "dry friction while it rolls", trolley.drag);
  units::optional_amount(v, "breakaway", "N", "force that starts it; below the drag: the drag",
                         trolley.breakaway);
  units::amount(v, "track_length", "m", "distance from the start to the stop",
                trolley.track_length);
  units::amount(v, "stop_stiffness", "N/m", "stiffness of the stop at the track's end",
                trolley.stop_stiffness);
  units::amount(v, "stop_damping", "N s/m", "damping of the stop at the track's end",
                trolley.stop_damping);
  units::optional_amount(v, "payload", "kg", "mass on the trolley in addition to total_mass",
                         trolley.payload);
}

template <class Visitor>
void fields(Visitor& v, Rollers& rollers) {
  const auto at = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "m", .doc = doc}, value);
  };
  v.flag({.name = "present", .doc = "false: the rollers' loads are not reported"}, rollers.present);
  at("front", "position of the front roller, ahead of the first joint", rollers.front);
  at("rear", "position of the rear roller ahead of the first joint, negative", rollers.rear);
  at("height", "height of the track above the first joint, cylinder extended", rollers.height);
  units::amount(v, "counterweight", "kg", "mass of the counterweight, part of total_mass",
                rollers.counterweight);
  at("counterweight_at", "position of the counterweight, ahead of the first joint",
     rollers.counterweight_at);
  at("center_of_mass",
     "centre of mass of the trolley without counterweight, ahead of the first joint",
     rollers.center_of_mass);
  at("center_of_mass_up", "height of that centre of mass above the first joint",
     rollers.center_of_mass_up);
}

template <class Visitor>
void fields(Visitor& v, Cylinder::Chamber& chamber) {
  const auto bit = units::Field{.name = "bit",
                                .min = 0,
                                .max = 31,
                                .optional = true,
                                .doc = "bit of its board's output ports"};
  units::amount(v, "dead_volume", "m3", "air volume with hoses at the chamber's end of the stroke",
                chamber.dead_volume);
  v.group({.name = "inlet", .optional = true, .doc = "inlet valve, which fills"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, chamber.inlet);
    g.integer(bit, chamber.inlet_bit);
  });
  v.group({.name = "exhaust", .optional = true, .doc = "exhaust valve, which empties"},
          [&](auto& g) {
            g.text({.name = "valve", .doc = "name in the valves file"}, chamber.exhaust);
            g.integer(bit, chamber.exhaust_bit);
          });
}

// Visits the keys of a position loop and of a regulator.
template <class Visitor>
void mode_fields(Visitor& v, Cylinder& c) {
  board_field(v, c.board);
  units::optional_amount(v, "pressure", "Pa abs", "regulator: pressure of the chamber `down`",
                         c.pressure);
  units::optional_amount(v, "position_gain", "1/count", "valves: gain of the position loop, B.1",
                         c.position_gain);
  units::optional_share(v, "up_feedforward",
                        "valves: duty of both valves of `up` at zero error, B.1", c.up_feedforward);
  units::optional_share(v, "down_feedforward",
                        "valves: duty of both valves of `down` at zero error, B.1",
                        c.down_feedforward);
}

template <class Visitor>
void fields(Visitor& v, Cylinder& c) {
  v.flag({.name = "present", .doc = "false: the first joint keeps its height"}, c.present);
  v.choice({.name = "mode",
            .doc = "locked: at the extended stop; regulator: constant pressure in `down`; valves: "
                   "a position loop; free: no air, the body slides"},
           c.mode,
           {{"locked", Cylinder::Mode::locked},
            {"regulator", Cylinder::Mode::regulator},
            {"valves", Cylinder::Mode::valves},
            {"free", Cylinder::Mode::free}});
  units::amount(v, "bore", "m", "diameter of the piston", c.bore);
  units::amount(v, "rod_diameter", "m", "diameter of the rod, on the side of `up`", c.rod_diameter);
  units::amount(v, "stroke", "m", "travel, upwards from the extended stop", c.stroke);
  v.number({.name = "body_mass",
            .unit = "kg",
            .min = 0,
            .least = 1e-9,
            .why = "a body that moves weighs a microgram",
            .doc = "mass that moves up and down, without links and foot; part of total_mass"},
           c.body_mass);
  units::amount(v, "friction", "N", "dry friction of piston and bearings", c.friction);
  units::amount(v, "damping", "N s/m", "viscous damping", c.damping);
  units::amount(v, "stop_stiffness", "N/m", "stiffness of the stops at both ends of the stroke",
                c.stop_stiffness);
  units::amount(v, "stop_damping", "N s/m", "damping of the stops at both ends of the stroke",
                c.stop_damping);
  v.group({.name = "up", .doc = "chamber on the rod's side, which pushes the body up"},
          [&](auto& g) { fields(g, c.up); });
  v.group({.name = "down", .doc = "chamber that pushes the body down"},
          [&](auto& g) { fields(g, c.down); });
  mode_fields(v, c);
}

template <class Visitor>
void fields(Visitor& v, Link& link) {
  v.number({.name = "length",
            .unit = "m",
            .min = 1e-4,
            .doc = "distance from joint to joint, or from joint to foot"},
           link.length);
  v.number({.name = "mass",
            .unit = "kg",
            .min = 1e-9,
            .why = "every link has a mass",
            .doc = "mass, without parts that have a mass of their own"},
           link.mass);
  units::amount(v, "center_of_mass", "m", "distance of the centre of mass from the proximal joint",
                link.center_of_mass);
  v.number({.name = "inertia",
            .unit = "kg m2",
            .min = 1e-16,
            .why = "every link has an inertia",
            .doc = "moment of inertia about the centre of mass"},
           link.inertia);
  v.text(
      {.name = "parent",
       .optional = true,
       .doc = "link that carries it, or body; absent: the link before it, for the first the body"},
      link.parent);
  v.number(
      {.name = "at",
       .unit = "m",
       .optional = true,
       .doc = "position along its parent; absent: at its end; on the body: ahead of the origin"},
      link.at);
}

template <class Visitor>
void fields(Visitor& v, Foot& foot) {
  v.flag({.name = "present", .doc = "false: it never touches the ground"}, foot.present);
  units::amount(v, "mass", "kg", "mass at the end of the last link", foot.mass);
  units::amount(v, "radius", "m", "radius of the disc about the ankle that touches the ground",
                foot.radius);
  v.number({.name = "friction",
            .unit = "1",
            .min = 0,
            .max = 10,
            .doc = "Coulomb friction coefficient, static = sliding"},
           foot.friction);
  v.each({.name = "point", .optional = true, .doc = "discs that replace the one at the link's end"},
         foot.points, [](auto& g, Foot::Point& p) {
           g.number({.name = "along",
                     .unit = "m",
                     .doc = "position of the centre along the link, from the last joint"},
                    p.along);
           g.number({.name = "across",
                     .unit = "m",
                     .doc = "position of the centre to the left of the link"},
                    p.across);
           units::amount(g, "radius", "m", "radius of the disc", p.radius);
         });
}

template <class Visitor>
void fields(Visitor& v, Leg& leg) {
  v.texts({.name = "joints", .doc = "joints from the body outwards, each named <leg>_<name>"},
          leg.joints);
  v.group({.name = "foot", .optional = true, .doc = "foot of this leg, in place of [foot]"},
          [&](auto& g) { fields(g, leg.foot); });
  v.text({.name = "plan",
          .optional = true,
          .doc = "sequence that it follows, [plan.<name>] of the experiment; absent: [sequence]"},
         leg.plan);
  units::optional_share(v, "offset", "lead of its sequence, as a share of a step", leg.offset);
}

template <class Visitor>
void fields(Visitor& v, Ground& ground) {
  v.flag({.name = "present", .doc = "false: the leg hangs in the air"}, ground.present);
  v.number({.name = "height",
            .unit = "m",
            .doc = "height of the ankle at contact relative to the first joint, negative below it"},
           ground.height);
  units::amount(v, "normal_stiffness", "N/m", "stiffness of the contact", ground.normal_stiffness);
  units::amount(v, "normal_damping", "N s/m", "damping of the contact", ground.normal_damping);
}

}  // namespace sinew::robot
