#include "sinew/identify/machine/run_mixture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>

namespace sinew::identify {

namespace {

constexpr double normal_width = 1.959963984540054;
constexpr double outside = 6;  // standard deviations; a box beyond them has no effect
constexpr int draws_of_a_piece = 4096;

// Uniform and normal random numbers, equal for every standard library.
class Draws {
 public:
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

  // Draws a unit normal within limits, and multiplies `weight` by the probability of the interval.
  double normal_between(double low, double high, double& weight) {
    if (low < -outside && high > outside) return normal();
    const bool mirrored = low > 0;  // the lower tail is more accurate
    if (mirrored) std::tie(low, high) = std::pair(-high, -low);
    const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
    const double first = below(low), share = below(high) - first;
    weight *= std::max(0.0, share);
    const double wanted = first + uniform() * share;
    double from = std::max(low, -38.0), to = std::min(high, 38.0);
    for (int halving = 0; halving < 40; ++halving) {
      const double x = 0.5 * (from + to);
      (below(x) < wanted ? from : to) = x;
    }
    const double x = std::clamp(0.5 * (from + to), low, high);
    return mirrored ? -x : x;
  }

 private:
  std::mt19937_64 random_{1};
};

// Draws of all pieces: a row of parameters each, and its weight.
struct Drawn {
  std::vector<std::vector<double>> at;
  std::vector<double> weight;
};

// Returns the logarithm of the spread's determinant.
double log_volume(const RunPiece& piece) {
  double sum = 0;
  for (std::size_t i = 0; i < piece.middle.size(); ++i) sum += std::log(piece.spread(i, i));
  return sum;
}

void draw(const RunPiece& piece, double stretch, double least_cost, double largest, Draws& draws,
          Drawn& out) {
  const std::size_t n = piece.middle.size();
  const double height = std::exp(least_cost - piece.cost + log_volume(piece) - largest);
  std::vector<double> z(n), x(n);
  for (int k = 0; k < draws_of_a_piece; ++k) {
    double weight = height;
    for (std::size_t i = n; i-- > 0;) {
      const RunCell& box = piece.box[i];
      const double deviation = stretch * piece.spread(i, i);
      double middle = piece.middle[i];
      for (std::size_t b = i + 1; b < n; ++b) middle += stretch * piece.spread(i, b) * z[b];
      z[i] = draws.normal_between((box.low - middle) / deviation, (box.high - middle) / deviation,
                                  weight);
      x[i] = middle + deviation * z[i];
    }
    if (!(weight > 0)) continue;
    out.at.push_back(x);
    out.weight.push_back(weight);
  }
}

bool is_cut(const RunPiece& piece) {
  for (std::size_t i = 0; i < piece.middle.size(); ++i) {
    const RunCell& box = piece.box[i];
    const double far = outside * piece.spread.row_norm(i);
    if (box.low > piece.middle[i] - far || box.high < piece.middle[i] + far) return true;
  }
  return false;
}

// Returns the middle 95 % of parameter i, or the 95 % that reach up to its value.
RunCell middle_of(const Drawn& drawn, std::size_t i, double value) {
  constexpr double tail = 0.025;
  std::vector<std::size_t> order(drawn.at.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(drawn.at[k][i], k); });
  double all = 0, below = 0;
  for (std::size_t k = 0; k < drawn.at.size(); ++k) {
    all += drawn.weight[k];
    below += drawn.at[k][i] < value ? drawn.weight[k] : 0;
  }
  const auto quantile = [&](double share) {
    double sum = 0;
    for (const std::size_t k : order) {
      sum += drawn.weight[k];
      if (sum >= share * all) return drawn.at[k][i];
    }
    return drawn.at[order.back()][i];
  };
  const double from = below < tail * all         ? below / all
                      : below > (1 - tail) * all ? below / all - (1 - 2 * tail)
                                                 : tail;
  return {quantile(from), quantile(from + 1 - 2 * tail)};
}

}  // namespace

std::vector<RunCell> middle_of_pieces(std::span<const RunPiece> pieces,
                                      std::span<const double> value, double width) {
  const auto n = pieces[0].middle.size();
  std::vector<RunCell> out(n);
  Drawn drawn;
  if (pieces.size() > 1 || is_cut(pieces[0])) {
    Draws draws;
    double least = unbounded, largest = -unbounded;
    for (const RunPiece& p : pieces) {
      least = std::min(least, p.cost);
      largest = std::max(largest, log_volume(p));
    }
    for (const RunPiece& p : pieces) draw(p, width / normal_width, least, largest, draws, drawn);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const RunPiece& only = pieces[0];
    const double reach = width * only.spread.row_norm(i);
    out[i] = drawn.at.empty() ? RunCell{only.middle[i] - reach, only.middle[i] + reach}
                              : middle_of(drawn, i, value[i]);
  }
  return out;
}

}  // namespace sinew::identify
