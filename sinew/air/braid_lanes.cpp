#include "sinew/air/braid_lanes.h"

#include <limits>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/failure.h"
#include "sinew/units/wide.h"

namespace sinew::air {
namespace {

using gas::PowerSeries;

const Four& four(const double* lane) { return reinterpret_cast<const Four&>(*lane); }
Four& four(double* lane) { return reinterpret_cast<Four&>(*lane); }

}  // namespace

BraidLanes::BraidLanes(std::span<const Muscle> muscles, const gas::Air& air)
    : size_(static_cast<int>(muscles.size())),
      padded_((size_ + lanes - 1) / lanes * lanes),
      air_(air),
      series_(air.polytropic_exponent / 7.0),
      inverse_reference_density_(1.0 / gas::density_at_atmosphere(air)),
      muscles_(muscles.begin(), muscles.end()),
      constants_(static_cast<std::size_t>(padded_ / lanes)) {
  // Lanes beyond the last muscle repeat it; their values are harmless and never read.
  for (int i = 0; i < padded_; i += lanes) {
    Constants& k = constants_[static_cast<std::size_t>(i / lanes)];
    std::array<BraidConstants<double>, lanes> each;
    for (int at = 0; at < lanes; ++at) {
      const bool there = i + at < size_;
      k.reach[at] = there ? PowerSeries::reach : std::numeric_limits<double>::infinity();
      each[static_cast<std::size_t>(at)] =
          braid_constants(muscles_[static_cast<std::size_t>(there ? i + at : size_ - 1)], air);
    }
    k.law = units::side_by_side<BraidConstants<units::Pack<lanes>>>(each);
  }
  for (const Muscle& m : muscles_) {
    all_stick_ = all_stick_ && m.actuator.loss.stick;
    any_sealed_ = any_sealed_ || m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed;
  }
}

bool BraidLanes::bound_by_sealed(int i) const {
  const actuator::Loss& loss = muscles_[static_cast<std::size_t>(i)].actuator.loss;
  return loss.coulomb_scale == actuator::Loss::Scale::sealed;
}

bool BraidLanes::sticks(int i) const {
  return muscles_[static_cast<std::size_t>(i)].actuator.loss.stick;
}

double BraidLanes::exact_y(double density) const noexcept {
  if (table_) return (*table_)(density * inverse_reference_density_);
  return exact_root(density, inverse_reference_density_, series_.exponent());
}

int BraidLanes::update_references(const double* drift, double* y_ref,
                                  double* inverse_sigma) const noexcept {
  int failed = -1;
  for (int i = 0; i < size_; ++i) {
    if (drift[i] < PowerSeries::rebase && drift[i] > -PowerSeries::rebase)
      continue;  // a NaN does not pass this test and fails below
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

SINEW_WIDE void BraidLanes::evaluate(const Inputs& in, const Outputs& out) const noexcept {
  using S = units::Pack<lanes>;
  for (int i = 0; i < padded_; i += lanes) {
    const Constants& k = constants_[static_cast<std::size_t>(i / lanes)];
    const BraidState<S> at{S(four(in.length + i)), S(four(in.rate + i)), S(four(in.mass + i)),
                           S(four(in.y_ref + i)), S(four(in.inverse_sigma + i))};
    const auto far = [&](const auto&, const S& x, S& y) __attribute__((always_inline)) {
      // Scalar stores and loads: a wide load after narrow stores would stall.
      double one[lanes] = {y[0], y[1], y[2], y[3]};
      far_roots(x.lanes, k.reach, in.inverse_sigma + i, one);
      y = S(Four{one[0], one[1], one[2], one[3]});
    };
    S x, y;
    const BraidPull<S> pull =
        braid_at(k.law, at, S(air_.atmosphere), series_, S(k.reach), far, x, y);
    four(out.drift + i) = x.lanes;
    four(out.y + i) = y.lanes;
    four(out.tension + i) = pull.tension.lanes;
    four(out.clamped + i) = pull.clamped.lanes;
    four(out.friction_bound + i) = pull.friction_bound.lanes;
    four(out.pressure + i) = pull.pressure.lanes;
  }

  if (any_sealed_) sealed_mesh(in, out);
  if (!all_stick_) apply_sliding_friction(in, out);
}

// Writes y of the lanes that are outside the series' range. Between two nodes the lanes beyond the
// last muscle may be anywhere.
void BraidLanes::far_roots(const Four& drift, const Four& reach, const double* inverse_sigma,
                           double* root) const noexcept {
  for (int k = 0; k < lanes; ++k) {
    if (!(drift[k] > reach[k] || drift[k] < -reach[k])) continue;
    root[k] = table_ ? (*table_)((drift[k] + 1.0) * (inverse_reference_density_ / inverse_sigma[k]))
                     : exact_y((drift[k] + 1.0) / inverse_sigma[k]);
  }
}

void BraidLanes::sealed_mesh(const Inputs& in, const Outputs& out) const noexcept {
  for (int i = 0; i < size_; ++i)
    if (bound_by_sealed(i)) out.friction_bound[i] = sealed_bound(i, in.length[i], out.pressure[i]);
}

// Returns Q times the stiffness that it was identified with.
double BraidLanes::sealed_bound(int i, double length, double pressure) const noexcept {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  const double sealed =
      actuator::stiffness_sealed(m.actuator, length, pressure, air_.atmosphere,
                                 m.external_volume / m.count, air_.polytropic_exponent);
  return m.count * actuator::coulomb_bound(m.actuator, length, pressure - air_.atmosphere,
                                           air_.atmosphere, sealed);
}

// Applies sign(v) as printed in [33] to actuators that do not stick.
void BraidLanes::apply_sliding_friction(const Inputs& in, const Outputs& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    if (sticks(i)) continue;
    const double friction = in.rate[i] >= 0 ? out.friction_bound[i] : -out.friction_bound[i];
    const double f = out.tension[i] + friction;
    out.tension[i] = f > 0 ? f : 0.0;
    out.clamped[i] += friction;
    out.friction_bound[i] = 0;
  }
}

}  // namespace sinew::air
