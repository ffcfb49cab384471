// run/controllers/stand_columns.cpp - columns of a test stand's log: those that hardware logs as
// well, then those of a simulation only.
#include <string>

#include "sinew/run/controllers/column_list.h"

namespace sinew::run {
namespace {

using experiment::Stand;

bool has_law(const Stand& s) {
  return s.drive.kind == Stand::Drive::Kind::feed_forward ||
         s.drive.kind == Stand::Drive::Kind::feedback;
}

std::string unit_of(robot::Transducer::Of of) {
  using Of = robot::Transducer::Of;
  return of == Of::length ? "m" : of == Of::force ? "N" : of == Of::pressure ? "Pa" : "m/s^2";
}

void measured_columns(const Stand& stand, Columns& out) {
  for (std::size_t s = 0; s < stand.sensors.size(); ++s) {
    const robot::Transducer& t = stand.sensors[s];
    out.scalar("/sensor/" + t.name + "/count", "count", "as converted",
               [s](const Snapshot& m) { return double(m.controller->reading(s).counts); });
    out.scalar(
        "/sensor/" + t.name + "/value", unit_of(t.of), "by its own scale; pressure is gauge",
        [s, t](const Snapshot& m) { return robot::quantity(t, m.controller->reading(s).counts); });
  }
  if (has_law(stand))
    out.scalar("/desired/length", "m", "of the element",
               [](const Snapshot& m) { return m.drive->setpoint().length; });
  if (!has_law(stand) && stand.drive.kind != Stand::Drive::Kind::pwm) return;
  const std::string at = "/muscle/" + stand.element.name;
  out.scalar(at + "/inlet_duty", "1", "commanded share of the period",
             [](const Snapshot& m) { return m.drive->shares().inlet; });
  if (!stand.element.exhaust.empty())
    out.scalar(at + "/exhaust_duty", "1", "commanded share of the period",
               [](const Snapshot& m) { return m.drive->shares().exhaust; });
}

void true_stand_columns(const experiment::Experiment& e, Columns& out) {
  using T = plant::StandTruth;
  const Stand& stand = *e.stand;
  const auto truth = [&](const std::string& name, std::string unit, std::string description,
                         double T::*which) {
    out.scalar("/true/" + name, std::move(unit), std::move(description),
               [which](const Snapshot& m) { return m.true_of->stand.*which; });
  };
  truth("stand/length", "m", "of the element, grows as it is pulled", &T::length);
  truth("stand/velocity", "m/s", "of its length", &T::velocity);
  truth("stand/acceleration", "m/s^2", "of its length", &T::acceleration);
  truth("stand/force", "N", "of the element on the load, dry friction in it", &T::force);
  truth("stand/friction", "N", "dry part of the force", &T::friction);
  if (stand.load.mode == robot::Stand::Load::Mode::hanging)
    truth("stand/mass", "kg", "that hangs", &T::load);
  const std::string& name = stand.element.name;
  const std::string at = "muscle/" + name;
  truth(at + "/pressure", "Pa", "absolute", &T::pressure);
  truth(at + "/mass", "kg", "of its air", &T::air);
  truth(at + "/air_in", "kg", "since the start", &T::air_in);
  truth(at + "/air_out", "kg", "since the start", &T::air_out);
  truth(at + "/air_leaked", "kg", "since the start", &T::air_leaked);
  if (stand.element.hose.law != gas::Hose::Law::none && stand.element.hose.volume > 0)
    truth("air/mass", "kg", "in element, hose and tank", &T::all_air);
  if (stand.charge.mode == robot::Stand::Charge::Mode::valves) {
    truth("valve/" + name + "/inlet", "1", "open share of its area", &T::inlet);
    truth("valve/" + name + "/exhaust", "1", "open share of its area", &T::exhaust);
    truth("supply/pressure", "Pa", "of the line, absolute", &T::supply_pressure);
  }
  if (e.supply.kind == gas::Supply::Kind::tank)
    truth("supply/tank_pressure", "Pa", "absolute", &T::tank_pressure);
}

}  // namespace

void stand_columns(const experiment::Experiment& e, Columns& out) {
  measured_columns(*e.stand, out);
  true_stand_columns(e, out);
  true_fault_columns(e, out);
}

}  // namespace sinew::run
