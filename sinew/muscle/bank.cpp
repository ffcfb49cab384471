#include "sinew/muscle/bank.h"

#include <limits>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/muscle/failure.h"

// Lanes of four doubles where the machine has them; the same operations, so the same bits. The
// sanitizers start before the loader could choose, and what Clang 14 makes of it has a name that no
// other file finds.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SINEW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SINEW_WIDE
#endif

namespace sinew::muscle {
namespace {

constexpr double series_reach = 0.05;  // |x| up to which six terms are enough
constexpr double rebase_at = 0.02;     // |x| from which a node takes a new reference

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
    set_constants(i, muscles_[static_cast<std::size_t>(i < size_ ? i : size_ - 1)]);
    y_reference_[i] = 1.0;
    inverse_sigma_[i] = inverse_reference_density_;
  }
  for (const Muscle& m : muscles_) {
    all_stick_ = all_stick_ && m.actuator.loss.stick;
    any_sealed_ = any_sealed_ || m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed;
    shutters_.emplace_back(m.inlet);
    shutters_.emplace_back(m.exhaust);
    const bool three_way = m.inlet.kind == gas::Valve::Kind::three_way;
    flow_.push_back(gas::flow_constants(m.inlet.flow, air));
    flow_.push_back(gas::flow_constants(three_way ? m.inlet.flow : m.exhaust.flow, air));
  }
  refresh(0.0);
}

void Bank::set_constants(int i, const Muscle& m) {
  const actuator::Actuator& a = m.actuator;
  const double factor = actuator::braid_factor(a.braid);
  k_.thread2[i] = a.braid.thread_length * a.braid.thread_length;
  k_.cubic[i] = m.count * factor;
  k_.linear[i] = k_.cubic[i] * k_.thread2[i];
  k_.external[i] = m.external_volume;

  // Absolute pressure as the argument: the polynomial about one atmosphere.
  const actuator::Effectiveness& e = a.effectiveness;
  const bool absolute = e.argument == actuator::Effectiveness::Argument::absolute;
  const double shift = absolute ? air_.atmosphere : 0.0;
  k_.c0[i] = e.scale * (e.c0 + shift * (e.c1 + shift * e.c2));
  k_.c1[i] = e.scale * (e.c1 + 2.0 * shift * e.c2);
  k_.c2[i] = e.scale * e.c2;
  k_.low[i] = e.valid_from;
  k_.high[i] = e.valid_to;

  k_.viscous[i] = m.count * a.loss.viscous;
  k_.bladder[i] = m.count * a.bladder.stiffness;
  k_.bladder_rest[i] = a.bladder.rest_length;
  k_.long_length[i] = a.long_end.length;
  k_.long_stiffness[i] = m.count * a.long_end.stiffness;
  k_.long_damping[i] = m.count * a.long_end.damping;
  k_.short_length[i] = actuator::shortest_length(a.braid);
  k_.short_stiffness[i] = m.count * a.short_end.stiffness;
  k_.short_damping[i] = m.count * a.short_end.damping;
  k_.short_zero[i] = a.short_end.law == actuator::ShortEnd::Law::zero ? 1.0 : 0.0;

  using Scale = actuator::Loss::Scale;
  const double q = a.loss.coulomb_length;
  k_.mesh_secant[i] = a.loss.coulomb_scale == Scale::secant ? 3.0 * k_.cubic[i] * q : 0.0;
  k_.mesh_constant[i] =
      a.loss.coulomb_scale == Scale::constant ? m.count * q * a.loss.coulomb_stiffness : 0.0;
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
  // A command can also take a pending change back, so look at all of them.
  next_change_ = std::numeric_limits<double>::infinity();
  for (const gas::Shutter& s : shutters_)
    next_change_ = s.next() < next_change_ ? s.next() : next_change_;
}

void Bank::move_valves(double t) noexcept {
  for (gas::Shutter& s : shutters_) s.advance(t);
  refresh(t);
}

// Shares of area after a change. A 3-way valve that leaves the supply opens to the atmosphere.
void Bank::refresh(double t) noexcept {
  ramping_ = false;
  open_count_ = 0;
  next_change_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    const auto inlet = static_cast<std::size_t>(2 * i), exhaust = inlet + 1;
    for (std::size_t v : {inlet, exhaust}) {
      share_[v] = shutters_[v].fraction(t);
      next_change_ = shutters_[v].next() < next_change_ ? shutters_[v].next() : next_change_;
    }
    if (m.inlet.kind == gas::Valve::Kind::three_way) share_[exhaust] = 1.0 - share_[inlet];
    const gas::Valve::Profile ramp = gas::Valve::Profile::ramp;
    ramping_ = ramping_ || m.inlet.profile == ramp || m.exhaust.profile == ramp;
    for (std::size_t v : {inlet, exhaust})
      if (share_[v] > 0)
        open_[static_cast<std::size_t>(open_count_++)] = {static_cast<int>(v), share_[v]};
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

int Bank::follow(const Lanes& drift) noexcept {
  int failed = -1;
  for (int i = 0; i < size_; ++i) {
    if (drift[i] < rebase_at && drift[i] > -rebase_at) continue;  // what is no number goes on
    const double sigma = (drift[i] + 1.0) / inverse_sigma_[i];
    if (!is_density(sigma) && failed < 0) failed = i;
    y_reference_[i] = exact_y(sigma);
    inverse_sigma_[i] = 1.0 / sigma;
  }
  for (int i = size_; i < padded_; ++i) {
    y_reference_[i] = y_reference_[size_ - 1];
    inverse_sigma_[i] = inverse_sigma_[size_ - 1];
  }
  return failed;
}

// [31]-[34] and [40] in lanes. actuator/tension.h and loss.h have the same laws in words, and a
// test holds them together.
SINEW_WIDE void Bank::evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                               Pull& out) const noexcept {
  Lanes y;
  const Constants& k = k_;
  const auto& c = series_;
  const Four zero{};
  for (int i = 0; i < padded_; i += lanes) {
    // Density against the reference, and y by the series: its terms in pairs, which wait less for
    // one another than Horner's.
    const Four l = length.four(i), v = rate.four(i), l2 = l * l;
    const Four inside = l * (k.linear.four(i) - k.cubic.four(i) * l2);
    const Four volume = (inside > zero ? inside : zero) + k.external.four(i);
    const Four x = (mass.four(i) * inverse_sigma_.four(i)) / volume - 1.0;
    const Four x2 = x * x, low = 1.0 + c[1] * x, middle = c[2] + c[3] * x;
    const Four high = (c[4] + c[5] * x) + c[6] * x2;
    Four root = y_reference_.four(i) * ((low + x2 * middle) + (x2 * x2) * high);
    out.drift.four(i) = x;
    const auto outside = (x > series_reach) | (x < -series_reach);
    if ((outside[0] | outside[1] | outside[2] | outside[3]) != 0) far_roots(i, x, root);
    y.four(i) = root;

    // What does not depend on the pressure.
    const Four lever = k.cubic.four(i) * (3.0 * l2 - k.thread2.four(i));
    const Four stretch = l - k.long_length.four(i), squeeze = l - k.short_length.four(i);
    const Four braid = k.long_stiffness.four(i) * stretch + k.long_damping.four(i) * v;
    const Four passive =
        (k.bladder.four(i) * (l - k.bladder_rest.four(i)) + k.viscous.four(i) * v) +
        (stretch > zero ? braid : zero);
    const Four stop = k.short_stiffness.four(i) * squeeze + k.short_damping.four(i) * v;
    const Four squeezed = squeeze < zero ? stop : zero;
    const Four secant = k.mesh_secant.four(i) * (l + k.short_length.four(i));

    // Gauge pressure times effectiveness, and what it pulls with.
    const Four root2 = root * root, root4 = root2 * root2;
    const Four p = (air_.atmosphere * root4) * (root2 * root);
    const Four gauge = p - air_.atmosphere;
    const Four raised = gauge < k.low.four(i) ? k.low.four(i) : gauge;
    const Four bounded = raised > k.high.four(i) ? k.high.four(i) : raised;
    const Four share = k.c0.four(i) + bounded * (k.c1.four(i) + bounded * k.c2.four(i));
    const Four drive = gauge * share;
    const Four pull = drive * lever + (passive + squeezed);
    const Four nothing = squeeze < zero ? k.short_zero.four(i) : zero;  // [31] as printed
    const Four all = nothing > zero ? zero : pull;
    const Four rub = drive * secant + k.mesh_constant.four(i);
    const Four mesh = nothing > zero ? zero : rub;
    out.tension.four(i) = all > zero ? all : zero;
    out.mesh.four(i) = mesh > zero ? mesh : zero;
    out.pressure.four(i) = p;
  }

  if (any_sealed_) sealed_mesh(length, out);
  if (!all_stick_) loose_signs(rate, out);
  for (int i = 0; i < padded_; i += lanes) out.inflow.four(i) = out.outflow.four(i) = Four{};
  if (any_open()) flows(t, y, out);
}

// Beyond the reach of the series.
void Bank::far_roots(int first, const Four& drift, Four& root) const noexcept {
  for (int k = 0; k < lanes; ++k)
    if (drift[k] > series_reach || drift[k] < -series_reach)
      root[k] = exact_y((drift[k] + 1.0) / inverse_sigma_[first + k]);
}

// Loss::Scale::sealed: Q times the stiffness that it was identified with.
void Bank::sealed_mesh(const Lanes& length, Pull& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    if (m.actuator.loss.coulomb_scale != actuator::Loss::Scale::sealed) continue;
    const double p = out.pressure[i], gauge = p - air_.atmosphere;
    const double sealed =
        actuator::stiffness_sealed(m.actuator, length[i], p, air_.atmosphere,
                                   m.external_volume / m.count, air_.polytropic_exponent);
    out.mesh[i] =
        m.count * actuator::coulomb_bound(m.actuator, length[i], gauge, air_.atmosphere, sealed);
  }
}

// [33] as printed, sign(v): for actuators that do not stick.
void Bank::loose_signs(const Lanes& rate, Pull& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    if (muscles_[static_cast<std::size_t>(i)].actuator.loss.stick) continue;
    const double f = out.tension[i] + (rate[i] >= 0 ? out.mesh[i] : -out.mesh[i]);
    out.tension[i] = f > 0 ? f : 0.0;
    out.mesh[i] = 0;
  }
}

void Bank::flows(double t, const Lanes& y, Pull& out) const noexcept {
  const auto through = [&](int valve, double share) {
    const int i = valve / 2;
    const gas::FlowConstants& c = flow_[static_cast<std::size_t>(valve)];
    if (valve % 2 == 0)
      out.inflow[i] = share * gas::flow_y(c, supply_y_, y[i]);
    else
      out.outflow[i] = share * gas::flow_y(c, y[i], 1.0);
  };
  if (ramping_)
    for (int valve = 0; valve < 2 * size_; ++valve) through(valve, open_share(valve, t));
  else
    for (int k = 0; k < open_count_; ++k) {
      const Open& open = open_[static_cast<std::size_t>(k)];
      through(open.valve, open.share);
    }
}

}  // namespace sinew::muscle
