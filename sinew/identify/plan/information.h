// identify/plan/information.h - information that planned readings give about parameters.
//
//   Q = P + sum over mounts J' (sigma^2 1 + U U')^-1 J         var F = g' Q^-1 g
//
//   J      slopes of a mount's readings, dF/d(parameter)       g  slopes of the predicted force
//   sigma  noise of one reading                                P  prior information
//   U  errors common to all readings of a mount, such as that of its length: further readings at
//      the same mount do not average them out
//
// Linear in the parameters about their expected values; generalised least squares, so that a
// further reading never makes a prediction worse. With a single error and P = 0 this is sigma^2
// x'(X'X)^-1 x of a linear law.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/identify/contest/matrix.h"

namespace sinew::identify {

// One planned or existing reading.
struct PlannedReading {
  std::vector<double> slopes;  // dF/d(parameter), each parameter in its scale [N]
  std::vector<double> shared;  // change due to one deviation of each shared error [N]
};

// Information about the parameters: the inverse of their covariance, in their scales.
class Information {
 public:
  // Starts from the prior standard deviation of each parameter, in its scale; infinite if unknown.
  explicit Information(std::span<const double> deviations);

  // Returns the information from the readings of one mount; `noise` is that of a reading, > 0 [N].
  static Information of_mount(std::span<const PlannedReading> readings, double noise,
                              std::size_t parameters);

  // Adds the information from other readings.
  Information& operator+=(const Information& other);

  // Returns the number of parameters.
  std::size_t parameters() const { return matrix_.rows(); }

  // Returns the variance of the force for the slopes of each place [N2]. All are infinite if the
  // parameters are not determined.
  std::vector<double> variances(std::span<const std::vector<double>> places) const;

 private:
  Matrix matrix_;
};

}  // namespace sinew::identify
