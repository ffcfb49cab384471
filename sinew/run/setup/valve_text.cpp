#include "sinew/run/setup/valve_text.h"

#include <fmt/format.h>

#include "sinew/gas/delay.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

namespace sinew::run {

std::string text_of(const gas::Valve& valve, const gas::ValveFlow& f,
                    const units::ShownUnits* shown) {
  const auto show = [&](double si, std::string_view unit, std::string_view display) {
    return shown ? shown->text(si, unit, 5) : units::format_quantity(si, unit, display, 5);
  };
  report::TextTable table({"", "", ""});
  table.add({"mass flow", show(f.mass_flow, "kg/s", "kg/s"),
             show(f.normal_flow, "m3/s", "L/min") + " ANR"});
  if (f.linear) table.add({"by the law itself", show(f.law_flow, "kg/s", "kg/s"), ""});
  table.add(
      {"flow",
       f.choked() ? "choked"
       : f.linear ? "free, linear"
                  : "free",
       fmt::format("ratio {:.{}f}, critical {:.4f}", f.ratio, f.linear ? 6 : 4, f.critical_ratio)});
  table.add({"effective area", show(f.area, "m2", "mm2"), shown ? "" : show(f.area, "m2", "in2")});
  table.add({"sonic conductance C", show(f.sonic_conductance, "m3/(s Pa)", "L/(s bar)"), ""});
  table.add({"delays", "opens after " + show(gas::delays(valve).opening, "s", "ms"),
             "shuts after " + show(gas::delays(valve).closing, "s", "ms")});
  return table.text().substr(1);
}

std::string text_of(const std::vector<Transfers>& times, double volume, const gas::ValveFlow& f,
                    const units::ShownUnits* shown, double room) {
  if (times.empty()) return "";
  const auto bar = [&](double p) {
    return shown ? shown->text(p, "Pa", 4, room)
                 : units::format_quantity(p, "Pa abs", "psi abs", 4);
  };
  std::string out = fmt::format(
      "\n{} between {} and {}, valve open:\n",
      shown ? shown->text(volume, "m3", 6) : units::format_quantity(volume, "m3", "in3"),
      bar(f.downstream), bar(f.upstream));
  using enum report::TextTable::Align;
  report::TextTable table({"the air", "of the way", "fill [ms]", "vent [ms]"},
                          {left, right, right, right});
  for (const Transfers& by : times)
    for (const gas::Transfer& t : by.times)
      table.add({&t == by.times.data() ? by.exchange : "", fmt::format("{:.0f} %", 100 * t.share),
                 fmt::format("{:.3f}", 1e3 * t.fill), fmt::format("{:.3f}", 1e3 * t.vent)});
  return out + table.text();
}

std::string text_of(const std::vector<Delivered>& duties, const std::string& frequency) {
  if (duties.empty()) return "";
  using enum report::TextTable::Align;
  std::string out = fmt::format("\nat {}:\n", frequency);
  report::TextTable table({"duty", "delivered"}, {right, right});
  for (const Delivered& d : duties)
    table.add({fmt::format("{:.4g} %", 100 * d.duty), fmt::format("{:.4g} %", 100 * d.delivered)});
  return out + table.text();
}

std::string flow_warning(const gas::Valve& valve, const gas::ValveFlow& f) {
  if (!f.linear) return "";
  return fmt::format(
      "{}: the pressures are {:.2g} % apart, less than linear_below, {:.2g} %: there the flow is a "
      "straight line through zero, so that the integrator can follow; the law itself gives {:.3g} "
      "times "
      "as much",
      valve.name, 100 * (1 - f.ratio), 100 * valve.flow.linear_below, f.law_flow / f.mass_flow);
}

std::string json_of(const gas::Valve& valve, const gas::ValveFlow& f,
                    const std::vector<Transfers>& times, const std::vector<Delivered>& duties) {
  Json out{{"valve", valve.name},
           {"upstream_Pa", f.upstream},
           {"downstream_Pa", f.downstream},
           {"mass_flow_kg_per_s", f.mass_flow},
           {"normal_flow_m3_per_s", f.normal_flow},
           {"pressure_ratio", f.ratio},
           {"critical_pressure_ratio", f.critical_ratio},
           {"choked", f.choked()},
           {"linear_part", f.linear},
           {"law_mass_flow_kg_per_s", f.law_flow},
           {"effective_area_m2", f.area},
           {"sonic_conductance_m3_per_s_Pa", f.sonic_conductance},
           {"opening_delay_s", gas::delays(valve).opening},
           {"closing_delay_s", gas::delays(valve).closing}};
  for (const Transfers& by : times)
    for (const gas::Transfer& t : by.times)
      out["transfers"].push_back({{"air", by.exchange},
                                  {"share", t.share},
                                  {"fill_time_s", t.fill},
                                  {"vent_time_s", t.vent}});
  for (const Delivered& d : duties)
    out["duties"].push_back({{"duty", d.duty}, {"delivered_duty", d.delivered}});
  return out.text();
}

}  // namespace sinew::run
