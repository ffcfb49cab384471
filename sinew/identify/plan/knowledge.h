// identify/plan/knowledge.h - what readings are worth, before anybody has taken them.
//
//   Q = P + sum over mounts J' (sigma^2 1 + U U')^-1 J         var F = g' Q^-1 g
//
//   J      slopes of a mount's readings, dF/d(parameter)       g  the same at the force predicted
//   sigma  noise of one reading                                P  information beforehand
//   U  errors that all readings of a mount share, such as that of its length: measuring on at the
//      same mount does not average them away
//
// Linear in the parameters about what is expected of them; generalised least squares, so that
// another reading never makes a prediction worse. With one error only and no P this is
// sigma^2 x'(X'X)^-1 x of a linear law.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/identify/fit/matrix.h"

namespace sinew::identify {

// One reading that is planned, or one that there is.
struct PlannedReading {
  std::vector<double> slopes;  // dF/d(parameter), each parameter in its scale  [N]
  std::vector<double> shared;  // what one deviation of each shared error moves it by  [N]
};

// What is known of the parameters: the inverse of their covariance, in their scales.
class Knowledge {
 public:
  // Begins with what is known beforehand: the standard deviation of each parameter, in its scale;
  // infinite where nothing is.
  explicit Knowledge(std::span<const double> deviations);

  // Returns what the readings of one mount tell alone; `noise` is that of a reading, above 0  [N].
  static Knowledge of_mount(std::span<const PlannedReading> readings, double noise,
                            std::size_t parameters);

  // Adds what other readings tell.
  Knowledge& operator+=(const Knowledge& other);

  // Returns how many parameters there are.
  std::size_t parameters() const { return matrix_.rows(); }

  // Returns the variance of the force at each place, whose slopes are told  [N2]. Infinite in all
  // of them where the parameters are not determined.
  std::vector<double> variances(std::span<const std::vector<double>> places) const;

 private:
  Matrix matrix_;
};

}  // namespace sinew::identify
