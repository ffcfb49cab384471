#include "sinew/air/braid_lanes.h"

#include <limits>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/failure.h"

// Lanes of four doubles where the machine has them; the same operations, so the same bits. The
// sanitizers start before the loader could choose, and what Clang 14 makes of it has a name that no
// other file finds.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SINEW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SINEW_WIDE
#endif

namespace sinew::air {
namespace {

using gas::PowerSeries;

const Four& four(const double* lane) { return reinterpret_cast<const Four&>(*lane); }
Four& four(double* lane) { return reinterpret_cast<Four&>(*lane); }

}  // namespace

bool lanes_hold(const Muscle& m) {
  return m.actuator.short_end.law != actuator::ShortEnd::Law::empirical &&
         actuator::is_plain(m.actuator) && !actuator::has_hysteresis(m.actuator.hysteresis) &&
         !actuator::has_creep(m.actuator.creep);
}

BraidLanes::BraidLanes(std::span<const Muscle> muscles, const gas::Air& air)
    : size_(static_cast<int>(muscles.size())),
      padded_((size_ + lanes - 1) / lanes * lanes),
      air_(air),
      series_(air.polytropic_exponent / 7.0),
      inverse_reference_density_(1.0 / gas::density_at_atmosphere(air)),
      muscles_(muscles.begin(), muscles.end()),
      constants_(static_cast<std::size_t>(padded_ / lanes)) {
  // Lanes beyond the last muscle repeat it: harmless numbers, never read.
  for (int i = 0; i < padded_; ++i)
    set_constants(i, muscles_[static_cast<std::size_t>(i < size_ ? i : size_ - 1)]);
  for (const Muscle& m : muscles_) {
    all_stick_ = all_stick_ && m.actuator.loss.stick;
    any_sealed_ = any_sealed_ || m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed;
  }
}

void BraidLanes::set_constants(int i, const Muscle& m) {
  Constants& k = constants_[static_cast<std::size_t>(i / lanes)];
  const int at = i % lanes;
  k.reach[at] = i < size_ ? PowerSeries::reach : std::numeric_limits<double>::infinity();
  const actuator::Actuator& a = m.actuator;
  const double factor = actuator::braid_factor(a.braid);
  k.thread2[at] = a.braid.thread_length * a.braid.thread_length;
  k.cubic[at] = m.count * factor;
  k.linear[at] = k.cubic[at] * k.thread2[at];
  k.external[at] = m.external_volume;

  // Absolute pressure as the argument: the polynomial about one atmosphere.
  const actuator::Effectiveness& e = a.effectiveness;
  const bool absolute = e.argument == actuator::Effectiveness::Argument::absolute;
  const double shift = absolute ? air_.atmosphere : 0.0;
  k.c0[at] = e.scale * (e.c0 + shift * (e.c1 + shift * e.c2));
  k.c1[at] = e.scale * (e.c1 + 2.0 * shift * e.c2);
  k.c2[at] = e.scale * e.c2;
  k.low[at] = e.valid_from;
  k.high[at] = e.valid_to;

  k.viscous[at] = m.count * a.loss.viscous;
  k.bladder[at] = m.count * a.bladder.stiffness;
  k.bladder_rest[at] = a.bladder.rest_length;
  k.long_length[at] = a.long_end.length;
  k.long_stiffness[at] = m.count * a.long_end.stiffness;
  k.long_damping[at] = m.count * a.long_end.damping;
  k.short_length[at] = actuator::shortest_length(a.braid);
  k.short_stiffness[at] = m.count * a.short_end.stiffness;
  k.short_damping[at] = m.count * a.short_end.damping;
  k.short_zero[at] = a.short_end.law == actuator::ShortEnd::Law::zero ? 1.0 : 0.0;

  using Scale = actuator::Loss::Scale;
  const double q = a.loss.coulomb_length;
  k.mesh_secant[at] = a.loss.coulomb_scale == Scale::secant ? 3.0 * k.cubic[at] * q : 0.0;
  k.mesh_constant[at] =
      a.loss.coulomb_scale == Scale::constant ? m.count * q * a.loss.coulomb_stiffness : 0.0;
}

double BraidLanes::exact_y(double density) const noexcept {
  const double ratio = density * inverse_reference_density_;
  return table_ ? (*table_)(ratio) : units::power(ratio, air_.polytropic_exponent / 7.0);
}

int BraidLanes::follow(const double* drift, double* y_ref, double* inverse_sigma) const noexcept {
  int failed = -1;
  for (int i = 0; i < size_; ++i) {
    if (drift[i] < PowerSeries::rebase && drift[i] > -PowerSeries::rebase)
      continue;  // what is no number goes on
    const double sigma = (drift[i] + 1.0) / inverse_sigma[i];
    if (!is_density(sigma) && failed < 0) failed = i;
    y_ref[i] = exact_y(sigma);
    inverse_sigma[i] = 1.0 / sigma;
  }
  for (int i = size_; i < padded_; ++i) {
    y_ref[i] = y_ref[size_ - 1];
    inverse_sigma[i] = inverse_sigma[size_ - 1];
  }
  return failed;
}

// [31]-[34] and [40] in lanes. actuator/tension.h and loss.h have the same laws in words, and a
// test holds them together.
SINEW_WIDE void BraidLanes::evaluate(const Given& in, const Filled& out) const noexcept {
  const Four zero{};
  for (int i = 0; i < padded_; i += lanes) {
    const Constants& k = constants_[static_cast<std::size_t>(i / lanes)];
    // Density against the reference, and y by the series.
    const Four l = four(in.length + i), v = four(in.rate + i), l2 = l * l;
    const Four inside = l * (k.linear - k.cubic * l2);
    const Four volume = (inside > zero ? inside : zero) + k.external;
    const Four x = (four(in.mass + i) * four(in.inverse_sigma + i)) / volume - 1.0;
    Four root;
    series_.raise(x, root);
    root = four(in.y_ref + i) * root;
    four(out.drift + i) = x;
    const auto outside = (x > k.reach) | (x < -k.reach);
    if ((outside[0] | outside[1] | outside[2] | outside[3]) != 0) {
      // One by one out and in: a wide load would have to wait for narrow stores.
      double one[lanes] = {root[0], root[1], root[2], root[3]};
      far_roots(x, k.reach, in.inverse_sigma + i, one);
      root = Four{one[0], one[1], one[2], one[3]};
    }
    four(out.y + i) = root;

    // These terms do not depend on the pressure.
    const Four lever = k.cubic * (3.0 * l2 - k.thread2);
    const Four stretch = l - k.long_length, squeeze = l - k.short_length;
    const Four braid = k.long_stiffness * stretch + k.long_damping * v;
    const Four passive =
        (k.bladder * (l - k.bladder_rest) + k.viscous * v) + (stretch > zero ? braid : zero);
    const Four stop = k.short_stiffness * squeeze + k.short_damping * v;
    const Four squeezed = squeeze < zero ? stop : zero;
    const Four secant = k.mesh_secant * (l + k.short_length);

    // Gauge pressure times effectiveness, and what it pulls with.
    const Four root2 = root * root, root4 = root2 * root2;
    const Four p = (air_.atmosphere * root4) * (root2 * root);
    const Four gauge = p - air_.atmosphere;
    const Four raised = gauge < k.low ? k.low : gauge;
    const Four bounded = raised > k.high ? k.high : raised;
    const Four share = k.c0 + bounded * (k.c1 + bounded * k.c2);
    const Four drive = gauge * share;
    const Four pull = drive * lever + (passive + squeezed);
    const Four nothing = squeeze < zero ? k.short_zero : zero;  // [31] as printed
    const Four all = nothing > zero ? zero : pull;
    const Four rub = drive * secant + k.mesh_constant;
    const Four friction_bound = nothing > zero ? zero : rub;
    four(out.tension + i) = all > zero ? all : zero;
    four(out.clamped + i) = all;
    four(out.friction_bound + i) = friction_bound > zero ? friction_bound : zero;
    four(out.pressure + i) = p;
  }

  if (any_sealed_) sealed_mesh(in, out);
  if (!all_stick_) loose_signs(in, out);
}

// Puts y beyond the reach of the series. Lanes beyond the last muscle go anywhere between two
// nodes.
void BraidLanes::far_roots(const Four& drift, const Four& reach, const double* inverse_sigma,
                           double* root) const noexcept {
  for (int k = 0; k < lanes; ++k) {
    if (!(drift[k] > reach[k] || drift[k] < -reach[k])) continue;
    root[k] = table_ ? (*table_)((drift[k] + 1.0) * (inverse_reference_density_ / inverse_sigma[k]))
                     : exact_y((drift[k] + 1.0) / inverse_sigma[k]);
  }
}

// Loss::Scale::sealed: Q times the stiffness that it was identified with.
void BraidLanes::sealed_mesh(const Given& in, const Filled& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    if (m.actuator.loss.coulomb_scale != actuator::Loss::Scale::sealed) continue;
    const double p = out.pressure[i], gauge = p - air_.atmosphere;
    const double sealed =
        actuator::stiffness_sealed(m.actuator, in.length[i], p, air_.atmosphere,
                                   m.external_volume / m.count, air_.polytropic_exponent);
    out.friction_bound[i] =
        m.count * actuator::coulomb_bound(m.actuator, in.length[i], gauge, air_.atmosphere, sealed);
  }
}

// [33] as printed, sign(v): for actuators that do not stick.
void BraidLanes::loose_signs(const Given& in, const Filled& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    if (muscles_[static_cast<std::size_t>(i)].actuator.loss.stick) continue;
    const double rub = in.rate[i] >= 0 ? out.friction_bound[i] : -out.friction_bound[i];
    const double f = out.tension[i] + rub;
    out.tension[i] = f > 0 ? f : 0.0;
    out.clamped[i] += rub;
    out.friction_bound[i] = 0;
  }
}

}  // namespace sinew::air
