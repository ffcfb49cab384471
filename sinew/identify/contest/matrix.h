// identify/contest/matrix.h - matrices and the operations that fits need. Eigen computes them; only
// matrix.cpp includes it because its templates compile slowly.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sinew::identify {

// A matrix, stored by columns.
class Matrix {
 public:
  Matrix() = default;

  // Creates a matrix of zeros.
  Matrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns) {}

  // Returns the unit matrix with n rows.
  static Matrix unit(std::size_t n);

  // Return the size, the elements column by column, one element, and a column.
  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  const double* data() const { return values_.data(); }
  double& operator()(std::size_t row, std::size_t column) { return values_[column * rows_ + row]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[column * rows_ + row];
  }
  std::span<double> column(std::size_t k) { return {values_.data() + k * rows_, rows_}; }
  std::span<const double> column(std::size_t k) const {
    return {values_.data() + k * rows_, rows_};
  }

  // Returns a matrix of these columns in this order.
  Matrix chosen(std::span<const std::size_t> columns) const;

  // Returns the length of a row.
  double row_norm(std::size_t row) const;

  // Returns whether all elements are finite.
  bool is_finite() const;

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> values_;
};

// Returns a b, a' b, a x and a' x.
Matrix product(const Matrix& a, const Matrix& b);
Matrix transposed_product(const Matrix& a, const Matrix& b);
std::vector<double> product(const Matrix& a, std::span<const double> x);
std::vector<double> transposed_product(const Matrix& a, std::span<const double> x);

// Return the inner product of two vectors, and the sum of the squares of one.
double dot(std::span<const double> a, std::span<const double> b);
double square(std::span<const double> a);

// Decomposition of a matrix with at least as many rows as columns into basis * triangle: an
// orthonormal basis and an upper triangle.
struct Triangular {
  Matrix basis, triangle;
};

// Returns the decomposition, by Householder's reflections.
Triangular triangular(const Matrix& a);

// Returns the triangle alone, which is faster.
Matrix triangle_of(const Matrix& a);

// Returns the inverse of an upper triangle; infinite or NaN if a diagonal element is 0.
Matrix inverse_of_triangle(const Matrix& triangle);

// Axes of a matrix, one unit vector per column of `axes`, with the factor by which it stretches
// each.
struct Axes {
  std::vector<double> values;
  Matrix axes;
};

// Returns the singular values of a square matrix, the largest first, with the right singular
// vectors. All are NaN if an element is not finite.
Axes singular_axes(const Matrix& square);

// Returns the eigenvalues, the smallest first, and the eigenvectors of a symmetric positive
// semidefinite matrix such as a covariance.
Axes axes_of_positive(const Matrix& symmetric);

// Return x of a x = b, for each column of b; a is symmetric positive semidefinite.
Matrix solved(const Matrix& a, const Matrix& b);
std::vector<double> solved(const Matrix& a, std::span<const double> b);

// Returns the inverse of a symmetric matrix; empty if a pivot is not above `least` times the
// largest diagonal element.
std::optional<Matrix> inverse_of_positive(const Matrix& symmetric, double least);

// Returns the Moore-Penrose inverse of a symmetric positive semidefinite matrix: eigenvalues above
// the rounding error of the largest are inverted, the others are set to 0.
Matrix inverse_where_determined(const Matrix& symmetric);

}  // namespace sinew::identify
