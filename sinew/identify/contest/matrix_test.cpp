// Matrix functions of fits satisfy their defining equations on seeded random matrices.
#include "sinew/identify/contest/matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::identify::matrix_test {
namespace {

Matrix random_matrix(std::size_t rows, std::size_t columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Matrix out(rows, columns);
  for (std::size_t k = 0; k < columns; ++k)
    for (double& x : out.column(k)) x = normal(random);
  return out;
}

void expect_same(const Matrix& a, const Matrix& b, double tolerance = 1e-12) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.columns(), b.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k)
      EXPECT_NEAR(a(i, k), b(i, k), tolerance) << i << ' ' << k;
}

Matrix transposed(const Matrix& a) { return transposed_product(a, Matrix::unit(a.rows())); }

TEST(Matrix, BasisTimesTriangleIsTheMatrix) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Matrix a = random_matrix(5 + seed, 1 + seed % 5, seed);
    const auto [basis, triangle] = triangular(a);
    expect_same(product(basis, triangle), a);
    expect_same(transposed_product(basis, basis), Matrix::unit(a.columns()));
    expect_same(triangle_of(a), triangle);
    expect_same(product(triangle, inverse_of_triangle(triangle)), Matrix::unit(a.columns()), 1e-9);
    for (std::size_t i = 1; i < a.columns(); ++i) EXPECT_EQ(triangle(i, i - 1), 0);
  }
}

// a'a v = s^2 v for each right vector; the axes of a'a are the same, with squared values.
TEST(Matrix, SingularAxesAreThoseOfTheSquare) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Matrix a = random_matrix(4, 4, seed), normal = transposed_product(a, a);
    const Axes singular = singular_axes(a), symmetric = axes_of_positive(normal);
    const Matrix stretched = product(normal, singular.axes);
    const Matrix of_symmetric = product(normal, symmetric.axes);
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = singular.values[k];
      EXPECT_NEAR(symmetric.values[3 - k], value * value, 1e-12);
      EXPECT_LE(value, singular.values[k > 0 ? k - 1 : 0]);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(stretched(i, k), value * value * singular.axes(i, k), 1e-11);
        EXPECT_NEAR(of_symmetric(i, k), symmetric.values[k] * symmetric.axes(i, k), 1e-11);
      }
    }
    expect_same(transposed_product(symmetric.axes, symmetric.axes), Matrix::unit(4));
  }
}

TEST(Matrix, WhatIsSolvedGivesTheOtherSideAgain) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Matrix a = random_matrix(12, 4, seed), normal = transposed_product(a, a);
    const Matrix right = random_matrix(4, 3, seed + 100);
    expect_same(product(normal, solved(normal, right)), right);
    const std::vector<double> x = solved(normal, right.column(0));
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(product(normal, x)[i], right(i, 0), 1e-12);
    const auto inverse = inverse_of_positive(normal, 1e-14);
    ASSERT_TRUE(inverse);
    expect_same(product(normal, *inverse), Matrix::unit(4), 1e-11);
  }
}

TEST(Matrix, WithoutNumbersThereAreNoAxes) {
  EXPECT_TRUE(singular_axes(Matrix()).values.empty());
  EXPECT_TRUE(axes_of_positive(Matrix()).values.empty());
  Matrix a = random_matrix(3, 3, 1);
  a(1, 1) = INFINITY;
  EXPECT_TRUE(std::isnan(singular_axes(a).values[2]));
  EXPECT_TRUE(std::isnan(inverse_where_determined(a)(0, 0)));
}

TEST(Matrix, WhatIsNotDeterminedHasNoInverse) {
  Matrix a = random_matrix(12, 3, 1);
  for (std::size_t i = 0; i < 12; ++i) a(i, 2) = a(i, 0) - 2 * a(i, 1);
  EXPECT_FALSE(inverse_of_positive(transposed_product(a, a), 1e-14));
}

// The four Moore-Penrose conditions, for a singular matrix.
TEST(Matrix, ThePseudoInverseKeepsItsFourConditions) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Matrix factor = random_matrix(5, 3, seed);
    const Matrix a = product(factor, transposed(factor));
    const Matrix b = inverse_where_determined(a), ab = product(a, b), ba = product(b, a);
    expect_same(product(ab, a), a, 1e-9);
    expect_same(product(ba, b), b, 1e-9);
    expect_same(transposed(ab), ab, 1e-9);
    expect_same(transposed(ba), ba, 1e-9);
  }
}

TEST(Matrix, ColumnsAndRowsAreWhatTheySay) {
  const Matrix a = random_matrix(4, 3, 1);
  const std::size_t chosen[] = {2, 0};
  const Matrix b = a.chosen(chosen);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(b(i, 0), a(i, 2));
    EXPECT_EQ(b(i, 1), a(i, 0));
    EXPECT_NEAR(a.row_norm(i), std::hypot(a(i, 0), a(i, 1), a(i, 2)), 1e-15);
  }
  EXPECT_NEAR(dot(a.column(0), a.column(1)), transposed_product(a, a)(0, 1), 1e-14);
  EXPECT_NEAR(square(a.column(0)), transposed_product(a, a)(0, 0), 1e-14);
  EXPECT_TRUE(a.is_finite());
  Matrix infinite = a;
  infinite(1, 1) = INFINITY;
  EXPECT_FALSE(infinite.is_finite());
}

}  // namespace
}  // namespace sinew::identify::matrix_test
