#include "bench/peers/row.h"

namespace sinew::bench {

namespace {

Row with_times(Row row, const Turns& turns, const std::vector<double>& figures) {
  row.figure = spread(figures);
  row.rounds = static_cast<int>(figures.size());
  row.ours = spread(turns.ours).median;
  row.theirs = spread(turns.theirs).median;
  return row;
}

}  // namespace

Row times_faster(Row row, const Turns& turns) {
  row.better = Row::Better::more;
  row.unit = "times as fast";
  return with_times(std::move(row), turns, theirs_by_ours(turns));
}

Row times_slower(Row row, const Turns& turns) {
  row.better = Row::Better::less;
  row.unit = "times the time";
  return with_times(std::move(row), turns, ours_by_theirs(turns));
}

Row not_measured(Row row, const std::string& why) {
  row.rounds = 0;
  row.missing = why;
  return row;
}

}  // namespace sinew::bench
