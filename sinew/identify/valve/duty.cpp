// Map of commanded and delivered duty, figure 3-13: the two delays of a valve.
//
//   delivered = D - (t_o - t_c) f          0 if D < t_o f          1 if 1 - D < t_c f          3.4
//
// The straight part determines only the difference of the delays. Its ends determine each delay,
// within the spacing of the duties there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

namespace {

constexpr double nothing =
    0.02;  // share of full delivery: less counts as nothing, more than 1 - it is full

struct Map {
  std::vector<double> duty, delivered, frequency;  // delivered, or a flow of any scale
  double full = 1;                                 // delivery at full duty
  bool flow = false;

  bool none(std::size_t i) const { return delivered[i] < nothing * full; }
  bool all(std::size_t i) const { return delivered[i] > (1 - nothing) * full; }
};

Map map_of(const Measured& data, const ValveOptions& options) {
  Map m{.duty = data["duty"], .flow = !data.has("delivered")};
  m.delivered = m.flow ? data[data.has("flow") ? "flow" : "mass_flow"] : data["delivered"];
  if (data.has("frequency"))
    m.frequency = data["frequency"];
  else if (options.frequency)
    m.frequency.assign(m.duty.size(), *options.frequency);
  else
    throw Refusal(data.file, "no frequency of the pulses",
                  "a column frequency [Hz], or one for all", "frequency=\"100 Hz\"");
  if (m.flow) m.full = largest(m.delivered);
  refuse_constant(data, "duty", 0.05, "duties that differ", "a sweep from 0 to 100 %");
  if (!(largest(m.delivered) - smallest(m.delivered) > nothing * m.full))
    throw Refusal(data.file, "the same delivery for all duties", "one that grows with the duty",
                  "the columns, and the frequency");
  return m;
}

// Interval that an end of the straight part gives for a delay [s].
struct Bracket {
  double low = 0, high = unbounded;
  bool seen_low = false, seen_high = false;

  bool closed() const { return seen_low && seen_high; }
};

// Returns the bracket of the opening delay, or of the closing delay: a shorter pulse, or a shorter
// gap between two, is lost.
Bracket bracket_of(const Map& m, bool opening) {
  Bracket b;
  for (std::size_t i = 0; i < m.duty.size(); ++i) {
    const double share = opening ? m.duty[i] : 1 - m.duty[i], time = share / m.frequency[i];
    const bool is_lost = opening ? m.none(i) : m.all(i);
    if (is_lost && share > 0 && time > b.low) b.low = time, b.seen_low = true;
    if (!is_lost && time < b.high) b.high = time, b.seen_high = true;
  }
  return b;
}

std::vector<std::size_t> straight_part(const Map& m) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < m.duty.size(); ++i)
    if (!m.none(i) && !m.all(i)) out.push_back(i);
  return out;
}

// Returns the problem of the difference of the delays, and the scale of a flow.
Candidate candidate_of(const Map& m, std::span<const std::size_t> rows, bool delayed) {
  Candidate out{.model = delayed ? "dead times" : "ideal",
                .law = delayed ? "delivered = D - (t_o - t_c) f, 0 below t_o f, 1 above 1 - t_c f"
                               : "delivered = D",
                .source = delayed ? "3.4" : "no delays"};
  const double period = 1 / largest(m.frequency);
  if (delayed)
    out.parameters.push_back({"delay_difference", "s", 0, -period, period, 0.01 * period});
  if (m.flow) out.parameters.push_back({"full_flow", "1", m.full, 0, 10 * m.full, m.full});
  out.predict = [&m, rows, delayed](std::span<const double> p, std::span<double> delivered) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double lost = delayed ? p[0] * m.frequency[rows[k]] : 0;
      delivered[k] = (m.flow ? p.back() : 1) * (m.duty[rows[k]] - lost);
    }
    return true;
  };
  return out;
}

// Returns the rows of the straight part.
Rows rows_of(const Map& m, std::span<const std::size_t> rows) {
  Rows out{.x = "commanded duty", .x_unit = "1"};
  for (const std::size_t i : rows) {
    out.at.push_back(m.duty[i]);
    out.measured.push_back(m.delivered[i]);
    out.group.push_back(fmt::format("{:.4g} Hz", m.frequency[i]));
  }
  return out;
}

Estimate delay_in(const Bracket& b, std::string name) {
  Estimate e{.name = std::move(name), .unit = "s", .value = 0.5 * (b.low + b.high)};
  e.low = b.low;
  e.high = b.high;
  e.standard_error = (b.high - b.low) / std::sqrt(12.0);
  return e;
}

// Makes both brackets and the difference with its interval consistent.
void join(Bracket& opening, Bracket& closing, const Estimate& difference) {
  const double low = std::isfinite(difference.low) ? difference.low : difference.value;
  const double high = std::isfinite(difference.high) ? difference.high : difference.value;
  const auto narrow = [](Bracket& b, double from, double to, bool closed) {
    if (from > b.low) b.low = from;
    if (to < b.high) b.high = to;
    if (closed) b.seen_low = b.seen_high = true;
    b.low = std::max(b.low, 0.0);
    if (b.low > b.high) b.low = b.high = 0.5 * (b.low + b.high);  // inconsistent due to noise
  };
  const Bracket o = opening, c = closing;
  narrow(opening, c.low + low, c.high + high, c.closed());
  narrow(closing, o.low - high, o.high - low, o.closed());
}

}  // namespace

ValveResult identify_duty(const Measured& data, const ValveOptions& options) {
  const Map m = map_of(data, options);
  const std::vector<std::size_t> straight = straight_part(m);
  if (straight.size() < 3)
    throw Refusal(data.file,
                  fmt::format("{} points between nothing and everything", straight.size()),
                  "at least three", "a lower frequency, or more duties");

  ValveResult out = before(options);
  Report& report = out.report;
  const std::string subject = "delays of a valve by its map of duties";
  if (m.flow)
    report.set_subject(subject, "delivered flow", data.has("flow") ? "m3/s" : "kg/s",
                       "the largest flow");
  else
    report.set_subject(subject, "delivered duty", "1", "the whole period");
  report.full_scale = m.full;
  report.held_out_is = "each point by a fit of all the others";
  report.notes = data.notes;
  report.not_shown = {"how the delays change with the pressure and with the supply's voltage"};
  report.rows = rows_of(m, straight);
  Trial trial{.measured = report.rows.measured};
  trial.splits = each_row_held_out(straight.size());
  fit_candidates({candidate_of(m, straight, false), candidate_of(m, straight, true)}, trial,
                 report);
  conclude(report);

  Fit& fit = report.fits[report.chosen];
  Bracket opening = bracket_of(m, true), closing = bracket_of(m, false);
  const Estimate difference = report.chosen == 1 ? fit.parameters.front() : Estimate{};
  join(opening, closing, difference);
  const std::string valve = "valve." + options.name + ".";
  const auto known = [&](const Bracket& b, const char* name, double& value, bool& flag) {
    if (!b.closed()) return;
    const Estimate e = delay_in(b, name);
    fit.parameters.push_back(e);
    value = e.value;
    flag = true;
    out.provenance.fitted(valve + name, e, "sinew identify valve " + data.file);
  };
  known(opening, "opening_delay", out.valve.opening_delay, out.opening_known);
  known(closing, "closing_delay", out.valve.closing_delay, out.closing_known);
  out.valve.profile = gas::Valve::Profile::dead_time;
  if (!out.opening_known)
    out.refused = fmt::format(
        "delays: found their difference alone, {:.4g} ms; expected a duty "
        "that delivers nothing or a smaller one than 1 that delivers everything: the straight part "
        "of the map does not separate the delays; try smaller and larger duties, or a higher "
        "frequency",
        1e3 * difference.value);
  return out;
}

}  // namespace sinew::identify
