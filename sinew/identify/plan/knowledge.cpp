#include "sinew/identify/plan/knowledge.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::identify {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Index index_of(std::size_t n) { return static_cast<Eigen::Index>(n); }

RowMatrix rows_of_slopes(std::span<const PlannedReading> readings, std::size_t columns,
                         std::vector<double> PlannedReading::*what) {
  RowMatrix out(index_of(readings.size()), index_of(columns));
  for (std::size_t i = 0; i < readings.size(); ++i)
    for (std::size_t k = 0; k < columns; ++k)
      out(index_of(i), index_of(k)) = (readings[i].*what)[k];
  return out;
}

}  // namespace

Knowledge::Knowledge(std::span<const double> deviations)
    : size_(deviations.size()), matrix_(size_ * size_) {
  for (std::size_t i = 0; i < size_; ++i)
    matrix_[i * size_ + i] = 1 / (deviations[i] * deviations[i]);
}

// S^-1 = (1 - U (s^2 1 + U'U)^-1 U')/s^2, Woodbury's identity.
Knowledge Knowledge::of_mount(std::span<const PlannedReading> readings, double noise,
                              std::size_t parameters) {
  Knowledge out(std::vector<double>(parameters, std::numeric_limits<double>::infinity()));
  if (readings.empty()) return out;
  const std::size_t errors = readings.front().shared.size();
  const RowMatrix j = rows_of_slopes(readings, parameters, &PlannedReading::slopes);
  RowMatrix told = j.transpose() * j;
  if (errors > 0) {
    const RowMatrix u = rows_of_slopes(readings, errors, &PlannedReading::shared);
    const RowMatrix across = u.transpose() * j;
    RowMatrix inner = u.transpose() * u;
    inner.diagonal().array() += noise * noise;
    told -= across.transpose() * inner.ldlt().solve(across);
  }
  told /= noise * noise;
  Eigen::Map<RowMatrix>(out.matrix_.data(), index_of(parameters), index_of(parameters)) = told;
  return out;
}

Knowledge& Knowledge::operator+=(const Knowledge& other) {
  for (std::size_t i = 0; i < matrix_.size(); ++i) matrix_[i] += other.matrix_[i];
  return *this;
}

std::vector<double> Knowledge::variances(std::span<const std::vector<double>> places) const {
  const Eigen::Map<const RowMatrix> m(matrix_.data(), index_of(size_), index_of(size_));
  const Eigen::LDLT<RowMatrix> factors(m);
  const double largest = m.diagonal().maxCoeff();
  const bool known = factors.info() == Eigen::Success && factors.isPositive() &&
                     factors.vectorD().minCoeff() > 1e-14 * largest;
  std::vector<double> out(places.size(), std::numeric_limits<double>::infinity());
  if (!known) return out;
  const RowMatrix covariance = factors.solve(RowMatrix::Identity(index_of(size_), index_of(size_)));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Map<const Eigen::VectorXd> g(places[i].data(), index_of(size_));
    out[i] = std::max(0.0, (covariance * g).dot(g));
  }
  return out;
}

}  // namespace sinew::identify
