#include "sinew/identify/pair/pair_rows.h"

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

}  // namespace sinew::identify
