#include "sinew/identify/contest/matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::identify {

namespace {

using Dense = Eigen::MatrixXd;

constexpr double rounding = std::numeric_limits<double>::epsilon();

Eigen::Index index(std::size_t n) { return static_cast<Eigen::Index>(n); }

Eigen::Map<const Dense> view(const Matrix& a) {
  return {a.data(), index(a.rows()), index(a.columns())};
}

Eigen::Map<const Eigen::VectorXd> view(std::span<const double> x) {
  return {x.data(), index(x.size())};
}

Matrix copy(const Dense& a) {
  Matrix out(static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols()));
  for (std::size_t k = 0; k < out.columns(); ++k)
    std::copy_n(a.data() + k * out.rows(), out.rows(), out.column(k).begin());
  return out;
}

std::vector<double> copy(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

Dense upper(const Eigen::HouseholderQR<Dense>& qr) {
  return qr.matrixQR().topRows(qr.cols()).triangularView<Eigen::Upper>();
}

}  // namespace

Matrix Matrix::unit(std::size_t n) {
  Matrix out(n, n);
  for (std::size_t i = 0; i < n; ++i) out(i, i) = 1;
  return out;
}

Matrix Matrix::chosen(std::span<const std::size_t> columns) const {
  Matrix out(rows_, columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    std::ranges::copy(column(columns[k]), out.column(k).begin());
  return out;
}

double Matrix::row_norm(std::size_t row) const {
  double sum = 0;
  for (std::size_t k = 0; k < columns_; ++k) sum += (*this)(row, k) * (*this)(row, k);
  return std::sqrt(sum);
}

bool Matrix::is_finite() const {
  return std::ranges::all_of(values_, [](double x) { return std::isfinite(x); });
}

Matrix product(const Matrix& a, const Matrix& b) { return copy(Dense(view(a) * view(b))); }

Matrix transposed_product(const Matrix& a, const Matrix& b) {
  return copy(Dense(view(a).transpose() * view(b)));
}

std::vector<double> product(const Matrix& a, std::span<const double> x) {
  return copy(Eigen::VectorXd(view(a) * view(x)));
}

std::vector<double> transposed_product(const Matrix& a, std::span<const double> x) {
  return copy(Eigen::VectorXd(view(a).transpose() * view(x)));
}

double dot(std::span<const double> a, std::span<const double> b) { return view(a).dot(view(b)); }

double square(std::span<const double> a) { return view(a).squaredNorm(); }

Triangular triangular(const Matrix& a) {
  const Eigen::HouseholderQR<Dense> qr(view(a));
  const Dense basis = qr.householderQ() * Dense::Identity(qr.rows(), qr.cols());
  return {copy(basis), copy(upper(qr))};
}

Matrix triangle_of(const Matrix& a) { return copy(upper(Eigen::HouseholderQR<Dense>(view(a)))); }

Matrix inverse_of_triangle(const Matrix& triangle) {
  const auto t = view(triangle);
  return copy(Dense(t.triangularView<Eigen::Upper>().solve(Dense::Identity(t.rows(), t.cols()))));
}

Axes singular_axes(const Matrix& square) {
  const std::size_t n = square.rows();
  if (n == 0) return {};
  if (!square.is_finite()) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Axes out{std::vector<double>(n, unknown), Matrix(n, n)};
    for (std::size_t k = 0; k < n; ++k) std::ranges::fill(out.axes.column(k), unknown);
    return out;
  }
  const Eigen::JacobiSVD<Dense, Eigen::NoQRPreconditioner> svd(view(square), Eigen::ComputeFullV);
  return {copy(Eigen::VectorXd(svd.singularValues())), copy(Dense(svd.matrixV()))};
}

Axes axes_of_positive(const Matrix& symmetric) {
  const Axes falling = singular_axes(symmetric);
  const std::size_t n = symmetric.rows();
  Axes out{std::vector<double>(n), Matrix(n, n)};
  for (std::size_t k = 0; k < n; ++k) {
    out.values[k] = falling.values[n - 1 - k];
    std::ranges::copy(falling.axes.column(n - 1 - k), out.axes.column(k).begin());
  }
  return out;
}

Matrix solved(const Matrix& a, const Matrix& b) {
  return copy(Dense(view(a).ldlt().solve(view(b))));
}

std::vector<double> solved(const Matrix& a, std::span<const double> b) {
  Matrix column(b.size(), 1);
  std::ranges::copy(b, column.column(0).begin());
  const Matrix x = solved(a, column);
  return {x.column(0).begin(), x.column(0).end()};
}

std::optional<Matrix> inverse_of_positive(const Matrix& symmetric, double least) {
  const auto a = view(symmetric);
  const Eigen::LDLT<Dense> factors(a);
  const bool known = factors.info() == Eigen::Success && factors.isPositive() &&
                     factors.vectorD().minCoeff() > least * a.diagonal().maxCoeff();
  if (!known) return std::nullopt;
  return copy(Dense(factors.solve(Dense::Identity(a.rows(), a.cols()))));
}

Matrix inverse_where_determined(const Matrix& symmetric) {
  const std::size_t n = symmetric.rows();
  const auto [values, axes] = singular_axes(symmetric);
  Matrix out(n, n);
  for (std::size_t k = 0; k < n; ++k) {
    if (values[k] <= rounding * static_cast<double>(n) * values[0]) continue;
    const std::span<const double> axis = axes.column(k);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < n; ++l) out(i, l) += axis[i] * axis[l] / values[k];
  }
  return out;
}

}  // namespace sinew::identify
