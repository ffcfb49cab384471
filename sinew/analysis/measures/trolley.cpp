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

TrolleyMotion integrate(const signals::Column& push, const signals::Column& seconds, double drag,
                        double mass, std::size_t start) {
  const std::size_t n = std::min(push.size(), seconds.size());
  const auto given = [&](std::size_t i) { return std::isfinite(push[i]) ? push[i] : 0.0; };

  TrolleyMotion out{signals::Column(push.file()), signals::Column(push.file())};
  TrolleyState now;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > start) now = pushed(now, 0.5 * (given(i - 1) + given(i)), drag, mass, seconds[i - 1]);
    out.position.push_back(now.position);
    out.velocity.push_back(now.velocity);
  }
  return out;
}

}  // namespace sinew::analysis
