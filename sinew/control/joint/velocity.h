// control/joint/velocity.h - estimation of a joint's speed from counts, for the velocity term of
// [59].
//
//   difference        (theta_0 - theta_1)/t_p                     6.5; one count is 1/t_p counts/s
//   weighted average  sum of psi_i (theta_i - theta_0)          7.3; of a least-squares line of
//                     n_s readings, whose noise falls as 12/(n_s (n_s^2 - 1)):
//                     psi_i = 12 ((n_s - 1)/2 - i)/(n_s (n_s^2 - 1) t_p)
//   bounded observer  the difference, but within a margin of      7.3; and never beyond the limit
//                     what the joint's model gives,  a v + c F
//   Kalman            theta' = theta + g v + d F                  then corrected by constant shares
//                     v'     = a v + c F                          of  theta_0 - theta'
//   sensor            (reading - its zero) times a scale          7.3's muscle spindle
//
// Here theta_i is the reading i periods ago [count], t_p the period [s], v the last estimate
// [count/s], and F the tension that raises the angle less the one that lowers it, mean of this
// reading and the last [count]. The constants a, c, d, g describe the motion of the joint over a
// period and are computed from the machine's description (control/setup/estimators.h). All speeds
// are in counts of the angle's converter per second. All functions are pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/exact.h"
#include "sinew/signals/port.h"

namespace sinew::control {

inline constexpr std::size_t max_samples = 16;
inline constexpr float speed_limit = 1e6f;  // limit of any estimate [count/s]

// Method of estimation.
enum class Estimator : std::uint8_t {
  difference,
  weighted_average,
  bounded_observer,
  kalman,
  sensor,
};

// Configuration of a joint's estimator.
struct VelocityConfig {
  Estimator estimator = Estimator::difference;

  // Weighted average
  std::uint8_t samples = 2;                 // number of angles used, 2 .. max_samples
  std::array<float, max_samples> weight{};  // [1/s] newest first; the first is unused

  // Bounded observer and Kalman: the joint over one period
  float decay = 1;            // a, share of the speed that remains [-]
  float speed_gain = 0;       // c [count/s per count of tension]; 0: tension is not needed
  float margin = 0;           // bounded: largest deviation from the model's speed [count/s]
  float limit = speed_limit;  // bounded: largest speed [count/s]
  float travel = 0;           // g, Kalman [s]
  float travel_gain = 0;      // d, Kalman [count per count of tension]
  float angle_share = 0;      // Kalman: share of the angle's error that corrects the angle [-]
  float speed_share = 0;      // and the speed [1/s]

  // Sensor
  signals::Channel channel;
  std::int32_t at_rest = 0;  // reading at zero speed [count]
  float scale = 0;           // speed of one count [count/s]
};

// Memory of the estimator.
struct VelocityState {
  std::array<std::int32_t, max_samples> angle{};  // newest first [count]
  float predicted = 0;                            // Kalman: predicted angle [count]
  float push = 0;                                 // last reading of F [count]
  float speed = 0;                                // the last estimate [count/s]
  bool begun = false;
};

// Returns the speed by difference; `rate` is the number of laws per second.
constexpr float difference(std::int32_t angle, std::int32_t previous, float rate) noexcept {
  return static_cast<float>(angle - previous) * rate;
}

// Returns the weights of a least-squares line through n angles [1/s].
constexpr std::array<float, max_samples> line_weights(std::uint8_t n, float rate) noexcept {
  std::array<float, max_samples> weight{};
  const float count = static_cast<float>(n);
  for (std::size_t i = 0; i < n && i < max_samples; ++i) {
    const float lead = count - 1.0f - 2.0f * static_cast<float>(i);  // twice the time to the middle
    weight[i] = 6.0f * lead * rate / (count * (count * count - 1.0f));
  }
  return weight;
}

// Returns the weighted average. The weights apply to differences from the newest angle, so they
// need not sum to zero exactly.
constexpr float weighted_average(const VelocityConfig& config,
                                 const std::array<std::int32_t, max_samples>& angle) noexcept {
  float sum = 0;
  for (std::size_t i = 1; i < config.samples; ++i)
    sum += config.weight[i] * static_cast<float>(angle[i] - angle[0]);
  return sum;
}

// Returns the bounded observer's estimate; `push` is F, see above.
constexpr float bounded(const VelocityConfig& config, float calculated, float last,
                        float push) noexcept {
  const float expected = config.decay * last + config.speed_gain * push;
  const float near = expected + clamped(calculated - expected, config.margin);
  return clamped(near, config.limit);
}

// Advances the model by one period, then corrects it by a share of the error.
constexpr void kalman(const VelocityConfig& config, VelocityState& state, std::int32_t angle,
                      float push) noexcept {
  const float predicted = state.predicted + config.travel * state.speed + config.travel_gain * push;
  const float expected = config.decay * state.speed + config.speed_gain * push;
  const float error = static_cast<float>(angle) - predicted;
  state.predicted = clamped(predicted + config.angle_share * error, speed_limit);
  state.speed = clamped(expected + config.speed_share * error, speed_limit);
}

// Input of an estimator at a law.
struct Motion {
  std::int32_t angle = 0;   // [count]
  float push = 0;           // tension that raises the angle less what lowers it [count]
  std::int32_t sensor = 0;  // reading of the velocity's own sensor [count]
  float rate = 0;           // laws per second
};

// Returns the new estimate. At the first law it is zero by most methods, since there is only one
// angle.
constexpr float estimate(const VelocityConfig& config, VelocityState& state,
                         const Motion& now) noexcept {
  const bool first = !state.begun;
  if (first) {
    state.angle.fill(now.angle);
    state.predicted = static_cast<float>(now.angle);
    state.push = now.push;
    state.begun = true;
  }
  const float push = 0.5f * (state.push + now.push);
  state.push = now.push;
  const std::int32_t previous = state.angle[0];
  for (std::size_t i = max_samples - 1; i > 0; --i) state.angle[i] = state.angle[i - 1];
  state.angle[0] = now.angle;

  switch (config.estimator) {
    case Estimator::weighted_average:
      state.speed = clamped(weighted_average(config, state.angle), speed_limit);
      break;
    case Estimator::bounded_observer:
      if (!first)
        state.speed = bounded(config, difference(now.angle, previous, now.rate), state.speed, push);
      break;
    case Estimator::kalman:
      if (!first) kalman(config, state, now.angle, push);
      break;
    case Estimator::sensor:
      state.speed =
          clamped(static_cast<float>(now.sensor - config.at_rest) * config.scale, speed_limit);
      break;
    case Estimator::difference:
      state.speed = difference(now.angle, previous, now.rate);
      break;
  }
  return state.speed;
}

}  // namespace sinew::control
