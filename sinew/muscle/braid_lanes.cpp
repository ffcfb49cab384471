#include "sinew/muscle/braid_lanes.h"

#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
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

bool lanes_hold(const Muscle& m) {
  return m.actuator.short_end.law != actuator::ShortEnd::Law::empirical &&
         actuator::is_plain(m.actuator) && !actuator::has_hysteresis(m.actuator.hysteresis) &&
         !actuator::has_creep(m.actuator.creep);
}

BraidLanes::BraidLanes(std::span<const Muscle> muscles, const gas::Air& air)
    : size_(static_cast<int>(muscles.size())),
      padded_((size_ + lanes - 1) / lanes * lanes),
      air_(air),
      inverse_reference_density_(1.0 / gas::density_at_atmosphere(air)),
      muscles_(muscles.begin(), muscles.end()) {
  if (size_ > capacity) throw std::invalid_argument("a machine has at most 8 muscles");

  const double exponent = air.polytropic_exponent / 7.0;
  series_[0] = 1.0;
  for (int k = 1; k < 7; ++k) series_[k] = series_[k - 1] * (exponent - (k - 1)) / k;

  // Lanes beyond the last muscle repeat it: harmless numbers, never read.
  for (int i = 0; i < padded_; ++i)
    set_constants(i, muscles_[static_cast<std::size_t>(i < size_ ? i : size_ - 1)]);
  for (const Muscle& m : muscles_) {
    all_stick_ = all_stick_ && m.actuator.loss.stick;
    any_sealed_ = any_sealed_ || m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed;
  }
}

Reference BraidLanes::reference() const {
  Reference r{};
  for (int i = 0; i < padded_; ++i) {
    r.y[i] = 1.0;
    r.inverse_sigma[i] = inverse_reference_density_;
  }
  return r;
}

void BraidLanes::set_constants(int i, const Muscle& m) {
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

double BraidLanes::exact_y(double density) const noexcept {
  return units::power(density * inverse_reference_density_, air_.polytropic_exponent / 7.0);
}

int BraidLanes::follow(const Lanes& drift, Reference& reference) const noexcept {
  int failed = -1;
  for (int i = 0; i < size_; ++i) {
    if (drift[i] < rebase_at && drift[i] > -rebase_at) continue;  // what is no number goes on
    const double sigma = (drift[i] + 1.0) / reference.inverse_sigma[i];
    if (!is_density(sigma) && failed < 0) failed = i;
    reference.y[i] = exact_y(sigma);
    reference.inverse_sigma[i] = 1.0 / sigma;
  }
  for (int i = size_; i < padded_; ++i) {
    reference.y[i] = reference.y[size_ - 1];
    reference.inverse_sigma[i] = reference.inverse_sigma[size_ - 1];
  }
  return failed;
}

// [31]-[34] and [40] in lanes. actuator/tension.h and loss.h have the same laws in words, and a
// test holds them together.
SINEW_WIDE void BraidLanes::evaluate(const Lanes& length, const Lanes& rate, const Lanes& mass,
                                     const Reference& reference, Pull& out,
                                     Lanes& y) const noexcept {
  const Constants& k = k_;
  const auto& c = series_;
  const Four zero{};
  for (int i = 0; i < padded_; i += lanes) {
    // Density against the reference, and y by the series: its terms in pairs, which wait less for
    // one another than Horner's.
    const Four l = length.four(i), v = rate.four(i), l2 = l * l;
    const Four inside = l * (k.linear.four(i) - k.cubic.four(i) * l2);
    const Four volume = (inside > zero ? inside : zero) + k.external.four(i);
    const Four x = (mass.four(i) * reference.inverse_sigma.four(i)) / volume - 1.0;
    const Four x2 = x * x, low = 1.0 + c[1] * x, middle = c[2] + c[3] * x;
    const Four high = (c[4] + c[5] * x) + c[6] * x2;
    Four root = reference.y.four(i) * ((low + x2 * middle) + (x2 * x2) * high);
    out.drift.four(i) = x;
    const auto outside = (x > series_reach) | (x < -series_reach);
    if ((outside[0] | outside[1] | outside[2] | outside[3]) != 0) far_roots(i, x, reference, root);
    y.four(i) = root;

    // These terms do not depend on the pressure.
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
    out.clamped.four(i) = all;
    out.mesh.four(i) = mesh > zero ? mesh : zero;
    out.pressure.four(i) = p;
  }

  if (any_sealed_) sealed_mesh(length, out);
  if (!all_stick_) loose_signs(rate, out);
}

// Beyond the reach of the series.
void BraidLanes::far_roots(int first, const Four& drift, const Reference& reference,
                           Four& root) const noexcept {
  for (int k = 0; k < lanes; ++k)
    if (drift[k] > series_reach || drift[k] < -series_reach)
      root[k] = exact_y((drift[k] + 1.0) / reference.inverse_sigma[first + k]);
}

// Loss::Scale::sealed: Q times the stiffness that it was identified with.
void BraidLanes::sealed_mesh(const Lanes& length, Pull& out) const noexcept {
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
void BraidLanes::loose_signs(const Lanes& rate, Pull& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    if (muscles_[static_cast<std::size_t>(i)].actuator.loss.stick) continue;
    const double rub = rate[i] >= 0 ? out.mesh[i] : -out.mesh[i];
    const double f = out.tension[i] + rub;
    out.tension[i] = f > 0 ? f : 0.0;
    out.clamped[i] += rub;
    out.mesh[i] = 0;
  }
}

}  // namespace sinew::muscle
