#include "sinew/muscle/plumbing.h"

#include <limits>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"

namespace sinew::muscle {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool three_way(const gas::Valve& valve) { return valve.kind == gas::Valve::Kind::three_way; }

double volume_at(const Muscle& m, double length) {
  return m.count * actuator::volume(m.actuator.braid, length) + m.external_volume;
}

}  // namespace

bool needs_plumbing(std::span<const Muscle>, const gas::Air&, const gas::Supply&,
                    const std::optional<Cylinder>& cylinder) {
  return cylinder.has_value();
}

Plumbing::Plumbing(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
                   const std::optional<Cylinder>& cylinder)
    : size_(static_cast<int>(muscles.size())),
      states_(size_),
      air_(air),
      supply_(supply),
      muscles_(muscles.begin(), muscles.end()),
      cylinder_(cylinder),
      longest_step_(never) {
  if (size_ > capacity) throw std::invalid_argument("a machine has at most 8 muscles");
  for (const Muscle& m : muscles_) set_muscle(m);
  if (cylinder_)
    for (const Side side : {up, down})
      for (const gas::Valve& v : {cylinder_->inlet[side], cylinder_->exhaust[side]})
        taps_.push_back({v, gas::Shutter(v), gas::flow_constants(v.flow, air_)});
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::valves) states_ += 2;
  refresh(0.0);
}

void Plumbing::set_muscle(const Muscle& m) {
  const gas::Valve& exhaust = three_way(m.inlet) ? m.inlet : m.exhaust;
  taps_.push_back({m.inlet, gas::Shutter(m.inlet), gas::flow_constants(m.inlet.flow, air_)});
  taps_.push_back({exhaust, gas::Shutter(exhaust), gas::flow_constants(exhaust.flow, air_)});
}

AirState Plumbing::initial(double pressure, const Lanes& length, double travel) const {
  AirState state{};
  for (int i = 0; i < size_; ++i)
    state[i] =
        gas::density(air_, pressure) * volume_at(muscles_[static_cast<std::size_t>(i)], length[i]);
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::valves) {
    state[size_] = gas::density(air_, cylinder_->pressure) * volume(*cylinder_, up, travel);
    state[size_ + 1] = gas::density(air_, air_.atmosphere) * volume(*cylinder_, down, travel);
  }
  return state;
}

void Plumbing::electrical(int valve, double t, bool open, const AirPull&) noexcept {
  Tap& tap = taps_[static_cast<std::size_t>(valve)];
  if (valve % 2 == 1 && three_way(tap.valve)) return;  // it has one coil
  tap.shutter.electrical(t, open);
  // A command can also take a pending change back, so look at all of them.
  next_change_ = never;
  for (const Tap& each : taps_)
    next_change_ = each.shutter.next() < next_change_ ? each.shutter.next() : next_change_;
}

void Plumbing::level(int, double, double) noexcept {}

void Plumbing::move_valves(double t) noexcept {
  for (Tap& tap : taps_) tap.shutter.advance(t);
  refresh(t);
}

// Shares of area after a change. A 3-way valve that leaves the supply opens to the atmosphere.
void Plumbing::refresh(double t) noexcept {
  ramping_ = false;
  open_count_ = 0;
  next_change_ = never;
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    Tap& tap = taps_[v];
    const bool other_way = v % 2 == 1 && three_way(tap.valve);
    tap.share = other_way ? 1.0 - taps_[v - 1].share : tap.shutter.fraction(t);
    next_change_ = tap.shutter.next() < next_change_ ? tap.shutter.next() : next_change_;
    ramping_ = ramping_ || tap.valve.profile == gas::Valve::Profile::ramp;
    if (tap.share > 0) ++open_count_;
  }
}

double Plumbing::open_share(int valve, double t) const noexcept {
  const Tap& tap = taps_[static_cast<std::size_t>(valve)];
  if (!ramping_) return tap.share;
  if (valve % 2 == 1 && three_way(tap.valve)) return 1.0 - open_share(valve - 1, t);
  return tap.shutter.fraction(t);
}

Plumbing::Chamber Plumbing::chamber(double mass, double volume) const noexcept {
  const double y = units::power(mass / volume / gas::density_at_atmosphere(air_),
                                air_.polytropic_exponent / 7.0);
  return {mass, volume, gas::pressure_of_y(air_, y), y};
}

double Plumbing::through(int valve, double t, double y_from, double y_to) const noexcept {
  const double share = open_share(valve, t);
  if (share <= 0) return 0.0;
  return share * gas::flow_y(taps_[static_cast<std::size_t>(valve)].flow, y_from, y_to);
}

// [31]-[35] of the bundle.
void Plumbing::pull(int i, double length, double rate, double pressure,
                    AirPull& out) const noexcept {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  const double gauge = pressure - air_.atmosphere;
  const double smooth =
      m.count * actuator::tension(m.actuator, length, rate, gauge, air_.atmosphere);
  const double sealed =
      actuator::stiffness_sealed(m.actuator, length, pressure, air_.atmosphere,
                                 m.external_volume / m.count, air_.polytropic_exponent);
  const double bound =
      m.count * actuator::coulomb_bound(m.actuator, length, gauge, air_.atmosphere, sealed);

  // A cord cannot push; without stick [33] as printed, sign(v).
  const double cord = smooth > 0 ? smooth : 0.0;
  const double printed = cord + (rate >= 0 ? bound : -bound);
  const bool stick = m.actuator.loss.stick;
  const double tension = stick ? cord : printed;
  out.tension[i] = tension > 0 ? tension : 0.0;
  out.mesh[i] = stick ? bound : 0.0;
  out.pressure[i] = pressure;
}

void Plumbing::evaluate(double t, const Lanes& length, const Lanes& rate, double travel,
                        double travel_rate, const AirState& state, AirPull& out,
                        AirState& derivative) const noexcept {
  out = AirPull{};
  out.supply_pressure = out.tank_pressure = supply_.pressure;
  const double y_supply = gas::y_of(air_, out.supply_pressure);
  for (int i = 0; i < size_; ++i) {
    const Chamber c =
        chamber(state[i], volume_at(muscles_[static_cast<std::size_t>(i)], length[i]));
    pull(i, length[i], rate[i], c.pressure, out);
    out.inflow[i] = through(2 * i, t, y_supply, c.y);
    out.outflow[i] = through(2 * i + 1, t, c.y, 1.0);
    out.manifold[i] = c.pressure;
    derivative[i] = out.inflow[i] - out.outflow[i];
  }
  if (cylinder_) cylinder(t, travel, travel_rate, state, out, derivative);
}

void Plumbing::cylinder(double t, double travel, double travel_rate, const AirState& state,
                        AirPull& out, AirState& derivative) const noexcept {
  const Cylinder& c = *cylinder_;
  if (c.mode == Cylinder::Mode::regulator) {
    // Held pressure: the regulator lets in or relieves what the volume asks for.
    const double held = c.pressure < out.supply_pressure ? c.pressure : out.supply_pressure;
    const double flow = gas::density(air_, held) * area(c, up) * travel_rate;
    out.cylinder_pressure = {held, air_.atmosphere};
    out.cylinder_inflow[up] = flow > 0 ? flow : 0.0;
    out.cylinder_outflow[up] = flow < 0 ? -flow : 0.0;
  } else {
    const double y_supply = gas::y_of(air_, out.supply_pressure);
    for (const Side side : {up, down}) {
      const Chamber air = chamber(state[size_ + side], volume(c, side, travel));
      out.cylinder_pressure[side] = air.pressure;
      out.cylinder_inflow[side] = through(2 * (size_ + side), t, y_supply, air.y);
      out.cylinder_outflow[side] = through(2 * (size_ + side) + 1, t, air.y, 1.0);
      derivative[size_ + side] = out.cylinder_inflow[side] - out.cylinder_outflow[side];
    }
  }
  out.cylinder_force =
      force(c, out.cylinder_pressure[up], out.cylinder_pressure[down], air_.atmosphere);
}

double Plumbing::total_mass(const AirState& state, double travel) const {
  double sum = 0;
  for (int i = 0; i < states_; ++i) sum += state[i];
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator)
    sum += gas::density(air_, cylinder_->pressure) * volume(*cylinder_, up, travel);
  return sum;
}

}  // namespace sinew::muscle
