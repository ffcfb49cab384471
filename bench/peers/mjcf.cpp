#include "bench/peers/mjcf.h"

#include <fmt/format.h>

namespace sinew::bench {

namespace {

// Time constant of soft constraints [s]: four steps, and about that of the table's spring under the
// leg's weight.
constexpr double settling = 4e-3;

struct Solid {
  double mass = 0, center = 0, inertia = 0;  // [kg], along the link [m], about the centre [kg m2]
};

// Returns the inertia of a link with a point mass at its end.
Solid loaded(const robot::Link& link, double at_end) {
  Solid s{.mass = link.mass + at_end};
  s.center = (link.mass * link.center_of_mass + at_end * link.length) / s.mass;
  const double to_link = link.center_of_mass - s.center, to_end = link.length - s.center;
  s.inertia = link.inertia + link.mass * to_link * to_link + at_end * to_end * to_end;
  return s;
}

std::string inertial(const Solid& s) {
  return fmt::format(R"(<inertial pos="{} 0 0" mass="{}" diaginertia="{} {} {}"/>)", s.center,
                     s.mass, s.inertia, s.inertia, s.inertia);
}

std::string hinge(const robot::Joint& j) {
  return fmt::format(R"(<joint name="{}" type="hinge" axis="0 -1 0" damping="{}" frictionloss="{}")"
                     R"( stiffness="{}" springref="{}"/>)",
                     j.name, j.damping + j.damper, j.dry_friction, j.spring, j.spring_angle);
}

std::string contact(double friction) {
  return fmt::format(R"(condim="3" friction="{} 0 0" solref="{} 1")", friction, settling);
}

}  // namespace

std::string mjcf(const plant::Setup& setup, double step, Integrator integrator) {
  const robot::Robot& r = setup.robot;
  const robot::Link &femur = r.links.at(0), &tibia = r.links.at(1);
  const Solid upper = loaded(femur, 0), lower = loaded(tibia, r.foot.mass);
  const double carried = r.trolley.moving_mass() - robot::leg_mass(r);
  const double surface = r.ground.height - r.foot.radius;
  return fmt::format(
      R"(<mujoco model="leg"><compiler angle="radian"/>
<option timestep="{step}" integrator="{integrator}" cone="elliptic" gravity="0 0 {gravity}"/>
<worldbody>
<geom name="table" type="plane" pos="0 0 {surface}" size="10 10 1" {contact}/>
<body name="trolley">{carried}
<joint name="trolley" type="slide" axis="1 0 0" frictionloss="{drag}" limited="true"
 range="-10 {track}"/>
<body name="femur">{upper}{hip}
<body name="tibia" pos="{femur} 0 0">{lower}{knee}
<geom name="foot" type="sphere" pos="{tibia} 0 0" size="{radius}" {contact}/>
</body></body></body></worldbody></mujoco>
)",
      fmt::arg("step", step),
      fmt::arg("integrator", integrator == Integrator::rk4 ? "RK4" : "Euler"),
      fmt::arg("gravity", -r.gravity), fmt::arg("surface", surface),
      fmt::arg("contact", contact(r.foot.friction)),
      fmt::arg("carried", inertial({.mass = carried, .inertia = 1.0})),
      fmt::arg("drag", r.trolley.drag), fmt::arg("track", r.trolley.track_length),
      fmt::arg("upper", inertial(upper)), fmt::arg("lower", inertial(lower)),
      fmt::arg("hip", hinge(r.joints.at(0))), fmt::arg("knee", hinge(r.joints.at(1))),
      fmt::arg("femur", femur.length), fmt::arg("tibia", tibia.length),
      fmt::arg("radius", r.foot.radius));
}

}  // namespace sinew::bench
