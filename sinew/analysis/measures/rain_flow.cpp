#include "sinew/analysis/measures/rain_flow.h"

#include <algorithm>
#include <cmath>

namespace sinew::analysis {
namespace {

// Turning points that are in no cycle yet; the newest point moves on while the series continues in
// its direction.
class Open {
 public:
  Open(std::vector<Cycle>& cycles, double least) : cycles_(cycles), least_(least) {}

  void add(double value) {
    if (!points_.empty() && value == points_.back()) return;
    const std::size_t n = points_.size();
    if (n >= 2 && (value > points_[n - 1]) == (points_[n - 1] > points_[n - 2])) points_.pop_back();
    points_.push_back(value);
  }

  // Counts the ranges that the last turning point closes.
  void close() {
    while (points_.size() >= 3) {
      const std::size_t n = points_.size();
      const double last = std::abs(points_[n - 1] - points_[n - 2]);
      if (last < std::abs(points_[n - 2] - points_[n - 3])) return;
      count(points_[n - 3], points_[n - 2], n == 3 ? 0.5 : 1.0);
      points_.erase(points_.end() - 3, points_.end() - (n == 3 ? 2 : 1));
    }
  }

  // Counts the ranges that nothing has closed.
  void finish() {
    for (std::size_t i = 1; i < points_.size(); ++i) count(points_[i - 1], points_[i], 0.5);
  }

 private:
  void count(double a, double b, double cycles) {
    const double range = std::abs(b - a);
    if (range >= least_) cycles_.push_back({range, 0.5 * (a + b), cycles});
  }

  std::vector<Cycle>& cycles_;
  const double least_;
  std::vector<double> points_;
};

}  // namespace

std::vector<Cycle> rain_flow(const signals::Column& values, double least) {
  std::vector<Cycle> out;
  Open open(out, least);
  for (const double value : values) {
    if (std::isnan(value)) continue;
    open.add(value);
    open.close();
  }
  open.finish();
  return out;
}

double cycles_in(const std::vector<Cycle>& cycles) {
  double sum = 0;
  for (const Cycle& c : cycles) sum += c.count;
  return sum;
}

double largest_range(const std::vector<Cycle>& cycles) {
  double out = 0;
  for (const Cycle& c : cycles) out = std::max(out, c.range);
  return out;
}

}  // namespace sinew::analysis
