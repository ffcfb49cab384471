#include "sinew/gas/valve_flow.h"

#include <algorithm>

#include "sinew/gas/fill.h"
#include "sinew/gas/orifice.h"

namespace sinew::gas {

ValveFlow flow_through(const Flow& flow, const Air& air, double upstream, double downstream) {
  ValveFlow out{.upstream = upstream, .downstream = downstream};
  const bool iso = flow.law == Flow::Law::iso6358;
  const double high = std::max(upstream, downstream), low = std::min(upstream, downstream);
  out.mass_flow = mass_flow(flow, air, upstream, downstream);
  Flow law = flow;
  law.linear_below = 0;
  out.law_flow = mass_flow(law, air, upstream, downstream);
  out.linear = upstream != downstream && in_linear_part(flow, upstream, downstream);
  out.normal_flow = out.mass_flow / iso_density;
  out.ratio = low / high;
  out.critical_ratio = critical_ratio(flow);
  out.area = iso ? effective_area_of(flow.sonic_conductance, air) : flow.area * flow.efficiency;
  out.sonic_conductance = iso ? flow.sonic_conductance : sonic_conductance_of(out.area, air);
  return out;
}

std::vector<Transfer> transfers(const Flow& flow, const Air& air, double volume, const ValveFlow& f,
                                Exchange exchange) {
  const auto time = [&](double port, double from, double to) {
    switch (exchange) {
      case Exchange::adiabatic:
        return adiabatic_transfer_time(flow, air, volume, port, from, to);
      case Exchange::walls:
        return warm_transfer_time(flow, air, volume, port, from, to);
      case Exchange::isothermal:
        return isothermal_transfer_time(flow, air, volume, port, from, to);
      case Exchange::polytrope:
        break;
    }
    return transfer_time(flow, air, volume, port, from, to);
  };
  std::vector<Transfer> out;
  for (const double share : {0.5, 0.9, 0.99}) {
    const double way = share * (f.upstream - f.downstream);
    out.push_back({share, time(f.upstream, f.downstream, f.downstream + way),
                   time(f.downstream, f.upstream, f.upstream - way)});
  }
  return out;
}

}  // namespace sinew::gas
