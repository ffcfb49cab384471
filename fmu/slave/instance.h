// fmu/slave/instance.h - instance of an FMU's model, independent of the version of the interface:
// phases, checks of all values, time, saved states.
//
// `Models` is a std::variant of the models in the binary. A model has
//
//   kind          its name in resources/model.txt
//   Model(d)      construction from a Description; throws
//   sheet()       variables and their values
//   begin()       start with the present parameters and inputs; throws
//   output(k)     value of the output at index k, after begin(); may throw
//   refusal(h)      reason why a step of h seconds is refused; empty: none. Changes nothing
//   advance(end, h)   advances to `end` seconds after the start. Returns the failure, or nullptr
//   last()        end of the model in seconds after the start; infinite: no end
//   save(), restore(bytes)   its own state, after begin()
//
// Functions throw std::exception with a sentence for the importer's log, which the C functions
// catch; step() returns a failure of the model instead. Instances share no data.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "fmu/slave/description.h"
#include "fmu/slave/discarded.h"
#include "fmu/slave/saved.h"
#include "fmu/slave/sheet.h"
#include "sinew/units/hash.h"

namespace sinew::fmu {

// Returns the model named in the description. Throws std::runtime_error if it is unknown.
template <class Models, std::size_t K = 0>
Models make_model(const Description& description) {
  if constexpr (K == std::variant_size_v<Models>) {
    throw std::runtime_error("resources/model.txt: kind: found " + description.at("kind") +
                             "; expected a kind of this binary");
  } else {
    using Model = std::variant_alternative_t<K, Models>;
    if (description.at("kind") == Model::kind) return Models(std::in_place_index<K>, description);
    return make_model<Models, K + 1>(description);
  }
}

template <class Models>
class Instance {
 public:
  // Phase of an instance.
  enum class Phase : std::uint32_t { made, initializing, stepping, terminated, failed };

  // Result of a step: done; done up to the end of the model, in this step or before; failed.
  enum class Step { done, ended, failed };

  // Makes the model; `version` is the library's, which saved states must match. Throws if the token
  // differs from the description's hash.
  Instance(const Description& description, const std::string& token, const char* version)
      : description_(description),
        stamp_(units::hash(layout, units::hash(version, units::hash(description_.text())))),
        model_(make_model<Models>(description_)) {
    if (token != description_.hash())
      throw std::runtime_error("found the token " + token + "; expected " + description_.hash() +
                               ", which modelDescription.xml of this FMU has");
    sheet().to_start();
  }

  // Return the phase, and the simulated time at the end of the last step [s].
  Phase phase() const { return phase_; }
  double time() const { return time_; }

  // --- phases ---

  // Enter the phases, in their order. Each throws if it is called in the wrong phase; reset starts
  // again with the description's values.
  void set_start(double time, std::optional<double> stop) {
    require(phase_ == Phase::made, "the start time is set", "before initialization");
    if (!std::isfinite(time)) throw std::runtime_error("start time: found no finite number");
    if (stop && !(std::isfinite(*stop) && *stop >= time))
      throw std::runtime_error("stop time: found " + text_of(*stop) + "; expected at least " +
                               text_of(time) + ", the start time");
    start_ = time_ = time;
    stop_ = stop.value_or(no_stop);
  }
  void enter_initialization() {
    require(phase_ == Phase::made, "initialization is entered",
            "once, after instantiation or reset");
    phase_ = Phase::initializing;
    begun_ = false;
  }
  void exit_initialization() {
    require(phase_ == Phase::initializing, "initialization is left", "after it was entered");
    begin();
    phase_ = Phase::stepping;
  }
  void terminate() {
    require(phase_ == Phase::stepping, "a run is terminated", "after initialization");
    phase_ = Phase::terminated;
  }
  void reset() {
    model_ = make_model<Models>(description_);
    sheet().to_start();
    phase_ = Phase::made;
    start_ = time_ = 0;
    stop_ = no_stop;
    begun_ = false;
  }

  // --- values, by index ---

  // Returns a value. Throws for an unknown index or a wrong type, and for an output before
  // initialization.
  double get(std::size_t place, Variable::Type type) {
    const Variable& v = variable(place, type);
    if (v.causality == Variable::Causality::time) return time_;
    if (v.causality != Variable::Causality::output) return sheet().value(place);
    require(phase_ != Phase::made, "an output is read", "in initialization or later");
    if (phase_ == Phase::initializing && !begun_) begin();
    return std::visit([&](auto& m) { return m.output(place); }, model_);
  }

  // Sets a parameter or an input. Throws for other variables and in the wrong phase; throws
  // Discarded for a value out of range.
  void set(std::size_t place, Variable::Type type, double value) {
    const Variable& v = variable(place, type);
    using C = Variable::Causality;
    if (v.causality == C::output || v.causality == C::time)
      throw std::runtime_error(v.name + ": is no input and no parameter, and cannot be set");
    const bool early = phase_ == Phase::made || phase_ == Phase::initializing;
    if (v.causality == C::parameter)
      require(early, "a parameter is set", "before or in initialization");
    else
      require(early || phase_ == Phase::stepping, "an input is set", "before the run's end");
    if (!(value >= v.min && value <= v.max) || !std::isfinite(value))
      throw Discarded(v.name + ": found " + text_of(value) + "; expected " + text_of(v.min) +
                      " to " + text_of(v.max) +
                      (v.unit.empty() || v.unit == "1" ? "" : " " + v.unit));
    if (value != sheet().value(place)) begun_ = begun_ && phase_ != Phase::initializing;
    sheet().set(place, value);
  }

  // Returns the variable at an index. Throws if the index is too large or the type differs.
  const Variable& variable(std::size_t place, Variable::Type type) const {
    const Variable& v = variable(place);
    if (v.type != type)
      throw std::runtime_error(v.name + ": is " + word(v.type) + "; requested as " + word(type));
    return v;
  }
  const Variable& variable(std::size_t place) const {
    const std::vector<Variable>& all = sheet().variables();
    if (place < all.size()) return all[place];
    throw std::runtime_error("value reference: found " + std::to_string(place) +
                             "; expected less than " + std::to_string(all.size()));
  }

  // --- time ---

  // Advances from `from`, the present time, by `length` [s]. Throws, and changes nothing, for
  // times that are not consecutive and for steps that the model refuses; a failure during the step
  // is returned.
  Step step(double from, double length) {
    require(phase_ == Phase::stepping, "a step is made", "after initialization");
    const double slack = 1e-9 * (1.0 + std::abs(time_));
    if (!(std::abs(from - time_) <= slack))
      throw std::runtime_error("communication point: found " + text_of(from) + " s; expected " +
                               text_of(time_) + " s, where the last step has ended");
    if (!(length > 0 && length <= longest_step))
      throw Discarded("step: found " + text_of(length) + " s; expected more than 0, at most " +
                      text_of(longest_step));
    if (from + length > stop_ + slack)
      throw std::runtime_error("step: found its end at " + text_of(from + length) +
                               " s; expected at most " + text_of(stop_) +
                               " s, the stop time that was set before initialization");
    if (ended()) return Step::ended;
    if (const std::string why = std::visit([&](auto& m) { return m.refusal(length); }, model_);
        !why.empty())
      throw Discarded(why);

    const double end = from + length;
    trouble_ = std::visit([&](auto& m) { return m.advance(end - start_, length); }, model_);
    if (trouble_) {
      phase_ = Phase::failed;
      return Step::failed;
    }
    const double last = start_ + std::visit([](const auto& m) { return m.last(); }, model_);
    const bool whole = last >= end - slack;
    time_ = whole ? end : last;
    ended_ = last <= end + slack;
    return whole ? Step::done : Step::ended;
  }
  // Returns the reason why the last step failed.
  const char* trouble() const { return trouble_ ? trouble_ : ""; }
  // Returns whether a step has reached the end of the model.
  bool ended() const { return begun_ && ended_; }

  // --- saved states: parameters, inputs, time and the model's own state ---

  // Returns the whole state as bytes, followed by a hash.
  std::vector<std::byte> save() {
    std::vector<std::byte> out;
    append(out,
           Header{stamp_, phase_, begun_ ? 1u : 0u, ended_ ? 1u : 0u, 0, start_, time_, stop_});
    for (const double value : sheet().values()) append(out, value);
    if (begun_) {
      const std::vector<std::byte> own = std::visit([](auto& m) { return m.save(); }, model_);
      out.insert(out.end(), own.begin(), own.end());
    }
    append(out, units::hash(out));
    return out;
  }

  // Restores a state. Throws, and changes nothing, if it is not a state of this FMU and version.
  void restore(std::span<const std::byte> saved) {
    if (saved.size() < sizeof(Header) + sizeof(std::uint64_t))
      throw std::runtime_error("a saved state is cut off");
    std::span<const std::byte> end = saved.last(sizeof(std::uint64_t));
    std::span<const std::byte> from = saved.first(saved.size() - sizeof(std::uint64_t));
    if (take<std::uint64_t>(end) != units::hash(from))
      throw std::runtime_error("a saved state is cut off or spoilt");
    const Header header = take<Header>(from);
    if (header.stamp != stamp_)
      throw std::runtime_error("a saved state is of another FMU or of another version");
    std::vector<double> values(sheet().variables().size());
    for (double& value : values) value = take<double>(from);

    if (header.begun && begun_ && same_parameters(values)) {
      std::visit([&](auto& m) { m.restore(from); }, model_);
      std::ranges::copy(values, sheet().values().begin());
    } else {
      model_ = rebuilt_model(values, header.begun != 0, from);
    }
    phase_ = header.phase;
    begun_ = header.begun != 0;
    ended_ = header.ended != 0;
    start_ = header.start;
    time_ = header.time;
    stop_ = header.stop;
  }

 private:
  static constexpr double longest_step = 1e5;  // [s]
  static constexpr double no_stop = units::unbounded;
  static constexpr const char* layout = "2";  // format of saved states: changes with Header

  struct Header {  // without padding
    std::uint64_t stamp = 0;
    Phase phase = Phase::made;
    std::uint32_t begun = 0, ended = 0, none = 0;
    double start = 0, time = 0, stop = no_stop;
  };

  static std::string word(Variable::Type type) {
    if (type == Variable::Type::boolean) return "a Boolean";
    return type == Variable::Type::integer ? "a whole number" : "a real number";
  }
  static void require(bool right, const char* what, const char* when) {
    if (!right)
      throw std::runtime_error(std::string(what) + " at the wrong time; expected " + when);
  }

  void begin() {
    std::visit([](auto& m) { m.begin(); }, model_);
    begun_ = true;
    ended_ = false;
  }

  bool same_parameters(const std::vector<double>& values) const {
    const std::vector<Variable>& all = sheet().variables();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].causality == Variable::Causality::parameter && values[k] != sheet().value(k))
        return false;
    return true;
  }

  // Returns a model with these values and, if it had begun, with this state.
  Models rebuilt_model(const std::vector<double>& values, bool begun,
                       std::span<const std::byte> own) const {
    Models out = make_model<Models>(description_);
    std::visit(
        [&](auto& m) {
          std::ranges::copy(values, m.sheet().values().begin());
          if (!begun) return;
          m.begin();
          m.restore(own);
        },
        out);
    return out;
  }

  Sheet& sheet() {
    return std::visit([](auto& m) -> Sheet& { return m.sheet(); }, model_);
  }
  const Sheet& sheet() const {
    return std::visit([](const auto& m) -> const Sheet& { return m.sheet(); }, model_);
  }

  Description description_;
  std::uint64_t stamp_;  // hash of the description and the library's version
  Models model_;
  Phase phase_ = Phase::made;
  bool begun_ = false, ended_ = false;
  double start_ = 0, time_ = 0, stop_ = no_stop;  // [s]
  const char* trouble_ = nullptr;
};

}  // namespace sinew::fmu
