#include "sinew/muscle/bank.h"

#include <limits>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"

namespace sinew::muscle {
namespace {

constexpr double series_reach = 0.05;  // |x| up to which six terms are enough
constexpr double rebase_at = 0.02;     // |x| from which a node takes a new reference

// P/P_atm = y^7.
constexpr double seventh_power(double y) {
  const double y2 = y * y;
  const double y4 = y2 * y2;
  return y4 * y2 * y;
}

}  // namespace

Bank::Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply)
    : size_(static_cast<int>(muscles.size())),
      padded_((size_ + lanes - 1) / lanes * lanes),
      air_(air),
      inverse_reference_density_(1.0 / gas::density_at_atmosphere(air)),
      supply_y_(units::power(supply.pressure / air.atmosphere, 1.0 / 7.0)),
      muscles_(muscles.begin(), muscles.end()) {
  if (size_ > capacity) throw std::invalid_argument("a bank holds at most 8 muscles");

  const double exponent = air.polytropic_exponent / 7.0;
  series_[0] = 1.0;
  for (int k = 1; k < 7; ++k) series_[k] = series_[k - 1] * (exponent - (k - 1)) / k;

  for (int i = 0; i < padded_; ++i) {
    // Lanes beyond the last muscle repeat it: harmless numbers, never read.
    const Muscle& m = muscles_[static_cast<std::size_t>(i < size_ ? i : size_ - 1)];
    const actuator::Actuator& a = m.actuator;
    thread2_[i] = a.braid.thread_length * a.braid.thread_length;
    factor_[i] = actuator::braid_factor(a.braid);
    count_[i] = m.count;
    external_[i] = m.external_volume;
    c0_[i] = a.effectiveness.scale * a.effectiveness.c0;
    c1_[i] = a.effectiveness.scale * a.effectiveness.c1;
    c2_[i] = a.effectiveness.scale * a.effectiveness.c2;
    const bool absolute = a.effectiveness.argument == actuator::Effectiveness::Argument::absolute;
    offset_[i] = absolute ? air.atmosphere : 0.0;
    low_[i] = a.effectiveness.valid_from;
    high_[i] = a.effectiveness.valid_to;
    long_length_[i] = a.long_end.length;
    long_stiffness_[i] = a.long_end.stiffness;
    long_damping_[i] = a.long_end.damping;
    short_length_[i] = actuator::shortest_length(a.braid);
    short_stiffness_[i] = a.short_end.stiffness;
    short_damping_[i] = a.short_end.damping;
    short_zero_[i] = a.short_end.law == actuator::ShortEnd::Law::zero ? 1.0 : 0.0;
    viscous_[i] = a.loss.viscous;
    bladder_[i] = a.bladder.stiffness;
    bladder_rest_[i] = a.bladder.rest_length;
    y_reference_[i] = 1.0;
    inverse_sigma_[i] = inverse_reference_density_;
    if (i >= size_) continue;
    all_stick_ = all_stick_ && a.loss.stick;
    shutters_.emplace_back(m.inlet);
    shutters_.emplace_back(m.exhaust);
    const bool three_way = m.inlet.kind == gas::Valve::Kind::three_way;
    flow_.push_back(gas::flow_constants(m.inlet.flow, air));
    flow_.push_back(gas::flow_constants(three_way ? m.inlet.flow : m.exhaust.flow, air));
  }
  refresh(0.0);
}

double Bank::volume(int i, double length) const {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  return m.count * actuator::volume(m.actuator.braid, length) + m.external_volume;
}

double Bank::mass_at(int i, double pressure, double length) const {
  return gas::density(air_, pressure) * volume(i, length);
}

void Bank::electrical(int valve, double t, bool open) noexcept {
  shutters_[static_cast<std::size_t>(valve)].electrical(t, open);
  const double next = shutters_[static_cast<std::size_t>(valve)].next();
  next_change_ = next < next_change_ ? next : next_change_;
  // A command can also take a pending change back.
  if (next > next_change_) {
    next_change_ = std::numeric_limits<double>::infinity();
    for (const gas::Shutter& s : shutters_)
      next_change_ = s.next() < next_change_ ? s.next() : next_change_;
  }
}

// Shares of area after a change. A 3-way valve that leaves the supply opens to the atmosphere.
void Bank::refresh(double t) noexcept {
  any_open_ = ramping_ = false;
  next_change_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    const bool three_way = m.inlet.kind == gas::Valve::Kind::three_way;
    for (int v = 2 * i; v < 2 * i + 2; ++v) {
      const gas::Shutter& s = shutters_[static_cast<std::size_t>(v)];
      share_[static_cast<std::size_t>(v)] = s.fraction(t);
      next_change_ = s.next() < next_change_ ? s.next() : next_change_;
    }
    if (three_way)
      share_[static_cast<std::size_t>(2 * i + 1)] = 1.0 - share_[static_cast<std::size_t>(2 * i)];
    const gas::Valve::Profile ramp = gas::Valve::Profile::ramp;
    ramping_ = ramping_ || m.inlet.profile == ramp || m.exhaust.profile == ramp;
    any_open_ = any_open_ || ramping_ || share_[static_cast<std::size_t>(2 * i)] > 0 ||
                share_[static_cast<std::size_t>(2 * i + 1)] > 0;
  }
}

double Bank::open_share(int valve, double t) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_) return share_[v];
  const Muscle& m = muscles_[v / 2];
  if (m.inlet.kind == gas::Valve::Kind::three_way && valve % 2 == 1)
    return 1.0 - shutters_[v - 1].fraction(t);
  return shutters_[v].fraction(t);
}

double Bank::exact_y(double density) const noexcept {
  return units::power(density * inverse_reference_density_, air_.polytropic_exponent / 7.0);
}

void Bank::node(double t, const Lanes& length, const Lanes& mass) noexcept {
  if (next_change_ <= t) {
    for (gas::Shutter& s : shutters_) s.advance(t);
    refresh(t);
  }
  for (int i = 0; i < size_; ++i) {
    const double inside = length[i] * (thread2_[i] - length[i] * length[i]) * factor_[i];
    const double volume = count_[i] * (inside > 0 ? inside : 0.0) + external_[i];
    const double sigma = mass[i] / volume;
    const double x = sigma * inverse_sigma_[i] - 1.0;
    if (x < rebase_at && x > -rebase_at) continue;
    y_reference_[i] = exact_y(sigma);
    inverse_sigma_[i] = 1.0 / sigma;
  }
  for (int i = size_; i < padded_; ++i) {
    y_reference_[i] = y_reference_[size_ - 1];
    inverse_sigma_[i] = inverse_sigma_[size_ - 1];
  }
}

void Bank::pressures(const Lanes& length, const Lanes& mass, Lanes& y) const noexcept {
  const auto& c = series_;
  for (int first = 0; first < padded_; first += lanes) {
    double x[lanes], farthest = 0;
    for (int k = 0; k < lanes; ++k) {
      const int i = first + k;
      const double inside = length[i] * (thread2_[i] - length[i] * length[i]) * factor_[i];
      const double volume = count_[i] * (inside > 0 ? inside : 0.0) + external_[i];
      x[k] = mass[i] / volume * inverse_sigma_[i] - 1.0;
      const double z = x[k];
      y[i] = y_reference_[i] *
             (1.0 + z * (c[1] + z * (c[2] + z * (c[3] + z * (c[4] + z * (c[5] + z * c[6]))))));
    }
    for (int k = 0; k < lanes; ++k) {
      const double size = x[k] < 0 ? -x[k] : x[k];
      farthest = size > farthest ? size : farthest;
    }
    if (farthest <= series_reach) continue;
    for (int k = 0; k < lanes; ++k)
      if (x[k] > series_reach || x[k] < -series_reach)
        y[first + k] = exact_y((x[k] + 1.0) / inverse_sigma_[first + k]);
  }
}

void Bank::evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                    Pull& out) const noexcept {
  Lanes y;
  pressures(length, mass, y);

  // [31]-[33] in lanes; actuator/tension.h has the same law in words, a test holds them together.
  for (int first = 0; first < padded_; first += lanes)
    for (int k = 0; k < lanes; ++k) {
      const int i = first + k;
      const double p = air_.atmosphere * seventh_power(y[i]);
      const double gauge = p - air_.atmosphere;
      const double bounded = gauge < low_[i] ? low_[i] : gauge;
      const double argument = (bounded > high_[i] ? high_[i] : bounded) + offset_[i];
      const double share = c0_[i] + argument * (c1_[i] + argument * c2_[i]);

      const double l = length[i], v = rate[i];
      double f = gauge * (3.0 * l * l - thread2_[i]) * factor_[i] * share;
      f += bladder_[i] * (l - bladder_rest_[i]) + viscous_[i] * v;
      const double stretch = l - long_length_[i];
      f += stretch > 0 ? long_stiffness_[i] * stretch + long_damping_[i] * v : 0.0;
      const double squeeze = l - short_length_[i];
      const double stop = f + short_stiffness_[i] * squeeze + short_damping_[i] * v;
      const double beyond = short_zero_[i] > 0 ? 0.0 : stop;
      f = squeeze < 0 ? beyond : f;
      f = count_[i] * f;
      out.tension[i] = f > 0 ? f : 0.0;
      out.pressure[i] = p;
    }

  if (!all_stick_) loose_signs(length, rate, out);
  flows(t, y, out);
}

// [33] as printed, sign(v): for actuators that do not stick.
void Bank::loose_signs(const Lanes& length, const Lanes& rate, Pull& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    if (m.actuator.loss.stick) continue;
    const double gauge = out.pressure[i] - air_.atmosphere;
    const double bound =
        m.count * actuator::coulomb_bound(m.actuator, length[i], gauge, air_.atmosphere, 0.0);
    const double f = out.tension[i] + (rate[i] >= 0 ? bound : -bound);
    out.tension[i] = f > 0 ? f : 0.0;
  }
}

void Bank::flows(double t, const Lanes& y, Pull& out) const noexcept {
  out.inflow = {};
  out.outflow = {};
  if (!any_open_) return;
  for (int i = 0; i < size_; ++i) {
    const double inlet = open_share(2 * i, t), exhaust = open_share(2 * i + 1, t);
    const auto v = static_cast<std::size_t>(2 * i);
    if (inlet > 0) out.inflow[i] = inlet * gas::flow_y(flow_[v], supply_y_, y[i]);
    if (exhaust > 0) out.outflow[i] = exhaust * gas::flow_y(flow_[v + 1], y[i], 1.0);
  }
}

Lanes Bank::coulomb_bound(const Lanes& length, const Lanes& pressure) const noexcept {
  Lanes bound;
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    if (!m.actuator.loss.stick || m.actuator.loss.coulomb_length <= 0) continue;
    double sealed = 0;
    if (m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed)
      sealed = actuator::stiffness_sealed(m.actuator, length[i], pressure[i], air_.atmosphere,
                                          m.external_volume / m.count, air_.polytropic_exponent);
    bound[i] = m.count * actuator::coulomb_bound(m.actuator, length[i],
                                                 pressure[i] - air_.atmosphere, air_.atmosphere,
                                                 sealed);
  }
  return bound;
}

}  // namespace sinew::muscle
