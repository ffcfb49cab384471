#include "sinew/run/stand/recorder.h"

#include <cmath>
#include <string>

#include "sinew/experiment/faults.h"

namespace sinew::rig {

using signals::Tick;

namespace {

class Columns {
 public:
  template <class Value>
  void add(std::string name, std::string unit, std::string description, Value value) {
    list.push_back(
        {{std::move(name), std::move(description), {{"value", std::move(unit)}}}, value});
  }
  void truth(const std::string& name, std::string unit, std::string description,
             double plant::StandTruth::*which) {
    add("/true/" + name, std::move(unit), std::move(description),
        [which](const Snapshot& m) { return m.truth.*which; });
  }

  std::vector<Column> list;
};

bool has_law(const Experiment& e) {
  return e.drive.kind == Drive::Kind::feed_forward || e.drive.kind == Drive::Kind::feedback;
}

bool is_periodic(const Experiment& e) { return has_law(e) || e.drive.kind == Drive::Kind::pwm; }

bool by_valves(const Experiment& e) { return e.charge.mode == plant::Charge::Mode::valves; }

std::string unit_of(plant::Transducer::Of of) {
  using Of = plant::Transducer::Of;
  return of == Of::length ? "m" : of == Of::force ? "N" : of == Of::pressure ? "Pa" : "m/s^2";
}

void measured_columns(const Experiment& e, Columns& out) {
  for (std::size_t s = 0; s < e.sensors.size(); ++s) {
    const plant::Transducer& t = e.sensors[s];
    out.add("/sensor/" + t.name + "/count", "count", "as converted",
            [s](const Snapshot& m) { return double(m.seen.reading[s].counts); });
    out.add("/sensor/" + t.name + "/value", unit_of(t.of), "by its own scale; pressure is gauge",
            [s, t](const Snapshot& m) { return plant::quantity(t, m.seen.reading[s].counts); });
  }
  if (has_law(e))
    out.add("/desired/length", "m", "of the element",
            [](const Snapshot& m) { return m.seen.wish.length; });
  if (!is_periodic(e)) return;
  const std::string at = "/muscle/" + e.element.name;
  out.add(at + "/inlet_duty", "1", "commanded share of the period",
          [](const Snapshot& m) { return m.seen.shares.inlet; });
  if (!e.element.exhaust.empty())
    out.add(at + "/exhaust_duty", "1", "commanded share of the period",
            [](const Snapshot& m) { return m.seen.shares.exhaust; });
}

void true_columns(const Experiment& e, Columns& out) {
  using T = plant::StandTruth;
  out.truth("stand/length", "m", "of the element, grows as it is pulled", &T::length);
  out.truth("stand/velocity", "m/s", "of its length", &T::velocity);
  out.truth("stand/acceleration", "m/s^2", "of its length", &T::acceleration);
  out.truth("stand/force", "N", "of the element on the load, dry friction in it", &T::force);
  out.truth("stand/friction", "N", "dry part of the force", &T::friction);
  if (e.load.mode == plant::Load::Mode::hanging)
    out.truth("stand/mass", "kg", "that hangs", &T::load);
  const std::string at = "muscle/" + e.element.name;
  out.truth(at + "/pressure", "Pa", "absolute", &T::pressure);
  out.truth(at + "/mass", "kg", "of its air", &T::air);
  out.truth(at + "/air_in", "kg", "since the start", &T::air_in);
  out.truth(at + "/air_out", "kg", "since the start", &T::air_out);
  out.truth(at + "/air_leaked", "kg", "since the start", &T::air_leaked);
  if (e.element.hose.law != gas::Hose::Law::none && e.element.hose.volume > 0)
    out.truth("air/mass", "kg", "in element, hose and tank", &T::all_air);
  if (by_valves(e)) {
    out.truth("valve/" + e.element.name + "/inlet", "1", "open share of its area", &T::inlet);
    out.truth("valve/" + e.element.name + "/exhaust", "1", "open share of its area", &T::exhaust);
    out.truth("supply/pressure", "Pa", "of the line, absolute", &T::supply_pressure);
  }
  if (e.supply.kind == gas::Supply::Kind::tank)
    out.truth("supply/tank_pressure", "Pa", "absolute", &T::tank_pressure);
}

void fault_columns(const Experiment& e, Columns& out) {
  for (const experiment::FaultsOfPart& part : experiment::by_part(e.faults))
    out.add(part.topic, "1", experiment::fault_description,
            [part, period = e.log.period](const Snapshot& m) {
              return part.acted(m.time, period) ? 1.0 : 0.0;
            });
}

}  // namespace

std::vector<Column> columns(const Experiment& e) {
  Columns out;
  measured_columns(e, out);
  true_columns(e, out);
  fault_columns(e, out);
  return out.list;
}

std::vector<signals::Topic> valve_topics(const Experiment& e) {
  std::vector<signals::Topic> out;
  if (!by_valves(e)) return out;
  for (const char* which : {"inlet", "exhaust"}) {
    if (which[0] == 'e' && e.element.exhaust.empty()) continue;
    out.push_back(
        {"/valve/" + e.element.name + "/" + which + "/open", "electrical edges", {{"value", "1"}}});
  }
  return out;
}

Recorder::Recorder(const Experiment& e, const Controller& controller, plant::Stand& stand, Tick end,
                   bool every_tick)
    : controller_(controller),
      stand_(stand),
      columns_(columns(e)),
      valves_(valve_topics(e)),
      every_tick_(every_tick) {
  period_ = std::max<Tick>(1, std::llround(e.log.period / signals::tick_seconds));
  const auto samples = static_cast<std::size_t>(end / period_ + 2);
  rows_.reserve(samples * columns_.size());
  row_time_ns_.reserve(samples);
  const auto periods = static_cast<std::size_t>(end / controller.scan().period + 2);
  edges_.reserve(4 * periods + 2 * e.drive.pulses.size());
}

void Recorder::edge(const signals::Edge& edge) noexcept {
  if (edges_.size() == edges_.capacity())
    complete_ = false;
  else
    edges_.push_back(edge);
}

void Recorder::sample(Tick t) noexcept {
  if (t < next_) return;
  next_ += period_;
  if (rows_.capacity() - rows_.size() < columns_.size()) {
    complete_ = false;
    return;
  }
  const double time = static_cast<double>(t) * signals::tick_seconds;
  const plant::StandTruth truth = stand_.truth(time);
  if (stand_.failure()) return;  // no number of a stand that has failed is kept
  row_time_ns_.push_back(t * signals::tick_nanoseconds);
  const Snapshot now{controller_.seen(), truth, time};
  for (const Column& c : columns_) rows_.push_back(c.value(now));
}

signals::Table Recorder::take() {
  signals::Table table;
  table.complete = complete_;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    signals::Series s{std::move(columns_[c].topic), row_time_ns_, {{}}};
    for (std::size_t at = c; at < rows_.size(); at += columns_.size())
      s.columns[0].push_back(rows_[at]);
    table.series.push_back(std::move(s));
  }
  for (std::size_t v = 0; v < valves_.size(); ++v) {
    signals::Series s{std::move(valves_[v]), {}, {{}}};
    for (const signals::Edge& edge : edges_) {
      if (edge.valve.index != v) continue;
      s.time_ns.push_back(edge.at * signals::tick_nanoseconds);
      s.columns[0].push_back(edge.open ? 1.0 : 0.0);
    }
    table.series.push_back(std::move(s));
  }
  return table;
}

}  // namespace sinew::rig
