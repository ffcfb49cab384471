#include "sinew/mechanism/slide/slide_mechanism.h"

#include "sinew/actuator/stiffness.h"
#include "sinew/mechanism/slide/prepare.h"

namespace sinew::plant {

SlideMechanism::SlideMechanism(const Setup& setup)
    : setup_(prepared(setup)),
      driven_(setup.load.mode == robot::Stand::Load::Mode::driven),
      regulated_(setup.charge.mode == Charge::Mode::regulated),
      cylinder_(setup.cylinder.has_value()) {
  const actuator::Actuator& a = setup_.muscle.actuator;
  ends_ = {-infinite, infinite};
  if (!cylinder_) {
    const int count = setup_.muscle.count;
    rubs_ = a.loss.stick && a.loss.coulomb_length > 0;
    ends_ = {actuator::shortest_length(a), a.long_end.length};
    end_stiffness_ = count * std::fmax(a.long_end.stiffness, a.short_end.stiffness);
    end_damping_ = count * std::fmax(a.long_end.damping, a.short_end.damping);
  }
  short_of_shortest_ = std::nextafter(ends_[0], -infinite);
  beyond_longest_ = std::nextafter(ends_[1], infinite);
  exponent_ = setup_.air.wall_time > 0 ? gas::heat_capacity_ratio : setup_.air.polytropic_exponent;
  longest_swing_ = longest_swing(setup_.accuracy);
  cut_within_ = std::fmax(3e-5 * setup_.accuracy, 1e-15);
  start_.length = setup_.start.length + setup_.start.displacement;
  begin(0, start_);
}

auto SlideMechanism::prescribed(double t) const noexcept -> Prescribed {
  const Schedule* of[] = {&setup_.load.mass, &setup_.load.force, &setup_.load.length,
                          &setup_.charge.pressure};
  Prescribed p{of[0]->piece(t), of[1]->piece(t), of[2]->piece(t), of[3]->piece(t), t, infinite};
  for (const Schedule* s : of) p.end = std::min(p.end, s->corner(t));
  return p;
}

// Returns the rate of the load on its spring, air shut in; of the ends where they act  [1/s].
double SlideMechanism::swinging_rate(double length, double pressure, double mass) const noexcept {
  double stiffness = 0, damping = 0;
  if (cylinder_) {
    const air::Cylinder& c = *setup_.cylinder;
    const double area = air::area(c, air::up);
    stiffness = exponent_ * pressure * area * area / air::volume(c, air::up, c.stroke - length);
  } else {
    const air::Muscle& m = setup_.muscle;
    stiffness =
        m.count * actuator::stiffness_sealed(m.actuator, length, pressure, setup_.air.atmosphere,
                                             m.external_volume / m.count, exponent_);
    damping = m.count * m.actuator.loss.viscous;
  }
  if (side_of(length) != 1) {
    stiffness = std::fabs(stiffness) + end_stiffness_;
    damping = actuator::empirical_loss * damping + end_damping_;
  }
  return std::sqrt(std::fabs(stiffness) / mass) + damping / mass;
}

}  // namespace sinew::plant
