#include "fmu/machine/machine.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "fmu/slave/saved.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/quantity.h"

namespace sinew::fmu {

namespace {

using Causality = Variable::Causality;
using Given = run::Column::Given;

constexpr const char* file_name = "machine.toml";

// Number of a key of the experiment in SI, its unit and its source.
struct Number {
  double value = 0;
  std::string unit, source;
};

Number number_of_key(const experiment::Experiment& e, const config::Node& in_si,
                     const std::string& key) {
  const config::Origin* origin = config::find_origin(e.origins, key);
  const config::Node* node = origin ? config::value_at(in_si, key) : nullptr;
  if (node && node->is_value_table()) node = node->find("value");
  if (!node || origin->unit.empty()) {
    std::vector<std::string_view> keys;
    for (const config::Origin& o : e.origins)
      if (!o.unit.empty()) keys.push_back(o.path);
    const std::string near = config::closest_in_quotes(key, keys);
    throw std::invalid_argument("parameter: found \"" + key +
                                "\"; expected the key of a number of the experiment" +
                                (near.empty() ? "" : "; try " + near));
  }
  Number out{.unit = origin->unit, .source = origin->source};
  if (node->kind == config::Node::Kind::text)  // "0.23 N m s/rad"
    out.value = units::split_number(node->text).number;
  else if (node->is_number())
    out.value =
        node->kind == config::Node::Kind::integer ? static_cast<double>(node->integer) : node->real;
  else
    throw std::invalid_argument("parameter: found \"" + key +
                                "\", which is a list; expected a single number");
  return out;
}

}  // namespace

Description Machine::describe(const experiment::Experiment& experiment,
                              const ExposedVariables& shown) {
  Description out;
  out.add("kind", std::string(kind));
  for (const std::string& key : shown.inputs) out.add("input", key);
  for (const std::string& channel : shown.outputs) out.add("output", channel);
  for (const std::string& key : shown.parameters) out.add("parameter", key);
  out.attach(file_name, experiment::resolved(experiment, SINEW_VERSION));
  return out;
}

Machine::Machine(const Description& description)
    : tree_(config::parse_text(description.file(file_name), file_name)) {
  simulation_ = std::make_unique<run::Simulation>(run::buildable(tree_, file_name));
  place_variables(description);
}

void Machine::place_variables(const Description& description) {
  const experiment::Experiment& e = simulation_->experiment();
  for (const std::string& key : description.all("input")) {
    const std::size_t number = simulation_->find_setting(key);
    const gait::Setting& setting = simulation_->settings()[number];
    const std::size_t place =
        sheet_.add({.name = structured(key),
                    .causality = Causality::input,
                    .unit = std::string(setting.unit),
                    .start = simulation_->value_of(number),
                    .min = 0,
                    .max = gait::Setting::most,
                    .doc = "in the plan's place, once it is another than at the start",
                    .discrete = true});
    inputs_.push_back({place, number, key, {}, sheet_.value(place)});
  }

  std::vector<std::string> outputs = description.all("output");
  if (outputs.empty())
    for (const run::Simulation::Channel& c : simulation_->channels())
      if (c.given != Given::never) outputs.push_back(c.name);
  first_output_ = sheet_.variables().size();
  for (const std::string& name : outputs) place_output(name);
  read_.resize(channels_.size());

  const config::Node in_si = experiment::values_in_si({"experiment", experiment::without_files(e)});
  for (const std::string& key : description.all("parameter")) {
    const Number n = number_of_key(e, in_si, key);
    const std::size_t place =
        sheet_.add({.name = structured(key), .unit = n.unit, .start = n.value, .doc = n.source});
    parameters_.push_back({place, 0, key, n.unit, n.value});
  }
}

// Many solvers stop at NaN, so a channel without a value is 0; x and y share a flag.
void Machine::place_output(const std::string& name) {
  const std::size_t number = simulation_->find(name);
  const run::Simulation::Channel& channel = simulation_->channels()[number];
  if (channel.given == Given::never)
    throw std::invalid_argument("output: found \"" + name +
                                "\", which has no value in this experiment: no phase has a foot "
                                "path; expected a channel that has one");
  const bool at_times = channel.given == Given::at_times;
  const std::string flag = structured(name.substr(0, name.rfind('.'))) + ".valid";
  sheet_.add({.name = structured(name),
              .causality = Causality::output,
              .unit = channel.unit,
              .doc = "channel " + name + (at_times ? "; 0 while " + flag + " is false" : "")});
  channels_.push_back(number);
  shows_.push_back(at_times ? Shows::value_or_zero : Shows::value);
  if (!at_times ||
      std::ranges::any_of(sheet_.variables(), [&](const Variable& v) { return v.name == flag; }))
    return;
  sheet_.add({.name = flag,
              .type = Variable::Type::boolean,
              .causality = Causality::output,
              .doc = "true while the channel has a value"});
  channels_.push_back(number);
  shows_.push_back(Shows::validity);
}

// Returns the experiment with the parameters that were set.
experiment::Experiment Machine::experiment() const {
  config::Node tree = tree_;
  for (const ExposedVariable& p : parameters_)
    if (sheet_.value(p.place) != p.last_value)
      config::apply_set(
          tree, p.key + "=" + text_of(sheet_.value(p.place)) + (p.unit == "1" ? "" : " " + p.unit));
  return run::buildable(tree, file_name);
}

void Machine::begin() {
  simulation_ = std::make_unique<run::Simulation>(experiment());
  fresh_ = false;
}

double Machine::output(std::size_t place) const {
  if (!fresh_) {
    simulation_->read(channels_, read_);
    fresh_ = true;
  }
  const double value = read_[place - first_output_];
  const Shows shows = shows_[place - first_output_];
  if (shows == Shows::value) return value;
  const bool valid = !std::isnan(value);
  return shows == Shows::validity ? (valid ? 1.0 : 0.0) : (valid ? value : 0.0);
}

const char* Machine::advance(double end, double) noexcept {
  try {
    for (ExposedVariable& input : inputs_)
      if (const double value = sheet_.value(input.place); value != input.last_value) {
        simulation_->change(input.number, value);
        input.last_value = value;
      }
  } catch (const std::exception&) {  // the range was checked when the value was set
    return "a setting was refused";
  }
  // A communication point that differs from a tick only by rounding is at that tick.
  constexpr double slack = 1e-3;  // [ticks]
  const double ticks = end / signals::tick_seconds;
  const auto last = static_cast<double>(simulation_->last());
  simulation_->advance_to(static_cast<signals::Tick>(std::min(std::floor(ticks + slack), last)));
  fresh_ = false;
  if (!simulation_->ended() || simulation_->tick() >= simulation_->last()) return nullptr;
  cause_ = simulation_->cause();
  return cause_.empty() ? nullptr : cause_.c_str();
}

std::vector<std::byte> Machine::save() const {
  std::vector<std::byte> out;
  for (const ExposedVariable& input : inputs_) append(out, input.last_value);
  const std::vector<std::byte> own = simulation_->save();
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

void Machine::restore(std::span<const std::byte> saved) {
  for (ExposedVariable& input : inputs_) input.last_value = take<double>(saved);
  simulation_->restore(saved);
  fresh_ = false;
}

double Machine::duration() const noexcept {
  return static_cast<double>(simulation_->last()) * signals::tick_seconds;
}

}  // namespace sinew::fmu
