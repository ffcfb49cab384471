#include "sinew/report/page/stand.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/actuator/braid.h"
#include "sinew/config/reader.h"
#include "sinew/units/constants.h"

namespace sinew::report {
namespace {

using signals::Column;

// What of the stand's file the drawing needs beside StandFile.
struct Corner {
  double at = 0, value = 0;  // [s], in the quantity's SI unit
};
struct Named {
  std::string name, of, kind;  // of a sensor, of a valve
};
struct File {
  std::string actuator, inlet, exhaust;
  int count = 1;
  double bore = 0, rod = 0, stroke = 0;  // [m]
  std::string load = "hanging", charge = "sealed";
  double mass = 0, force = 0;                // [kg], [N]
  double gravity = units::standard_gravity;  // [m/s2]
  std::vector<Corner> weights, forces, lengths;
  std::vector<actuator::Actuator> actuators;
  std::vector<Named> sensors, valves;
};

template <class Visitor>
void amount(Visitor& v, std::string_view name, std::string_view unit, double& value) {
  v.number({.name = name, .unit = unit, .optional = true}, value);
}

template <class Visitor>
void points(Visitor& v, std::string_view name, std::string_view what, std::string_view unit,
            std::vector<Corner>& list) {
  v.list({.name = name, .optional = true}, list, [&](auto& g, Corner& p) {
    g.number({.name = "at", .unit = "s"}, p.at);
    g.number({.name = what, .unit = unit}, p.value);
  });
}

void read_element(config::Reader& v, File& f) {
  v.text({.name = "actuator", .optional = true}, f.actuator);
  v.text({.name = "inlet", .optional = true}, f.inlet);
  v.text({.name = "exhaust", .optional = true}, f.exhaust);
  v.integer({.name = "count", .min = 1, .max = 16, .optional = true}, f.count);
  v.group({.name = "cylinder", .optional = true}, [&](auto& g) {
    amount(g, "bore", "m", f.bore);
    amount(g, "rod_diameter", "m", f.rod);
    amount(g, "stroke", "m", f.stroke);
  });
}

void read_load(config::Reader& v, File& f) {
  v.text({.name = "mode", .optional = true}, f.load);
  amount(v, "mass", "kg", f.mass);
  amount(v, "force", "N", f.force);
  amount(v, "gravity", "m/s2", f.gravity);
  points(v, "weights", "mass", "kg", f.weights);
  points(v, "forces", "force", "N", f.forces);
  points(v, "lengths", "length", "m", f.lengths);
}

File read_file(const config::Node& root, double atmosphere) {
  File f;
  config::Reader v(root, {.atmosphere = atmosphere});
  v.group({.name = "element", .optional = true}, [&](auto& g) { read_element(g, f); });
  v.group({.name = "load", .optional = true}, [&](auto& g) { read_load(g, f); });
  v.group({.name = "charge", .optional = true},
          [&](auto& g) { g.text({.name = "mode", .optional = true}, f.charge); });
  actuator::fields(v, f.actuators);
  v.each({.name = "sensor", .optional = true}, f.sensors,
         [](auto& g, Named& s) { g.text({.name = "of", .optional = true}, s.of); });
  v.each({.name = "valve", .optional = true}, f.valves,
         [](auto& g, Named& s) { g.text({.name = "kind", .optional = true}, s.kind); });
  v.finish_part();
  return f;
}

// Straight between points, the later of two at one instant; held outside.
double at(const std::vector<Corner>& points, double t) {
  const auto next = std::ranges::upper_bound(points, t, {}, &Corner::at);
  if (next == points.begin()) return next->value;
  if (next == points.end()) return points.back().value;
  const Corner& before = *(next - 1);
  return before.value + (next->value - before.value) * (t - before.at) / (next->at - before.at);
}

// From an instant on; before the first the first.
double step_at(const std::vector<Corner>& points, double t) {
  const auto next = std::ranges::upper_bound(points, t, {}, &Corner::at);
  return next == points.begin() ? next->value : (next - 1)->value;
}

class StandMaker {
 public:
  StandMaker(const Channels& channels, File file, const analysis::StandFile& stand,
             signals::Table& drawn)
      : channels_(channels), file_(std::move(file)), stand_(stand), drawn_(drawn) {}

  Stand make() {
    out_.element = stand_.element;
    out_.length = first("/true/stand/length", "length");
    if (out_.empty()) return std::move(out_);
    out_.drawn_from = out_.length.topic.starts_with("/true/") ? "true values" : "measured values";
    length_ = channels_.find(out_.length);
    add_element();
    add_air();
    add_load();
    return std::move(out_);
  }

 private:
  // The true one, else what the sensor of that quantity reads.
  Channel first(const std::string& topic, const std::string& of) const {
    if (channels_.has({topic})) return {topic};
    for (const Named& s : file_.sensors)
      if (s.of == of && channels_.has({"/sensor/" + s.name + "/value"}))
        return {"/sensor/" + s.name + "/value"};
    return {};
  }
  Channel draw(const std::string& name, const std::string& unit, const Samples& clock,
               Column values) {
    drawn_.series.push_back(
        {{"/draw/" + name, "", {{"value", unit}}}, *clock.time_ns, {std::move(values)}});
    return {"/draw/" + name};
  }

  void add_element() {
    const auto [least, most] = std::ranges::minmax(*length_.values);
    out_.least = least, out_.most = most;
    out_.count = file_.count;
    if (file_.bore > 0) {
      out_.bore = file_.bore, out_.rod = file_.rod, out_.stroke = file_.stroke;
      out_.longest = file_.stroke;
      return;
    }
    for (const actuator::Actuator& a : file_.actuators)
      if (a.name == file_.actuator) add_braid(a);
  }

  void add_braid(const actuator::Actuator& a) {
    out_.turns = a.braid.turns;
    out_.shortest = actuator::shortest_length(a.braid);
    out_.longest = a.long_end.length;
    Column diameter(length_.values->file());
    for (const double l : *length_.values) diameter.push_back(actuator::diameter(a.braid, l));
    out_.diameter = draw("stand/diameter", "m", length_, std::move(diameter));
  }

  void add_air() {
    using enum Stand::Air;
    out_.air = file_.charge == "regulated" ? regulated : file_.charge == "valves" ? valves : sealed;
    for (const Named& v : file_.valves)
      if (out_.air == valves && v.name == file_.inlet && v.kind == "3-way") out_.air = three_way;
    const std::string valve = "/valve/" + stand_.element + "/";
    out_.inlet = channels_.first_of({valve + "inlet/open"});
    out_.exhaust = channels_.first_of({valve + "exhaust/open"});
    const Channel pressure = first("/true/muscle/" + stand_.element + "/pressure", "pressure");
    out_.pressure = absolute(pressure);
  }

  // A transducer reads gauge.
  Channel absolute(const Channel& pressure) {
    if (!pressure.topic.starts_with("/sensor/")) return pressure;
    const Samples read = channels_.find(pressure);
    Column values(read.values->file());
    for (const double p : *read.values) values.push_back(p + stand_.atmosphere);
    return draw("stand/pressure", "Pa", read, std::move(values));
  }

  void add_load() {
    out_.desired = channels_.first_of({"/desired/length"});
    out_.tension = first("/true/stand/force", "force");
    if (file_.load != "hanging") {
      out_.load = out_.most > out_.least ? Stand::Load::driven : Stand::Load::clamped;
      // What a sensor reads of a clamped element is never quite one length.
      if (file_.lengths.empty()) out_.load = Stand::Load::clamped;
      return;
    }
    Column weight(length_.time_ns->file());
    for (const std::int64_t ns : *length_.time_ns) weight.push_back(pull(1e-9 * double(ns)));
    out_.heaviest = std::ranges::max(weight);
    out_.weight_step = smallest_step();
    out_.weight = draw("stand/weight", "N", length_, std::move(weight));
  }

  // What pulls down beside inertia, [36]: M g + F_ext  [N].
  double pull(double t) const {
    const double mass = file_.weights.empty() ? file_.mass : step_at(file_.weights, t);
    const double force = file_.forces.empty() ? file_.force : at(file_.forces, t);
    return mass * file_.gravity + force;
  }

  // By which the schedules change what hangs; 0 where nothing changes  [N].
  double smallest_step() const {
    double least = 0;
    const auto look = [&](const std::vector<Corner>& points, double newtons) {
      for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = newtons * std::abs(points[i].value - points[i - 1].value);
        if (step > 0 && (least == 0 || step < least)) least = step;
      }
    };
    look(file_.weights, file_.gravity);
    look(file_.forces, 1);
    return least;
  }

  const Channels& channels_;
  const File file_;
  const analysis::StandFile& stand_;
  signals::Table& drawn_;
  Samples length_;
  Stand out_;
};

}  // namespace

Stand stand(const Channels& channels, const config::Node& resolved, const analysis::StandFile& file,
            signals::Table& drawn) {
  return StandMaker(channels, read_file(resolved, file.atmosphere), file, drawn).make();
}

}  // namespace sinew::report
