#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "sinew/identify/machine/run_mixture.h"
#include "sinew/identify/machine/run_search.h"
#include "sinew/identify/machine/run_tangent.h"

namespace sinew::identify {

namespace {

using Matrix = Eigen::MatrixXd;

// By how much the readings' derivatives over a longer step differ from these, as a share of them;
// the median of the numbers.
double roughness(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 const RunSearched& at, int threads, const RunTangent& near) {
  RunTangent far;
  if (!run_tangent(residuals, parameters, at.cells, at.p, threads, far, long_difference))
    return unbounded;
  std::vector<double> share;
  for (Eigen::Index i = 0; i < near.j.cols(); ++i) {
    const double norm = near.j.col(i).norm();
    if (norm > 0) share.push_back((far.j.col(i) - near.j.col(i)).norm() / norm);
  }
  if (share.empty()) return 0;
  const auto middle = share.begin() + static_cast<std::ptrdiff_t>(share.size() / 2);
  std::ranges::nth_element(share, middle);
  return *middle;
}

// The numbers whose columns a run sees, those with cells behind the others.
std::vector<Eigen::Index> seen_columns(const Matrix& j, std::span<const RunCell> cells) {
  constexpr double unseen = 1e-9, has_part = 1e-3;
  const Eigen::HouseholderQR<Matrix> qr(j);
  const Matrix triangle = qr.matrixQR().topRows(j.cols()).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Matrix> svd(triangle, Eigen::ComputeFullV);
  std::vector<Eigen::Index> plain, in_cells;
  for (Eigen::Index i = 0; i < j.cols(); ++i) {
    bool seen = true;
    for (Eigen::Index k = 0; k < j.cols(); ++k)
      if (!(svd.singularValues()(k) > unseen * svd.singularValues()(0)) &&
          std::abs(svd.matrixV()(i, k)) > has_part)
        seen = false;
    const bool bounded = std::isfinite(cells[static_cast<std::size_t>(i)].high);
    if (seen) (bounded ? in_cells : plain).push_back(i);
  }
  plain.insert(plain.end(), in_cells.begin(), in_cells.end());
  return plain;
}

// Returns what the tangent at a place says of those numbers, in units of the residuals; these
// become what is left where it ends.
RunPiece piece_of(RunTangent& t, std::span<const Parameter> parameters, const RunSearched& at,
                  const std::vector<Eigen::Index>& columns) {
  const auto m = static_cast<Eigen::Index>(columns.size());
  const Matrix j = t.j(Eigen::all, columns);
  const Eigen::HouseholderQR<Matrix> qr(j);
  const Matrix triangle = qr.matrixQR().topRows(m).triangularView<Eigen::Upper>();
  const Eigen::VectorXd along = (qr.householderQ().transpose() * t.r).head(m);
  t.r -= qr.householderQ() *
         (Eigen::VectorXd(t.r.size()) << along, Eigen::VectorXd::Zero(t.r.size() - m)).finished();
  RunPiece out{.cost = 0.5 * t.r.squaredNorm()};
  out.spread = triangle.triangularView<Eigen::Upper>().solve(Matrix::Identity(m, m));
  out.middle = -out.spread * along;
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto i = static_cast<std::size_t>(columns[static_cast<std::size_t>(k)]);
    const Parameter& p = parameters[i];
    out.middle(k) = at.p[i] + p.scale * out.middle(k);
    out.spread.row(k) *= p.scale;
    if (out.spread(k, k) < 0) out.spread.col(k) *= -1;
    out.box.push_back({std::max(p.low, at.cells[i].low - off_the_jump),
                       std::min(p.high, at.cells[i].high + off_the_jump)});
  }
  return out;
}

// Writes the deviation of what is left in readings that no converter's end cuts. Returns its
// freedom.
int set_deviation(const RunResiduals& residuals, const Eigen::VectorXd& left, int numbers,
                  RunJudged& out) {
  double squares = 0;
  int count = 0;
  for (Eigen::Index k = 0; k < left.size(); ++k) {
    if (residuals.is_cut(static_cast<std::size_t>(k), left(k))) continue;
    squares += left(k) * left(k);
    ++count;
  }
  const int freedom = count - numbers;
  out.standard_deviation = freedom > 0 ? std::sqrt(squares / freedom) : 0;
  return freedom;
}

// The estimates of all numbers, by the intervals of those that are seen.
void write_estimates(std::span<const Parameter> parameters, const RunSearched& at,
                     const std::vector<Eigen::Index>& columns, const RunPiece& best,
                     const std::vector<RunCell>& middle, RunJudged& out) {
  const std::size_t n = parameters.size();
  out.covariance.assign(n * n, 0.0);
  std::vector<RunCell> interval(n);
  for (std::size_t i = 0; i < n; ++i) out.covariance[i * n + i] = unbounded;
  const Matrix covariance = best.spread * best.spread.transpose();
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const auto i = static_cast<std::size_t>(columns[a]);
    interval[i] = middle[a];
    for (std::size_t b = 0; b < columns.size(); ++b)
      out.covariance[i * n + static_cast<std::size_t>(columns[b])] =
          covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Parameter& p = parameters[i];
    Estimate e{.name = p.name, .unit = p.unit, .value = at.p[i]};
    e.standard_error = std::sqrt(out.covariance[i * n + i]);
    e.at_bound = e.value <= p.low || e.value >= p.high;
    e.low = e.value <= p.low ? p.low : std::min(e.value, std::max(interval[i].low, p.low));
    e.high = e.value >= p.high ? p.high : std::max(e.value, std::min(interval[i].high, p.high));
    out.estimates.push_back(e);
  }
}

}  // namespace

RunJudged judge_run(const RunResiduals& residuals, std::span<const Parameter> parameters,
                    const RunSearched& at, int threads) {
  RunJudged out;
  RunTangent t;
  (void)run_tangent(residuals, parameters, at.cells, at.p, threads, t);
  const std::vector<Eigen::Index> columns = seen_columns(t.j, at.cells);
  out.rms = std::sqrt(t.r.squaredNorm() / static_cast<double>(residuals.count()));
  out.roughness = roughness(residuals, parameters, at, threads, t);
  std::vector<RunPiece> pieces{piece_of(t, parameters, at, columns)};
  const int freedom = set_deviation(residuals, t.r, static_cast<int>(columns.size()), out);
  for (const RunSearched& other : at.others)
    if (run_tangent(residuals, parameters, other.cells, other.p, threads, t))
      pieces.push_back(piece_of(t, parameters, other, columns));

  const double s = out.standard_deviation;
  std::erase_if(pieces, [](const RunPiece& p) { return !p.spread.allFinite(); });
  for (RunPiece& piece : pieces) {
    piece.spread *= s;
    piece.cost /= s * s;
  }
  const bool known = !pieces.empty() && s > 0;
  std::vector<double> value;
  for (const Eigen::Index i : columns) value.push_back(at.p[static_cast<std::size_t>(i)]);
  const std::vector<RunCell> middle =
      known ? middle_of_pieces(pieces, value, t_quantile(std::max(1, freedom)))
            : std::vector<RunCell>(columns.size());
  const auto m = static_cast<Eigen::Index>(columns.size());
  RunPiece none{.middle = Eigen::VectorXd::Zero(m), .spread = Matrix::Zero(m, m)};
  write_estimates(parameters, at, columns, known ? pieces[0] : none, middle, out);
  return out;
}

}  // namespace sinew::identify
