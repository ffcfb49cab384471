#include "sinew/identify/motion/decay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

constexpr double pi = std::numbers::pi;

// Writes the amplitudes of a linear spring at its turns.
void amplitudes(double first, double kept, double coulomb_length, std::span<double> out) {
  double a = first;
  for (double& x : out) {
    x = a;
    a = kept * a - coulomb_length * (1 + kept);
  }
}

double viscous_of(double kept, double mass, double period) {
  return 2 * mass / period * std::log(1 / kept);
}

}  // namespace

Damping two_point(double x1, double dx1, double x2, double dx2, double mass, double period,
                  DecayForm form) {
  if (x1 == x2) throw std::invalid_argument("two equal amplitudes");
  Damping out;
  out.kept = 1 - (dx1 - dx2) / (x1 - x2);
  const double share = form == DecayForm::printed ? 4 : std::pow(1 + std::sqrt(out.kept), 2);
  out.coulomb_length = (dx1 - x1 * (1 - out.kept)) / share;
  out.viscous = viscous_of(out.kept, mass, period);
  const double decrement = std::log(x1 / (x1 - dx1));
  out.ratio = decrement / (form == DecayForm::printed ? 2 * pi : std::hypot(2 * pi, decrement));
  return out;
}

TwoPoints two_points(const Oscillation& oscillation, double rest, const std::string& subject) {
  std::vector<double> x;
  for (std::size_t i = 0; i < oscillation.turns.size(); i += 2)
    x.push_back(std::abs(oscillation.turns[i].value - rest));
  if (x.size() < 3)
    throw Refusal(subject, fmt::format("{} turns on the side of the first", x.size()),
                  "three: two amplitudes and their decreases, [46], [47]", "a longer record");
  // The later pair must be well above the noise and the uncertainty of the rest.
  std::size_t later = 1;
  while (later + 2 < x.size() && x[later + 1] > 0.2 * x[0]) ++later;
  const TwoPoints out{x[0], x[0] - x[1], x[later], x[later] - x[later + 1]};
  const bool falls = out.dx1 > 0 && out.dx2 > 0 && out.x1 > out.x2 && out.dx1 < out.x1;
  const double kept = 1 - (out.dx1 - out.dx2) / (out.x1 - out.x2);
  if (!falls || !(kept > 0))
    throw Refusal(subject,
                  fmt::format("amplitudes {:.4g} and {:.4g} m that fall by {:.3g} and {:.3g} m",
                              out.x1, out.x2, out.dx1, out.dx2),
                  "the decay of [46], [47]", "a record without swaying");
  return out;
}

DecayFit decay_fit(const Oscillation& oscillation, double mass) {
  const std::vector<Turn>& turns = oscillation.turns;
  const std::size_t n = turns.size();
  const double first = 0.5 * std::abs(turns[0].value - turns[1].value);
  const double last = 0.5 * std::abs(turns[n - 2].value - turns[n - 1].value);
  const double decrement =
      std::clamp(std::log(first / last) / static_cast<double>(n - 2), 1e-4, 2.0);

  const double center = 0.5 * (turns[n - 2].value + turns[n - 1].value);
  std::vector<Parameter> parameters{
      {"center", "m", center, -unbounded, unbounded, first},
      {"amplitude", "m", first, 0, unbounded, first},
      {"decrement", "1", 0.5 * decrement, 0, unbounded, decrement},
      {"coulomb_length", "m", 0.1 * decrement * first, 0, unbounded, decrement * first},
      {"bend", "1/m", 0, -unbounded, unbounded, 0.1 / first}};
  if (n < 7) parameters.pop_back();  // the bend

  std::vector<double> a(n);
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    amplitudes(p[1], std::exp(-p[2]), p[3], a);
    const double bend = p.size() > 4 ? p[4] : 0;
    for (std::size_t k = 0; k < n; ++k)
      r[k] = p[0] + bend * a[k] * a[k] + (turns[k].upper ? a[k] : -a[k]) - turns[k].value;
    return true;
  };
  DecayFit out{.solution = least_squares(residuals, n, parameters)};
  const std::vector<double>& p = out.solution.values;
  out.damping.kept = std::exp(-2 * p[2]);
  out.damping.coulomb_length = p[3];
  out.damping.viscous = viscous_of(out.damping.kept, mass, oscillation.period);
  const double s = std::exp(-p[2]);
  const double after = out.damping.kept * p[1] - out.damping.coulomb_length * (1 + s) * (1 + s);
  const double d = std::log(p[1] / std::max(after, 1e-12));
  out.damping.ratio = d / std::hypot(2 * pi, d);
  return out;
}

}  // namespace sinew::identify
