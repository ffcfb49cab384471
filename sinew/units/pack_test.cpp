// A lane of a pack is a double: every operation has the same bits, whatever is in the other lanes.
#include "sinew/units/pack.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "sinew/units/math.h"

namespace sinew::units::pack_test {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

template <int W>
std::uint64_t bits(const Pack<W>& x, int lane) {
  return bits(x[lane]);
}
template <int W>
std::uint64_t bits(const PackMask<W>& m, int lane) {
  return m[lane];
}
std::uint64_t bits(bool m) { return m; }

// Numbers of all sizes and signs, including those that are critical for rounding and signs.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}

  double one() {
    constexpr double edge[] = {0.0,
                               -0.0,
                               1.0,
                               -1.0,
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(),
                               5e-324,
                               1e308};
    if (random_() % 8 == 0) return edge[random_() % std::size(edge)];
    const double mantissa = std::uniform_real_distribution<double>(-2, 2)(random_);
    return std::ldexp(mantissa, static_cast<int>(random_() % 80) - 40);
  }

  template <int W>
  Pack<W> pack() {
    Pack<W> out;
    for (int k = 0; k < W; ++k) out.set(k, one());
    return out;
  }

 private:
  std::mt19937_64 random_;
};

template <int W>
struct Width {
  static constexpr int value = W;
};

template <class T>
class PackOf : public testing::Test {};
using Widths = testing::Types<Width<2>, Width<4>, Width<8>>;
TYPED_TEST_SUITE(PackOf, Widths);

// A law of packs has in each lane the bits of the law for that lane's numbers.
template <int W, class Law>
void expect_lanes(const char* name, unsigned seed, Law law) {
  Numbers numbers(seed);
  for (int trial = 0; trial < 20000; ++trial) {
    const Pack<W> a = numbers.pack<W>(), b = numbers.pack<W>();
    const auto packed = law(a, b);
    for (int k = 0; k < W; ++k) {
      const auto one = law(a[k], b[k]);
      if constexpr (std::is_same_v<decltype(one), const double>)
        if (std::isnan(one) && std::isnan(packed[k])) continue;
      ASSERT_EQ(bits(packed, k), bits(one)) << name << " of " << a[k] << " and " << b[k];
    }
  }
}

TYPED_TEST(PackOf, LanesAreDoubles) {
  constexpr int W = TypeParam::value;
  expect_lanes<W>("+", 1, [](const auto& a, const auto& b) { return a + b; });
  expect_lanes<W>("-", 2, [](const auto& a, const auto& b) { return a - b; });
  expect_lanes<W>("x", 3, [](const auto& a, const auto& b) { return a * b; });
  expect_lanes<W>("/", 4, [](const auto& a, const auto& b) { return a / b; });
  expect_lanes<W>("a x + b", 5, [](const auto& a, const auto& b) { return 0.3 * a + b; });
  expect_lanes<W>("sign", 6, [](const auto& a, const auto&) { return -a; });
  expect_lanes<W>("abs", 7, [](const auto& a, const auto&) { return units::abs(a); });
  expect_lanes<W>("sqrt", 8, [](const auto& a, const auto&) { return units::sqrt(a); });
  expect_lanes<W>("max", 9, [](const auto& a, const auto& b) { return units::max(a, b); });
  expect_lanes<W>("min", 10, [](const auto& a, const auto& b) { return units::min(a, b); });
  expect_lanes<W>("same", 11, [](const auto& a, const auto& b) {
    auto sum = a;
    sum += b, sum *= a, sum -= b, sum /= 3.0;
    return sum;
  });
}

TYPED_TEST(PackOf, MasksAreBools) {
  constexpr int W = TypeParam::value;
  expect_lanes<W>("<", 21, [](const auto& a, const auto& b) { return a < b; });
  expect_lanes<W>(">", 22, [](const auto& a, const auto& b) { return a > b; });
  expect_lanes<W>("<=", 23, [](const auto& a, const auto& b) { return a <= b; });
  expect_lanes<W>(">=", 24, [](const auto& a, const auto& b) { return a >= b; });
  expect_lanes<W>("==", 25, [](const auto& a, const auto& b) { return a == b; });
  expect_lanes<W>("!=", 26, [](const auto& a, const auto& b) { return a != b; });
  expect_lanes<W>("bit", 27, [](const auto& a, const auto&) { return bit(a, 51); });
  expect_lanes<W>("all of them", 28, [](const auto& a, const auto& b) {
    const auto less = a<b, positive = a> 0.0;
    return select((less & positive) | (!less ^ (b > 1.0)), a, b * 2.0);
  });
  PackMask<W> mask = Pack<W>(1) > 2.0;
  EXPECT_FALSE(any(mask));
  EXPECT_TRUE(all(!mask));
  mask.set(W - 1, true);
  EXPECT_TRUE(any(mask));
  EXPECT_FALSE(all(mask));
  EXPECT_TRUE(mask[W - 1]);
  EXPECT_FALSE(mask[0]);
}

TYPED_TEST(PackOf, SineAndCosineAreThoseOfADouble) {
  constexpr int W = TypeParam::value;
  const auto angle = [](const auto& a) { return units::select(units::abs(a) < 1e6, a, 0.7); };
  expect_lanes<W>("sin", 31, [&](const auto& a, const auto&) { return sin_cos(angle(a)).sin; });
  expect_lanes<W>("cos", 32, [&](const auto& a, const auto&) { return sin_cos(angle(a)).cos; });
}

TYPED_TEST(PackOf, StructsLieSideBySide) {
  constexpr int W = TypeParam::value;
  struct One {
    double x;
    std::array<double, 3> y;
  };
  struct Packed {
    Pack<W> x;
    std::array<Pack<W>, 3> y;
  };
  Numbers numbers(41);
  std::array<One, W> each;
  for (One& one : each) one = {numbers.one(), {numbers.one(), numbers.one(), numbers.one()}};
  auto packed = side_by_side<Packed>(each);
  each[W - 1] = {7, {8, 9, 10}};
  put_lane(each[W - 1], W - 1, packed);
  for (int k = 0; k < W; ++k) {
    const One& one = each[static_cast<std::size_t>(k)];
    EXPECT_EQ(bits(packed.x, k), bits(one.x));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(bits(packed.y[i], k), bits(one.y[i]));
    const One back = lane_of<One>(packed, k);
    EXPECT_EQ(bits(back.x), bits(one.x));
    EXPECT_EQ(bits(back.y[2]), bits(one.y[2]));
  }
}

}  // namespace
}  // namespace sinew::units::pack_test
