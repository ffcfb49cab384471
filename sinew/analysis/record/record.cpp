#include "sinew/analysis/record/record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sinew/robot/legs.h"

namespace sinew::analysis {

Column held(const signals::Times& times, const Column& values, const signals::Times& at) {
  if (times == at) return values;
  Column out(at.file());
  std::size_t next = 0;
  for (const std::int64_t t : at) {
    while (next < times.size() && times[next] <= t) ++next;
    out.push_back(next > 0 ? values[next - 1] : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

template <class Wanted>
Column Record::only(Wanted wanted) const {
  Column out = new_column();
  for (const PhaseSpan& s : phase_spans_) {
    while (out.size() < s.first) out.push_back(0);
    const auto is_wanted = wanted(s);
    for (std::size_t i = s.first; i < s.last; ++i) out.push_back(is_wanted(i) ? seconds_[i] : 0);
  }
  while (out.size() < rows()) out.push_back(0);
  return out;
}

Record::Record(const signals::Table& table, const Machine& machine, const signals::Table* more,
               std::string leg, TopicNames* read)
    : table_(&table), more_(more), machine_(&machine), leg_(std::move(leg)), read_(read) {
  if (leg_.empty() && !machine.robot.legs.empty()) leg_ = machine.robot.legs.front().name;
  find_times();
  find_phase_spans();
  const auto all_or_none = [](bool is) { return [is](std::size_t) { return is; }; };
  sequence_ = only([&](const PhaseSpan&) { return all_or_none(true); });
  stance_ = only([&](const PhaseSpan& s) { return all_or_none(is_stance(machine, s.phase)); });
  swing_ = only([&](const PhaseSpan& s) { return all_or_none(is_swing(machine, s.phase)); });
}

const signals::Series* Record::true_or_measured(const std::string& topic) const {
  const signals::Series* series = logged("/true" + topic);
  if (!series) series = logged(topic);
  return series && !series->time_ns.empty() ? series : nullptr;
}

const signals::Series* Record::base() const {
  if (machine_->stand) {
    for (const std::string& topic : {std::string("/stand/length"), std::string("/stand/force"),
                                     "/muscle/" + machine_->stand->element.name + "/pressure"})
      if (const signals::Series* series = true_or_measured(topic)) return series;
    return nullptr;
  }
  const signals::Series* base = logged("/plan/phase");
  if (!base && !machine_->robot.joints.empty())
    base = logged("/joint/" + machine_->robot.joints.front().name + "/angle");
  return base;
}

void Record::find_times() {
  const signals::Series* base = this->base();
  period_ = machine_->period;
  if (!base) return;

  time_ns_ = base->time_ns;
  const std::size_t n = time_ns_.size();
  last_ns_ = n > 1 ? time_ns_[n - 1] - time_ns_[n - 2] : std::llround(1e9 * period_);
  // Few durations differ, so that the median is found by counting them.
  seconds_ = new_column();
  std::map<double, std::size_t> of_length;
  for (std::size_t i = 0; i < n; ++i) {
    seconds_.push_back(lasting(i, i));
    ++of_length[seconds_.back()];
  }
  std::size_t up_to = 0;
  for (const auto& [length, count] : of_length) {
    up_to += count;
    period_ = length;
    if (up_to > n / 2) break;
  }
}

void Record::find_phase_spans() {
  const Column phase = column("/plan/phase"), step = column("/plan/step");
  phase_spans_ = signals::PagedVector<PhaseSpan>(time_ns_.file());
  PhaseSpan now;
  const auto end = [&] {
    if (now.last > now.first) phase_spans_.push_back(now);
    now = {};
  };
  for (std::size_t i = 0; i < phase.size(); ++i) {
    const double its_step = step.empty() ? 0.0 : step[i];
    if (!(phase[i] >= 0) || !(its_step >= 0)) {
      end();
      continue;
    }
    const int p = static_cast<int>(phase[i]), s = static_cast<int>(its_step);
    if (now.last == now.first || now.phase != p || now.step != s) {
      end();
      now = {.phase = p, .step = s, .first = i, .last = i};
    }
    now.last = i + 1;
  }
  end();
}

Column Record::part(int phase, double from, double to) const {
  return only([&](const PhaseSpan& s) {
    const bool is_it = phase < 0 || s.phase == phase;
    const double start = time(s.first), duration = lasting(s);
    return [=, this](std::size_t i) {
      const double progress = (time(i) - start) / duration;
      return is_it && progress >= from && progress < to;
    };
  });
}

// Finds a topic in one table.
const signals::Series* Record::find_in(const signals::Table& table, std::string_view topic) const {
  if (const signals::Series* found = table.find(topic); found || leg_.empty()) return found;
  if (const signals::Series* found = table.find(robot::logged_topic(machine_->robot, topic)))
    return found;
  return table.find(robot::topic_of_leg(leg_, topic));
}

// Adds a topic to those that were read: by its name in the log, or in the leg if it is missing.
void Record::note(const signals::Series* found, std::string_view topic) const {
  if (read_) read_->insert(found ? found->topic.name : robot::topic_of_leg(leg_, topic));
}

const signals::Series* Record::logged(std::string_view topic) const {
  const signals::Series* found = find_in(*table_, topic);
  note(found, topic);
  return found;
}

const signals::Series* Record::find(std::string_view topic) const {
  const signals::Series* found = find_in(*table_, topic);
  if (!found && more_) found = find_in(*more_, topic);
  note(found, topic);
  return found;
}

Column Record::column(std::string_view topic, std::string_view field) const {
  for (const signals::Table* table : {table_, more_}) {
    const signals::Series* series = table ? find_in(*table, topic) : nullptr;
    note(series, topic);
    if (!series) continue;
    for (std::size_t f = 0; f < series->topic.fields.size(); ++f)
      if (series->topic.fields[f].name == field && !series->columns[f].empty())
        return held(series->time_ns, series->columns[f], time_ns_);
  }
  return {};
}

std::optional<PhaseSpan> Record::last_of(int phase) const {
  for (std::size_t i = phase_spans_.size(); i-- > 0;)
    if (const PhaseSpan s = phase_spans_[i]; s.phase == phase) return s;
  return std::nullopt;
}

std::vector<int> Record::complete_steps() const {
  std::map<int, std::size_t> phases;  // number by step
  for (const PhaseSpan& s : phase_spans_) ++phases[s.step];
  std::size_t whole = 0;
  for (const auto& [step, n] : phases) whole = std::max(whole, n);

  std::vector<int> out;
  for (const auto& [step, n] : phases)
    if (n == whole) out.push_back(step);
  if (out.empty() || table_->complete || last_row() + 1 < rows()) return out;
  if (out.back() == phase_spans_.back().step) out.pop_back();
  return out;
}

}  // namespace sinew::analysis
