#include "bench/peers/row.h"

namespace sinew::bench {

namespace {

Row with_times(Row row, const Turns& turns, std::vector<double> figures) {
  row.figures = std::move(figures);
  row.ours = turns.ours;
  row.theirs = turns.theirs;
  return row;
}

void append(std::vector<double>& to, const std::vector<double>& more) {
  to.insert(to.end(), more.begin(), more.end());
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
  row.missing = why;
  return row;
}

void add(std::vector<Row>& rows, const std::vector<Row>& pass) {
  for (std::size_t i = 0; i < rows.size() && i < pass.size(); ++i) {
    append(rows[i].figures, pass[i].figures);
    append(rows[i].ours, pass[i].ours);
    append(rows[i].theirs, pass[i].theirs);
  }
}

}  // namespace sinew::bench
