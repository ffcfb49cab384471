#include "sinew/design/catalogue.h"

#include "sinew/config/diagnostics.h"
#include "sinew/config/origin.h"
#include "sinew/config/shipped.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/delay.h"

namespace sinew::design {

namespace {

using config::Origins;

// Returns the range that the file states for a value; without one, the value as both bounds.
Bounds bounds_of(const config::Origin* origin, double value) {
  if (!origin || !origin->range_si) return {value, value};
  return {(*origin->range_si)[0], (*origin->range_si)[1]};
}

// Returns the bounds of a delay; nothing if the file has no such key.
std::optional<Bounds> delay_of(const Origins& origins, const std::string& path, double value) {
  const config::Origin* origin = config::find_origin(origins, path);
  if (!origin || origin->is_default) return std::nullopt;
  return bounds_of(origin, value);
}

// Returns a valve with the bounds that its maker publishes.
PublishedValve published(const gas::Valve& valve, const Origins& origins) {
  const std::string path = "valve." + valve.name + ".";
  const bool iso = valve.flow.law == gas::Flow::Law::iso6358;
  const double flow = iso ? valve.flow.sonic_conductance : valve.flow.area;
  const config::Origin* origin =
      config::find_origin(origins, path + (iso ? "flow.sonic_conductance" : "flow.area"));
  const Bounds bounds = bounds_of(origin, flow);

  PublishedValve out{.valve = valve};
  if (flow > 0) out.flow = {bounds.low / flow, bounds.high / flow};
  const bool is_unpublished =
      origin && origin->guess && (!origin->range_si || origin->source.starts_with("not published"));
  out.is_flow_published = flow > 0 && !is_unpublished;
  if (iso)
    out.critical_ratio =
        bounds_of(config::find_origin(origins, path + "flow.critical_pressure_ratio"),
                  valve.flow.critical_pressure_ratio);
  if (valve.fails_above > 0)
    out.fails_above =
        bounds_of(config::find_origin(origins, path + "fails_above"), valve.fails_above);
  const bool ideal = valve.profile == gas::Valve::Profile::ideal;
  const std::string drive = valve.drive == gas::Valve::Drive::speed_up ? "speed_up." : "";
  const gas::Delays delays = gas::delays(valve);
  out.opening =
      ideal ? Bounds{} : delay_of(origins, path + drive + "opening_delay", delays.opening);
  out.closing =
      ideal ? Bounds{} : delay_of(origins, path + drive + "closing_delay", delays.closing);
  return out;
}

}  // namespace

std::string shipped_catalogue() { return (config::shipped_folder() / "data/valves.toml").string(); }

std::vector<PublishedValve> published_valves(const std::string& path) {
  const auto file = experiment::load_machine_file(path);
  std::vector<PublishedValve> out;
  for (const gas::Valve& valve : file.experiment.valves)
    out.push_back(published(valve, file.experiment.origins));
  if (out.empty()) config::fail({path, 0, 0}, "", "no valves", "a valves file");
  return out;
}

}  // namespace sinew::design
