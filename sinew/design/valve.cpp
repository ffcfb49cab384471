#include "sinew/design/valve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sinew/config/setting.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/pulse.h"
#include "sinew/units/constants.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

using gas::Order;

// Times that differ by less than rounding are equal.
constexpr double rounding = 1 + 1e-9;

// --- the task ---

std::string gauge_text(const gas::Air& air, double pressure) {
  return units::format_quantity(pressure - air.atmosphere, "Pa gauge", "bar gauge", 4);
}

void require_volume(const AirChange& change) {
  if (!(change.volume_from.low > 0 && change.volume_to.low > 0))
    config::refuse_setting("volume", "no air in the muscle",
                           "a volume above 0, or an actuator with its lengths");
}

void require_fill(const ValveTask& task) {
  const AirChange& fill = *task.fill;
  require_volume(fill);
  if (fill.to >= task.supply)
    config::refuse_setting(
        "pressure", gauge_text(task.air, fill.to),
        "a pressure below that of the supply, " + gauge_text(task.air, task.supply));
  if (fill.to < fill.from)
    config::refuse_setting(
        "pressure", gauge_text(task.air, fill.to),
        "no less than the pressure at the start, " + gauge_text(task.air, fill.from));
  if (fill.volume_to.low < fill.volume_from.low)
    config::refuse_setting("contracted_length", "less air in the muscle than at the start",
                           "a shorter muscle, which holds more");
}

void require_vent(const ValveTask& task) {
  const AirChange& vent = *task.vent;
  require_volume(vent);
  if (vent.from <= task.air.atmosphere)
    config::refuse_setting("pressure", gauge_text(task.air, vent.from),
                           "a pressure above that of the room, into which the muscle is vented");
  if (vent.to <= task.air.atmosphere)
    config::refuse_setting("vent_to", gauge_text(task.air, vent.to),
                           "a pressure above that of the room, into which the muscle is vented");
  if (vent.to > vent.from)
    config::refuse_setting(
        "vent_to", gauge_text(task.air, vent.to),
        "no more than the pressure at the start, " + gauge_text(task.air, vent.from));
}

void require_pulses(const ValveTask& task) {
  if (task.step > 0 && !(task.frequency > 0))
    config::refuse_setting("step", "a pressure step without pulses", "their frequency too");
  if (!(task.frequency > 0)) return;
  const auto [low, high] = task.duty;
  if (!(high < 1))
    config::refuse_setting("greatest_duty", fmt::format("{:.4g}", high), "less than 1");
  if (!(low > 0 && low < high))
    config::refuse_setting("least_duty", fmt::format("{:.4g}", low),
                           fmt::format("a duty above 0 and below the greatest duty, {:.4g}", high));
}

void require_possible(const ValveTask& task) {
  if (task.fill) require_fill(task);
  if (task.vent) require_vent(task);
  require_pulses(task);
  if (!task.fill && !task.vent)
    config::refuse_setting("fill_time", "nothing",
                           "a time to fill or to vent, or the frequency of pulses",
                           R"(fill_time="100 ms")");
}

// --- flow ---

gas::Flow flow_of(double sonic_conductance, double critical_ratio) {
  return {.law = gas::Flow::Law::iso6358,
          .sonic_conductance = sonic_conductance,
          .critical_pressure_ratio = critical_ratio};
}

double conductance_of(const gas::Flow& flow, const gas::Air& air) {
  return flow.law == gas::Flow::Law::iso6358
             ? flow.sonic_conductance
             : gas::sonic_conductance_of(flow.area * flow.efficiency, air);
}

// Returns the rate of the pressure at the start of a change, where it is greatest [Pa/s].
Bounds pressure_rate(const gas::Flow& flow, const gas::Air& air, double port,
                     const AirChange& change) {
  const double rate =
      std::abs(gas::mass_flow(flow, air, port, change.from)) * air.gas_constant * air.temperature;
  return {rate / change.volume_from.high, gas::heat_capacity_ratio * rate / change.volume_from.low};
}

// Returns the greater rate of the two changes [Pa/s].
Bounds fastest_rate(const ValveTask& task, const gas::Flow& flow) {
  Bounds out;
  const auto with = [&](const std::optional<AirChange>& change, double port) {
    if (!change) return;
    const Bounds rate = pressure_rate(flow, task.air, port, *change);
    out = {std::max(out.low, rate.low), std::max(out.high, rate.high)};
  };
  with(task.fill, task.supply);
  with(task.vent, task.air.atmosphere);
  return out;
}

// --- a valve of the list ---

// Returns bounds as text in a unit.
std::string between(const Bounds& b, double unit, std::string_view name) {
  if (!std::isfinite(b.high)) return fmt::format("at least {:.3g} {}", b.low / unit, name);
  const std::string low = fmt::format("{:.3g}", b.low / unit);
  const std::string high = fmt::format("{:.3g}", b.high / unit);
  return low == high ? low + " " + std::string(name) : fmt::format("{} to {} {}", low, high, name);
}
std::string milliseconds(const Bounds& b) { return between(b, 1e-3, "ms"); }

// Returns the flow of a published valve with another critical ratio; an orifice has none.
gas::Flow with_critical_ratio(gas::Flow flow, double ratio) {
  if (flow.law == gas::Flow::Law::iso6358) flow.critical_pressure_ratio = ratio;
  return flow;
}

// Collects the verdict of one valve: the worst of all.
class Judge {
 public:
  Judge(const ValveTask& task, const ValveNeed& need, const PublishedValve& published)
      : task_(task),
        need_(need),
        published_(published),
        valve_(published.valve),
        slow_(valve_.flow),
        fast_(valve_.flow) {
    if (!published.critical_ratio) return;
    slow_ = with_critical_ratio(slow_, published.critical_ratio->low);
    fast_ = with_critical_ratio(fast_, published.critical_ratio->high);
  }

  ValveChoice choice() {
    out_.name = valve_.name;
    out_.kind = valve_.kind;
    const double c = out_.sonic_conductance = conductance_of(valve_.flow, task_.air);
    out_.conductance = {c * published_.flow.low, c * published_.flow.high};
    if (!published_.is_flow_published) out_.conductance = {ValveNeed::none, ValveNeed::none};
    out_.opening = at_pressure(published_.opening, valve_.opening_delay_slope);
    out_.closing = at_pressure(published_.closing, valve_.closing_delay_slope);
    judge_pressure();
    judge_pulses();
    judge_flow();
    return std::move(out_);
  }

 private:
  void put(Verdict verdict, std::string remark) {
    out_.verdict = std::max(out_.verdict, verdict);
    out_.remarks.push_back(std::move(remark));
  }

  std::optional<Bounds> at_pressure(const std::optional<Bounds>& delay, double slope) const {
    if (!delay) return std::nullopt;
    const double more = slope * need_.pressure_difference;
    return Bounds{std::max(0.0, delay->low + more), std::max(0.0, delay->high + more)};
  }

  void judge_pressure() {
    const double difference = need_.pressure_difference;
    const Bounds limit =
        published_.fails_above.value_or(Bounds{valve_.fails_above, valve_.fails_above});
    if (!(limit.low > 0) || difference <= limit.low) return;
    if (difference <= limit.high)
      put(Verdict::unknown, fmt::format("opens up to {:.3g} bar, not published at {:.3g} bar",
                                        limit.low / units::bar, difference / units::bar));
    else
      put(Verdict::misses, fmt::format("known to open up to {:.3g} bar, not at {:.3g} bar",
                                       limit.high / units::bar, difference / units::bar));
  }

  void judge_pulses() {
    if (!(task_.frequency > 0)) return;
    if (!out_.opening || !out_.closing)
      put(Verdict::unknown, out_.opening   ? "closing time not published"
                            : out_.closing ? "opening time not published"
                                           : "opening and closing times not published");
    if (out_.opening) judge_delay(*out_.opening, need_.opening_below, "opens", "shortest pulse");
    if (out_.closing) judge_delay(*out_.closing, need_.closing_below, "shuts", "shortest gap");
    if (valve_.max_frequency > 0 && task_.frequency > valve_.max_frequency)
      put(Verdict::misses, fmt::format("follows up to {:.4g} Hz", valve_.max_frequency));
  }

  void judge_delay(const Bounds& delay, double below, std::string_view does,
                   std::string_view time) {
    if (delay.high < below) return;
    put(delay.low < below ? Verdict::may_suffice : Verdict::misses,
        fmt::format("{} after {}, {} {:.3g} ms", does, milliseconds(delay), time, 1e3 * below));
  }

  void judge_flow() {
    if (!published_.is_flow_published) return put(Verdict::unknown, "flow not published");
    if (task_.fill) out_.fill = timed(*task_.fill, task_.supply, "fill");
    if (task_.vent) out_.vent = timed(*task_.vent, task_.air.atmosphere, "vent");
    judge_step();
  }

  // Returns the time of a change with the opening delay.
  Bounds timed(const AirChange& change, double port, std::string_view does) {
    const Bounds open{change_time(fast_, task_.air, port, change).low,
                      change_time(slow_, task_.air, port, change).high};
    const Bounds delay = out_.opening.value_or(Bounds{});
    const Bounds time{delay.low + open.low / published_.flow.high,
                      delay.high + open.high / published_.flow.low};
    if (!(change.time > 0)) return time;
    if (time.low > change.time * rounding) {
      const double left = change.time - delay.low;
      put(Verdict::misses,
          left > 0 ? fmt::format("too small to {} by a factor of {:.3g}", does,
                                 (time.low - delay.low) / left)
                   : fmt::format("opens after {}, too late to {}", milliseconds(delay), does));
    } else if (time.high > change.time * rounding) {
      put(Verdict::may_suffice, fmt::format("needs {} to {}", milliseconds(time), does));
    } else if (!out_.opening && !(task_.frequency > 0)) {
      put(Verdict::may_suffice, fmt::format("time to {} without the opening time, which is not "
                                            "published",
                                            does));
    }
    return time;
  }

  void judge_step() {
    if (!(task_.frequency > 0) || !out_.opening || !out_.closing) return;
    if (out_.opening->low >= need_.opening_below) return;  // no pulse opens it
    const Bounds rate{fastest_rate(task_, slow_).low, fastest_rate(task_, fast_).high};
    const auto open = [&](double opening, double closing) {
      return gas::delivered_open_time(task_.duty.low, 1.0 / task_.frequency, opening, closing);
    };
    out_.step = {rate.low * published_.flow.low * open(out_.opening->high, out_.closing->low),
                 rate.high * published_.flow.high * open(out_.opening->low, out_.closing->high)};
    if (!(task_.step > 0) || out_.step.high <= task_.step * rounding) return;
    const std::string is = between(out_.step, units::bar, "bar");
    put(out_.step.low <= task_.step * rounding ? Verdict::may_suffice : Verdict::misses,
        fmt::format("one pulse changes the pressure by {}, {:.3g} bar allowed", is,
                    task_.step / units::bar));
  }

  const ValveTask& task_;
  const ValveNeed& need_;
  const PublishedValve& published_;
  const gas::Valve& valve_;
  gas::Flow slow_, fast_;  // at the ends of the range of its critical ratio
  ValveChoice out_;
};

}  // namespace

Bounds change_time(const gas::Flow& flow, const gas::Air& air, double port,
                   const AirChange& change) {
  Bounds out{std::numeric_limits<double>::infinity(), 0};
  const std::pair<double, double> volumes[] = {{change.volume_from.low, change.volume_to.low},
                                               {change.volume_from.high, change.volume_to.high}};
  for (const auto& [first, last] : volumes)
    for (const bool adiabatic : {false, true})
      for (const Order order : {Order::volume_first, Order::pressure_first}) {
        const gas::Stroke stroke{change.from, change.to, first, last};
        const double time = gas::stroke_time(flow, air, port, stroke, adiabatic, order);
        out = {std::min(out.low, time), std::max(out.high, time)};
      }
  return out;
}

Bounds conductance_for(const gas::Air& air, double port, const AirChange& change,
                       double critical_ratio) {
  constexpr double tried = 1e-8;  // 1 L/(s bar)
  const Bounds time = change_time(flow_of(tried, critical_ratio), air, port, change);
  return {tried * time.low / change.time, tried * time.high / change.time};
}

ValveNeed need_of(const ValveTask& task) {
  require_possible(task);
  ValveNeed out;
  if (task.fill) out.pressure_difference = task.supply - task.fill->from;
  if (task.vent)
    out.pressure_difference =
        std::max(out.pressure_difference, task.vent->from - task.air.atmosphere);
  if (task.fill && task.fill->time > 0)
    out.fill = conductance_for(task.air, task.supply, *task.fill, task.critical_ratio);
  if (task.vent && task.vent->time > 0)
    out.vent = conductance_for(task.air, task.air.atmosphere, *task.vent, task.critical_ratio);
  if (!(task.frequency > 0)) return out;

  out.opening_below = task.duty.low / task.frequency;
  out.closing_below = (1 - task.duty.high) / task.frequency;
  constexpr double tried = 1e-8;
  const double rate = fastest_rate(task, flow_of(tried, task.critical_ratio)).high;
  if (task.step > 0) out.at_most = tried * task.step / (rate * out.opening_below);
  return out;
}

std::vector<ValveChoice> choose_valves(const ValveTask& task,
                                       const std::vector<PublishedValve>& valves) {
  const ValveNeed need = need_of(task);
  std::vector<ValveChoice> out;
  for (const PublishedValve& valve : valves)
    if (valve.valve.kind != gas::Valve::Kind::regulator)
      out.push_back(Judge(task, need, valve).choice());
  std::ranges::stable_sort(out, [](const ValveChoice& a, const ValveChoice& b) {
    if (a.verdict != b.verdict) return a.verdict < b.verdict;
    if (a.sonic_conductance != b.sonic_conductance)
      return a.sonic_conductance < b.sonic_conductance;
    return a.name < b.name;
  });
  return out;
}

std::vector<DeliveredShare> delivered_shares(const ValveChoice& valve, double frequency) {
  std::vector<DeliveredShare> out;
  if (!valve.opening || !valve.closing) return out;
  const double period = 1.0 / frequency;
  for (int i = 0; i <= 100; ++i) {
    const double duty = 0.01 * i;
    out.push_back({duty,
                   {gas::delivered_duty(duty, period, valve.opening->high, valve.closing->low),
                    gas::delivered_duty(duty, period, valve.opening->low, valve.closing->high)}});
  }
  return out;
}

}  // namespace sinew::design
