#include "sinew/analysis/record/record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sinew/robot/legs.h"

namespace sinew::analysis {

Column held(const std::vector<std::int64_t>& times, const std::vector<double>& values,
            const std::vector<std::int64_t>& at) {
  if (times == at) return values;
  Column out;
  out.reserve(at.size());
  std::size_t next = 0;
  for (const std::int64_t t : at) {
    while (next < times.size() && times[next] <= t) ++next;
    out.push_back(next > 0 ? values[next - 1] : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

Record::Record(const signals::Table& table, const Machine& machine, const signals::Table* more,
               std::string leg)
    : table_(&table), more_(more), machine_(&machine), leg_(std::move(leg)) {
  if (leg_.empty() && !machine.robot.legs.empty()) leg_ = machine.robot.legs.front().name;
  find_times();
  find_stretches();
  sequence_ = only([](const Stretch&) { return true; });
  stance_ = only([&](const Stretch& s) { return is_stance(machine, s.phase); });
  swing_ = only([&](const Stretch& s) { return is_swing(machine, s.phase); });
}

void Record::find_times() {
  const signals::Series* base = logged("/plan/phase");
  if (!base && !machine_->robot.joints.empty())
    base = logged("/joint/" + machine_->robot.joints.front().name + "/angle");
  period_ = machine_->period;
  if (!base) return;

  time_ns_ = base->time_ns;
  const std::size_t n = time_ns_.size();
  last_ns_ = n > 1 ? time_ns_[n - 1] - time_ns_[n - 2] : std::llround(1e9 * period_);
  for (std::size_t i = 0; i < n; ++i) seconds_.push_back(lasting(i, i));
  if (n == 0) return;

  std::vector<double> sorted = seconds_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  period_ = *middle;
}

void Record::find_stretches() {
  const Column phase = column("/plan/phase");
  Column step = column("/plan/step");
  if (step.empty()) step.assign(phase.size(), 0.0);

  for (std::size_t i = 0; i < phase.size(); ++i) {
    if (!(phase[i] >= 0) || !(step[i] >= 0)) continue;
    const int p = static_cast<int>(phase[i]), s = static_cast<int>(step[i]);
    const bool goes_on = !stretches_.empty() && stretches_.back().last == i &&
                         stretches_.back().phase == p && stretches_.back().step == s;
    if (!goes_on) stretches_.push_back({.phase = p, .step = s, .first = i, .last = i});
    stretches_.back().last = i + 1;
  }
}

std::vector<double> Record::only(const std::function<bool(const Stretch&)>& wanted) const {
  std::vector<double> out(rows(), 0.0);
  for (const Stretch& s : stretches_)
    if (wanted(s))
      for (std::size_t i = s.first; i < s.last; ++i) out[i] = seconds_[i];
  return out;
}

std::vector<double> Record::part(int phase, double from, double to) const {
  std::vector<double> out(rows(), 0.0);
  for (const Stretch& s : stretches_) {
    if (phase >= 0 && s.phase != phase) continue;
    const double start = time(s.first), duration = lasting(s);
    for (std::size_t i = s.first; i < s.last; ++i) {
      const double progress = (time(i) - start) / duration;
      if (progress >= from && progress < to) out[i] = seconds_[i];
    }
  }
  return out;
}

// In one table.
const signals::Series* Record::find_in(const signals::Table& table, std::string_view topic) const {
  if (const signals::Series* found = table.find(topic); found || leg_.empty()) return found;
  if (const signals::Series* found = table.find(robot::logged_topic(machine_->robot, topic)))
    return found;
  return table.find(robot::topic_of_leg(leg_, topic));
}

const signals::Series* Record::logged(std::string_view topic) const {
  return find_in(*table_, topic);
}

const signals::Series* Record::find(std::string_view topic) const {
  const signals::Series* found = logged(topic);
  return found || !more_ ? found : find_in(*more_, topic);
}

Column Record::column(std::string_view topic, std::string_view field) const {
  for (const signals::Table* table : {table_, more_}) {
    const signals::Series* series = table ? find_in(*table, topic) : nullptr;
    if (!series) continue;
    for (std::size_t f = 0; f < series->topic.fields.size(); ++f)
      if (series->topic.fields[f].name == field && !series->columns[f].empty())
        return held(series->time_ns, series->columns[f], time_ns_);
  }
  return {};
}

const Stretch* Record::last_of(int phase) const {
  for (auto s = stretches_.rbegin(); s != stretches_.rend(); ++s)
    if (s->phase == phase) return &*s;
  return nullptr;
}

std::vector<int> Record::complete_steps() const {
  std::map<int, std::size_t> phases;  // of each step
  for (const Stretch& s : stretches_) ++phases[s.step];
  std::size_t whole = 0;
  for (const auto& [step, n] : phases) whole = std::max(whole, n);

  std::vector<int> out;
  for (const auto& [step, n] : phases)
    if (n == whole) out.push_back(step);
  if (out.empty() || table_->complete || last_row() + 1 < rows()) return out;
  if (out.back() == stretches_.back().step) out.pop_back();
  return out;
}

}  // namespace sinew::analysis
