#include "sinew/analysis/measures/trolley.h"

#include <algorithm>
#include <cmath>

namespace sinew::analysis {

TrolleyState pushed(TrolleyState state, double push, double drag, double mass, double dt) {
  const double without_drag = state.velocity + push / mass * dt;
  const double bound = drag / mass * dt;
  const double velocity = without_drag - std::clamp(without_drag, -bound, bound);
  return {.position = state.position + 0.5 * (state.velocity + velocity) * dt,
          .velocity = velocity};
}

TrolleyMotion integrate(std::span<const double> push, std::span<const double> seconds, double drag,
                        double mass, std::size_t start) {
  const std::size_t n = std::min(push.size(), seconds.size());
  const auto given = [&](std::size_t i) { return std::isfinite(push[i]) ? push[i] : 0.0; };

  TrolleyMotion out{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  TrolleyState now;
  for (std::size_t i = start; i + 1 < n; ++i) {
    now = pushed(now, 0.5 * (given(i) + given(i + 1)), drag, mass, seconds[i]);
    out.position[i + 1] = now.position;
    out.velocity[i + 1] = now.velocity;
  }
  return out;
}

}  // namespace sinew::analysis
