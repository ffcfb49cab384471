// design/valve_method.cpp - `sinew design valve`: the task of the settings, and the result.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sinew/actuator/body.h"
#include "sinew/config/diagnostics.h"
#include "sinew/design/air.h"
#include "sinew/design/catalogue.h"
#include "sinew/design/methods.h"
#include "sinew/design/valve.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/conductance.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

constexpr std::string_view given_name = "yours";

// --- the muscle ---

// Air and volumes of the muscle that is filled.
struct Filled {
  gas::Air air;
  Bounds begin, end;  // volumes before and after filling [m3]
};

Bounds with_uncertainty(double volume, double share) {
  return {volume * (1 - share), volume * (1 + share)};
}

// Returns the volume of one muscle of a file at a length.
double volume_at(const actuator::Actuator& a, double length, std::string_view setting,
                 const std::string& written) {
  require_length(a, length, setting, written);
  const double volume = actuator::volume(a, length);
  if (volume > 0) return volume;
  config::refuse_setting(setting, units::format_quantity(length, "m", "mm"),
                         "a length at which the muscle holds air");
}

Filled filled_by_volume(const ValveSettings& s, const config::SettingValues& values) {
  for (const auto& [setting, text] :
       {std::pair{"length", s.length}, {"contracted_length", s.contracted_length}})
    if (!text.empty())
      config::refuse_setting(setting, "a length without the muscle's file",
                             "a length of an actuator", R"(actuator="robots/leg/actuator.toml")");
  if (s.volume.empty())
    config::refuse_setting("volume", "nothing",
                           "the volume of the muscle, or its actuator file and length",
                           R"(volume="50 mL")");
  const double volume = s.count * values.of(s.volume) + values.of(s.external_volume);
  const Bounds bounds = with_uncertainty(volume, values.of(s.uncertainty));
  return {{}, bounds, bounds};
}

Filled filled_by_actuator(const ValveSettings& s) {
  const experiment::MachineFile file = experiment::load_machine_file(s.actuator);
  const config::SettingValues values(s, file.experiment.air.atmosphere);
  const actuator::Actuator& a =
      config::named(file.experiment.actuators, s.name, "name", "actuator", s.actuator);
  if (!s.volume.empty())
    config::refuse_setting("volume", "a volume with an actuator", "one of them");
  if (s.length.empty())
    config::refuse_setting("length", "nothing", "the length of the muscle as it begins to fill",
                           R"(length="90 mm")");
  const double share = values.of(s.uncertainty), hose = values.of(s.external_volume);
  const double begin = s.count * volume_at(a, values.of(s.length), "length", s.length) + hose;
  const double end = s.contracted_length.empty()
                         ? begin
                         : s.count * volume_at(a, values.of(s.contracted_length),
                                               "contracted_length", s.contracted_length) +
                               hose;
  return {file.experiment.air, with_uncertainty(begin, share), with_uncertainty(end, share)};
}

// --- the task ---

ValveTask task_of(const ValveSettings& s, const config::SettingValues& values,
                  const Filled& muscle) {
  const double room = muscle.air.atmosphere;
  const double full = room + values.of(s.pressure);
  ValveTask task{.air = muscle.air, .supply = room + values.of(s.supply)};
  task.critical_ratio = values.of(s.critical_ratio);
  const bool pulses = !s.frequency.empty();
  if (!s.fill_time.empty() || pulses || !s.flow.empty())
    task.fill = {room + values.of(s.start), full, muscle.begin, muscle.end,
                 values.given(s.fill_time).value_or(0)};
  if (!s.vent_time.empty() || !s.vent_to.empty()) {
    const double end = room + values.given(s.vent_to).value_or(0.1 * (full - room));
    task.vent = {full, end, muscle.end, muscle.begin, values.given(s.vent_time).value_or(0)};
  }
  if (pulses) {
    task.frequency = values.of(s.frequency);
    task.duty = {values.of(s.least_duty), values.of(s.greatest_duty)};
  }
  task.step = values.given(s.step).value_or(0);
  return task;
}

// --- the valves ---

// Returns the valves of all catalogues.
std::vector<PublishedValve> valves_of(const ValveSettings& s) {
  std::vector<PublishedValve> out;
  const bool shipped = s.catalogue.empty();
  for (const std::string& path : shipped ? std::vector{shipped_catalogue()} : s.catalogue)
    for (PublishedValve& valve : published_valves(path)) out.push_back(std::move(valve));
  return out;
}

// Returns the flow of "Cv 0.04" and the like.
gas::Flow flow_of(const std::string& text, double critical_ratio, const gas::Air& air) {
  const std::string_view all = units::trimmed(text);
  const std::size_t blank = all.find(' ');
  const std::string_view word = all.substr(0, blank);
  const std::string_view rest = blank == all.npos ? "" : units::trimmed(all.substr(blank));
  const auto number = [&](std::string_view unit, double most) {
    return config::quantity_setting("flow", rest, unit, air.atmosphere,
                                    config::above_zero(most, "of a valve at a muscle"));
  };
  gas::Flow out{.law = gas::Flow::Law::iso6358, .critical_pressure_ratio = critical_ratio};
  const auto nominal = [&](double flow) {
    out.sonic_conductance = gas::conductance_of_nominal_flow(flow, critical_ratio);
  };
  if (word == "C") {
    out.sonic_conductance = number("m3/(s Pa)", 1e-3);
  } else if (word == "Qn") {
    const units::NumberAndUnit given = units::split_number(rest);
    if (units::lower(given.unit).starts_with("nl/"))
      config::refuse_setting("flow", config::in_quotes(text), "the flow of free air, in L/min",
                             fmt::format(R"(flow="Qn {} L/min")", given.number));
    nominal(number("m3/s", 100));
  } else if (word == "Cv") {
    nominal(gas::nominal_flow_of_cv(number("1", 1e4)));
  } else if (word == "Kv") {
    nominal(gas::nominal_flow_of_cv(number("1", 1e4) / gas::kv_per_cv()));
  } else if (word == "A") {
    out = {.area = number("m2", 1)};
  } else {
    const std::vector<std::string_view> words{"C", "Qn", "Kv", "Cv", "A"};
    config::refuse_setting("flow", config::in_quotes(text),
                           "C, Qn, Kv, Cv or A and its value, such as \"Cv 0.04\"",
                           config::closest_in_quotes(word, words));
  }
  return out;
}

// Returns the valve that the settings give by its flow.
PublishedValve given_valve(const ValveSettings& s, const config::SettingValues& values,
                           const ValveTask& task) {
  PublishedValve out;
  out.valve.name = given_name;
  out.valve.flow = flow_of(s.flow, task.critical_ratio, task.air);
  if (const auto delay = values.given(s.opening_delay)) out.opening = Bounds{*delay, *delay};
  if (const auto delay = values.given(s.closing_delay)) out.closing = Bounds{*delay, *delay};
  return out;
}

// --- the result ---

std::string words_of(Verdict verdict) {
  constexpr std::string_view words[] = {"yes", "perhaps", "unknown", "no"};
  return std::string(words[static_cast<int>(verdict)]);
}

std::string words_of(gas::Valve::Kind kind) {
  return kind == gas::Valve::Kind::two_way ? "2-way" : "3-way";
}

// Appends a conductance and what makers publish instead, for a valve with this b.
void add_flow(Result& out, const std::string& key, const std::string& name, const Bounds& c,
              const ValveTask& task, const std::string& note) {
  const double b = task.critical_ratio, high = c.high;
  const auto add = [&](const std::string& what, const std::string& words, double number,
                       const std::string& unit, const std::string& text) {
    const double scale = high > 0 ? number / high : 0;
    out.values.push_back({key + what, words, number, unit, scale * c.low, scale * c.high, text});
  };
  const double flow = gas::nominal_flow_of(high, b), cv = gas::cv_of_nominal_flow(flow);
  add("sonic_conductance_m3_per_s_Pa", name, high, "m3/(s Pa)", note);
  add("nominal_flow_m3_per_s", "  as nominal flow Qn", flow, "m3/s",
      fmt::format("6 to 5 bar gauge, b = {:.3g}", b));
  add("kv", "  as Kv", cv * gas::kv_per_cv(), "1", "");
  add("cv", "  as Cv", cv, "1", "");
  add("effective_area_m2", "  as effective area", gas::effective_area_of(high, task.air), "m2",
      "same choked flow");
}

// Returns the flow that is enough for filling and venting.
Bounds needed_flow(const ValveNeed& need) {
  const auto largest = [](double a, double b) { return std::isfinite(a) ? std::fmax(a, b) : b; };
  return {largest(need.fill.low, need.vent.low), largest(need.fill.high, need.vent.high)};
}

void add_values(Result& out, const ValveNeed& need, const ValveTask& task) {
  const Bounds least = needed_flow(need);
  if (std::isfinite(least.high))
    add_flow(out, "", "sonic conductance C, at least", least, task,
             "to fill and vent in time, under the worst conditions");
  const auto add = [&](std::string key, std::string name, double number, std::string unit,
                       const Bounds& bounds, std::string note) {
    if (std::isfinite(number))
      out.values.push_back({std::move(key), std::move(name), number, std::move(unit), bounds.low,
                            bounds.high, std::move(note)});
  };
  constexpr Bounds none{Value::unknown, Value::unknown};
  add("fill_sonic_conductance_m3_per_s_Pa", "C to fill", need.fill.high, "m3/(s Pa)", need.fill,
      "heat, volume and load as bounds");
  add("vent_sonic_conductance_m3_per_s_Pa", "C to vent", need.vent.high, "m3/(s Pa)", need.vent,
      "heat, volume and load as bounds");
  add("greatest_sonic_conductance_m3_per_s_Pa", "C, at most", need.at_most, "m3/(s Pa)", none,
      "for the step of one pulse, with equal delays");
  add("opening_delay_s", "opens in less than", need.opening_below, "s", none, "the shortest pulse");
  add("closing_delay_s", "shuts in less than", need.closing_below, "s", none, "the shortest gap");
  add("pressure_difference_Pa", "pressure over the valve", need.pressure_difference, "Pa diff",
      none, "largest one");
}

double slowest(const std::optional<Bounds>& delay) { return delay ? delay->high : Value::unknown; }

std::string joined(const std::vector<std::string>& remarks) {
  std::string out;
  for (const std::string& remark : remarks) out += (out.empty() ? "" : "; ") + remark;
  return out;
}

Table table_of(const std::vector<ValveChoice>& choices) {
  Table out{.key = "valves",
            .title = "Valves: those that suffice first, each group with the least flow first",
            .columns = {{"valve", "valve"},
                        {"suffices", "suffices"},
                        {"kind", "kind"},
                        {"sonic_conductance_m3_per_s_Pa_low", "C from", "m3/(s Pa)"},
                        {"sonic_conductance_m3_per_s_Pa_high", "to", "m3/(s Pa)"},
                        {"fill_time_s", "fills within", "s"},
                        {"vent_time_s", "vents within", "s"},
                        {"step_Pa", "step up to", "Pa diff"},
                        {"opening_delay_s", "opens within", "s"},
                        {"closing_delay_s", "shuts within", "s"},
                        {"remarks", "remarks"}},
            .rows = {},
            .shown = 40};
  for (const ValveChoice& c : choices)
    out.rows.push_back({c.name, words_of(c.verdict),
                        c.name == given_name ? std::string("-") : words_of(c.kind),
                        c.conductance.low, c.conductance.high, c.fill.high, c.vent.high,
                        c.step.high, slowest(c.opening), slowest(c.closing), joined(c.remarks)});
  return out;
}

// Returns the delivered share of the first valve, at each tenth of the duty.
Table delivered_table(const ValveChoice& choice, double frequency) {
  Table out{
      .key = "delivered",
      .title = fmt::format("Share delivered by {} at {:.4g} Hz", choice.name, frequency),
      .columns = {{"duty", "duty"}, {"delivered_low", "delivered, from"}, {"delivered_high", "to"}},
      .rows = {}};
  const std::vector<DeliveredShare> shares = delivered_shares(choice, frequency);
  for (std::size_t i = 0; i < shares.size(); i += 10)
    out.rows.push_back({shares[i].duty, shares[i].delivered.low, shares[i].delivered.high});
  return out;
}

// Returns up to six choices whose delays are known, with the best verdict that any of them has;
// first the valve that is given.
std::vector<const ValveChoice*> with_pulses(const std::vector<ValveChoice>& choices) {
  std::vector<const ValveChoice*> out;
  for (const ValveChoice& c : choices)
    if (c.name == given_name && c.opening && c.closing) out.push_back(&c);
  std::optional<Verdict> best;
  for (const ValveChoice& c : choices) {
    if (c.name == given_name || !c.opening || !c.closing) continue;
    if (!best) best = std::max(c.verdict, Verdict::may_suffice);
    if (c.verdict <= *best && out.size() < 6) out.push_back(&c);
  }
  return out;
}

report::Plot delivered_plot(const std::vector<const ValveChoice*>& choices, double frequency) {
  report::Plot out{.name = "delivered",
                   .title = fmt::format("Share delivered at {:.4g} Hz", frequency),
                   .x = {.name = "duty", .unit = "-"},
                   .y = {.name = "share delivered", .unit = "-"}};
  out.curves.push_back(
      {.label = "as commanded", .xs = {0, 1}, .ys = {0, 1}, .kind = report::Curve::Kind::desired});
  for (const ValveChoice* c : choices) {
    report::Curve curve{.label = c->name};
    for (const DeliveredShare& s : delivered_shares(*c, frequency)) {
      curve.xs.push_back(s.duty);
      curve.ys.push_back(s.delivered.low);
      curve.ys_high.push_back(s.delivered.high);
    }
    if (curve.ys == curve.ys_high)
      curve.ys_high.clear();
    else
      curve.style = report::Curve::Style::band;
    out.curves.push_back(std::move(curve));
  }
  return out;
}

// Returns the slowest times over the flow: what any valve needs, and those of the list.
report::Plot time_plot(const std::vector<ValveChoice>& choices, const ValveNeed& need,
                       const ValveTask& task) {
  report::Plot out{.name = "times",
                   .title = "Times over the flow",
                   .x = {.name = "sonic conductance", .unit = "m3/(s Pa)", .logarithmic = true},
                   .y = {.name = "time", .unit = "s", .logarithmic = true}};
  const auto add = [&](const std::optional<AirChange>& change, const Bounds& flow,
                       const std::string& does, Bounds ValveChoice::*times) {
    if (!change || !(change->time > 0)) return;
    report::Curve band{.label = "any valve, to " + does, .style = report::Curve::Style::band};
    for (int i = -20; i <= 20; ++i) {
      const double factor = std::pow(10, 0.05 * i);
      band.xs.push_back(flow.high * factor);
      band.ys.push_back(change->time * flow.low / flow.high / factor);
      band.ys_high.push_back(change->time / factor);
    }
    report::Curve listed{.label = "valves, to " + does, .style = report::Curve::Style::points};
    for (const ValveChoice& c : choices)
      if (std::isfinite((c.*times).high)) {
        listed.xs.push_back(c.sonic_conductance);
        listed.ys.push_back((c.*times).high);
      }
    report::Curve wanted{.label = "wanted, to " + does,
                         .xs = {band.xs.front(), band.xs.back()},
                         .ys = {change->time, change->time},
                         .kind = report::Curve::Kind::desired};
    out.curves.push_back(std::move(band));
    out.curves.push_back(std::move(listed));
    out.curves.push_back(std::move(wanted));
  };
  add(task.fill, need.fill, "fill", &ValveChoice::fill);
  add(task.vent, need.vent, "vent", &ValveChoice::vent);
  return out;
}

std::string title_of(const ValveTask& task) {
  const auto gauge = [&](double pressure) {
    return units::format_quantity(pressure - task.air.atmosphere, "Pa gauge", "bar gauge", 4);
  };
  const AirChange& change = task.fill ? *task.fill : *task.vent;
  const Bounds& end = task.fill ? change.volume_to : change.volume_from;
  std::string out = fmt::format("a valve for {} of air",
                                units::format_quantity(0.5 * (end.low + end.high), "m3", "mL", 4));
  if (task.fill && task.fill->time > 0)
    out += fmt::format(", filled to {} in {:.4g} ms", gauge(task.fill->to), 1e3 * task.fill->time);
  if (task.vent && task.vent->time > 0)
    out += fmt::format(", vented to {} in {:.4g} ms", gauge(task.vent->to), 1e3 * task.vent->time);
  if (task.frequency > 0) out += fmt::format(", pulses of {:.4g} Hz", task.frequency);
  return out;
}

// Adds the reason of the order, and what a kind of valve means.
void add_notes(Result& out, const std::vector<ValveChoice>& choices) {
  const ValveChoice* first = nullptr;
  for (const ValveChoice& c : choices)
    if (!first && c.name != given_name && c.verdict <= Verdict::may_suffice) first = &c;
  if (first)
    out.notes.push_back(fmt::format(
        "{}: {}, the least flow {}; a larger valve fills faster, and its pulses step coarser",
        first->name, words_of(first->kind),
        first->verdict == Verdict::suffices ? "that suffices"
                                            : "that suffices under the best conditions"));
  out.notes.push_back(
      "a 2-way valve does one direction: one fills, another one vents, and shut they trap the "
      "air; a 3-way valve does both and traps none (Colbrunn 2000, 5.1)");
  out.notes.push_back(
      "unknown: a number that decides is not published; sinew identify valve measures it");
}

void add_warnings(Result& out, const std::vector<ValveChoice>& choices, const ValveNeed& need) {
  const Bounds least = needed_flow(need);
  const auto suffices = [](const ValveChoice& c) { return c.verdict == Verdict::suffices; };
  if (need.at_most < least.high && std::ranges::none_of(choices, suffices))
    out.warnings.push_back(
        fmt::format("with equal delays no flow does both: the times need {:.3g} L/(s bar), the "
                    "step allows {:.3g}; a higher "
                    "frequency or a smaller least duty makes a pulse shorter",
                    least.high * 1e8, need.at_most * 1e8));
  const auto does = [](const ValveChoice& c) { return c.verdict != Verdict::misses; };
  if (std::ranges::none_of(choices, does))
    out.warnings.push_back("no valve of the list does this; the column of remarks has the reasons");
}

}  // namespace

Result design(const ValveSettings& s) {
  const config::SettingValues checked(s);
  const Filled muscle = s.actuator.empty() ? filled_by_volume(s, checked) : filled_by_actuator(s);
  const config::SettingValues values(s, muscle.air.atmosphere);
  const ValveTask task = task_of(s, values, muscle);
  if (s.flow.empty())
    for (const auto& [setting, text] :
         {std::pair{"opening_delay", s.opening_delay}, {"closing_delay", s.closing_delay}})
      if (!text.empty())
        config::refuse_setting(setting, "a delay without its valve", "the flow of that valve",
                               R"(flow="Cv 0.04")");
  const ValveNeed need = need_of(task);
  std::vector<PublishedValve> valves = valves_of(s);
  if (!s.flow.empty()) valves.push_back(given_valve(s, values, task));
  const std::vector<ValveChoice> choices = choose_valves(task, valves);

  Result out{.method = "valve", .title = title_of(task)};
  add_values(out, need, task);
  out.tables = {table_of(choices)};
  if (task.frequency > 0) {
    const std::vector<const ValveChoice*> pulsed = with_pulses(choices);
    if (!pulsed.empty()) {
      out.tables.push_back(delivered_table(*pulsed.front(), task.frequency));
      out.plots.push_back(delivered_plot(pulsed, task.frequency));
    }
  }
  if (std::isfinite(needed_flow(need).high)) out.plots.push_back(time_plot(choices, need, task));
  add_notes(out, choices);
  add_warnings(out, choices, need);
  out.unseen = {
      "The hose's resistance, and the inertia and friction of what moves: they take more "
      "time.",
      "Wear, supply voltage and temperature of the coil; leaks."};
  for (const ValveChoice& c : choices)
    if (c.name == given_name) {
      Bounds flow{c.sonic_conductance, c.sonic_conductance};
      add_flow(out, "given_", "C of your valve", flow, task, "");
      if (c.verdict == Verdict::misses)
        out.refused = "your valve does not do this: " + joined(c.remarks);
    }
  return out;
}

}  // namespace sinew::design
