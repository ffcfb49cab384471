#include "sinew/identify/pair/pair_rows.h"

#include <limits>

namespace sinew::identify {

PairRows pair_rows(const PairRecord& record, double from, double to, bool inside) {
  PairRows out;
  for (std::size_t i = 0; i < record.size(); ++i)
    if ((record.time[i] >= from && record.time[i] <= to) == inside) out.push_back(i);
  return out;
}

PairRows pair_block(const PairRows& rows, std::size_t k, bool inside) {
  PairRows out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if ((i * pair_blocks / rows.size() == k) == inside) out.push_back(rows[i]);
  return out;
}

PairRecord pair_thinned(const PairRecord& record) {
  constexpr std::size_t enough = 2000;
  const std::size_t stride = 1 + record.size() / enough;
  PairRecord out = record;
  const auto thin = [stride](std::vector<double>& values) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < values.size(); i += stride) values[n++] = values[i];
    values.resize(n);
  };
  for (auto* values : {&out.time, &out.at, &out.effort, &out.rate, &out.acceleration})
    thin(*values);
  for (std::vector<double>& p : out.pressure) thin(p);
  return out;
}

double pair_explained(std::span<const double> residuals, std::span<const double> measured) {
  double mean = 0, all = 0, left = 0;
  for (const double y : measured) mean += y / static_cast<double>(measured.size());
  for (const double y : measured) all += (y - mean) * (y - mean);
  for (const double r : residuals) left += r * r;
  return all > 0 ? 1 - left / all : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sinew::identify
