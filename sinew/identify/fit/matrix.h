// identify/fit/matrix.h - matrices of a fit and the operations that fits need. They are computed by
// Eigen, which only matrix.cpp includes because its templates take long to compile.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sinew::identify {

// A matrix, kept column by column.
class Matrix {
 public:
  Matrix() = default;

  // Begins with zeros.
  Matrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns) {}

  // Returns the unit matrix of n rows.
  static Matrix unit(std::size_t n);

  // Return its size, its numbers column by column, one of them, and a column.
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

  // Returns a matrix of these columns, in this order.
  Matrix chosen(std::span<const std::size_t> columns) const;

  // Returns the length of a row.
  double row_norm(std::size_t row) const;

  // Returns whether all its numbers are finite.
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

// Returns the sum of the products of the elements of two vectors, and that of the squares of one's.
double dot(std::span<const double> a, std::span<const double> b);
double square(std::span<const double> a);

// A matrix of at least as many rows as columns as basis * triangle: the basis has orthogonal
// columns of length 1, the triangle is an upper one.
struct Triangular {
  Matrix basis, triangle;
};

// Returns it so, by Householder's reflections.
Triangular triangular(const Matrix& a);

// Returns the triangle alone, which takes less.
Matrix triangle_of(const Matrix& a);

// Returns the inverse of an upper triangle; infinite or not a number where a diagonal element is 0.
Matrix inverse_of_triangle(const Matrix& triangle);

// Axes of a matrix, one per column of `axes` and of length 1, with the factor by which it stretches
// each.
struct Axes {
  std::vector<double> values;
  Matrix axes;
};

// Returns the singular values of a square matrix, the largest first, with its right vectors. All
// are NaN if an element is not finite.
Axes singular_axes(const Matrix& square);

// Returns the eigenvalues of a symmetric matrix without negative ones, such as a covariance, the
// smallest first, with the eigenvectors.
Axes axes_of_positive(const Matrix& symmetric);

// Returns x of a x = b, for each column of b, where a is symmetric and not negative.
Matrix solved(const Matrix& a, const Matrix& b);
std::vector<double> solved(const Matrix& a, std::span<const double> b);

// Returns the inverse of a symmetric matrix; nothing where a pivot is not above `least` times the
// largest element of its diagonal.
std::optional<Matrix> inverse_of_positive(const Matrix& symmetric, double least);

// Returns the Moore-Penrose inverse of a symmetric matrix without negative eigenvalues: the inverse
// of each eigenvalue that is above the rounding error of the largest one, 0 for the others.
Matrix inverse_where_seen(const Matrix& symmetric);

}  // namespace sinew::identify
