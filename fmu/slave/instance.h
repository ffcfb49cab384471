// fmu/slave/instance.h - one instance of an FMU's model, whatever version of the interface speaks
// to it: phases, checks of every value, time, saved states.
//
// `Models` is a std::variant of what the binary knows. A model has
//
//   static constexpr std::string_view kind        the word in resources/model.txt
//   explicit Model(const Description&)            throws
//   Sheet& sheet()                                variables, and values that are set
//   void begin(double start_time)                 from parameters and inputs as they are; throws
//   double output(std::size_t place)              of a variable that is an output, once it has
//   begun const char* advance(double end, double step) noexcept     to `end` seconds after the
//   start;
//                                                 what went wrong, nullptr: nothing
//   bool ended() const noexcept                   is there no more to advance?
//   std::vector<std::byte> save(), void restore(std::span<const std::byte>)
//
// Every function but step() throws std::exception with a sentence for the importer's log; the C
// functions around it catch. Nothing is shared between instances.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "fmu/slave/description.h"
#include "fmu/slave/saved.h"
#include "fmu/slave/sheet.h"
#include "sinew/units/hash.h"

namespace sinew::fmu {

// Returns the model that the description names. Throws std::runtime_error where there is none.
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
  enum class Phase { made, initializing, stepping, terminated, failed };
  enum class Step { done, ended, failed };

  Instance(const Description& description, const std::string& token)
      : description_(description), model_(make_model<Models>(description)) {
    if (token != description.hash())
      throw std::runtime_error("found the token " + token + "; expected " + description.hash() +
                               ", which modelDescription.xml of this FMU has");
    sheet().to_start();
  }

  Phase phase() const { return phase_; }
  double time() const { return time_; }

  // --- phases ---

  void set_start(double time) {
    require(phase_ == Phase::made, "the start time is set", "before initialization");
    if (!std::isfinite(time)) throw std::runtime_error("start time: found no finite number");
    start_ = time_ = time;
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
    begun_ = false;
  }

  // --- values, by place ---

  double get(std::size_t place, Variable::Type type) {
    const Variable& v = variable(place, type);
    if (v.causality == Variable::Causality::time) return time_;
    if (v.causality != Variable::Causality::output) return sheet().value(place);
    require(phase_ != Phase::made, v.name + " is read", "in initialization or later");
    if (phase_ == Phase::initializing && !begun_) begin();
    return std::visit([&](auto& m) { return m.output(place); }, model_);
  }

  void set(std::size_t place, Variable::Type type, double value) {
    const Variable& v = variable(place, type);
    using C = Variable::Causality;
    if (v.causality == C::output || v.causality == C::time)
      throw std::runtime_error(v.name + ": is no input and no parameter, and cannot be set");
    const bool early = phase_ == Phase::made || phase_ == Phase::initializing;
    if (v.causality == C::parameter)
      require(early, v.name + ", a parameter, is set", "before or in initialization");
    else
      require(early || phase_ == Phase::stepping, v.name + " is set", "before the run's end");
    if (!(value >= v.min && value <= v.max) || !std::isfinite(value))
      throw std::runtime_error(v.name + ": found " + text_of(value) + "; expected " +
                               text_of(v.min) + " to " + text_of(v.max) +
                               (v.unit.empty() || v.unit == "1" ? "" : " " + v.unit));
    if (value != sheet().value(place)) begun_ = begun_ && phase_ != Phase::initializing;
    sheet().set(place, value);
  }

  // Returns the place's variable. Throws where there is none of that type.
  const Variable& variable(std::size_t place, Variable::Type type) const {
    const std::vector<Variable>& all = sheet().variables();
    if (place >= all.size())
      throw std::runtime_error("value reference: found " + std::to_string(place) +
                               "; expected less than " + std::to_string(all.size()));
    if (all[place].type != type)
      throw std::runtime_error(all[place].name + ": is " + word(all[place].type) +
                               "; asked for as " + word(type));
    return all[place];
  }
  // Returns what an output follows at once.
  const std::vector<int>& follows(std::size_t place) const {
    return sheet().variables().at(place).follows;
  }

  // --- time ---

  // Advances from `from`, where it stands, by `step` [s]. Throws, and changes nothing, for times
  // that do not go on from each other; what the physics does is answered.
  Step step(double from, double length) {
    require(phase_ == Phase::stepping, "a step is made", "after initialization");
    const double slack = 1e-9 * (1.0 + std::abs(time_));
    if (!(std::abs(from - time_) <= slack))
      throw std::runtime_error("communication point: found " + text_of(from) + " s; expected " +
                               text_of(time_) + " s, where the last step has ended");
    if (!(length > 0) || !std::isfinite(length))
      throw std::runtime_error("step: found " + text_of(length) + " s; expected more than 0");
    if (ended()) return Step::ended;
    const double end = from + length;
    trouble_ = std::visit([&](auto& m) { return m.advance(end - start_, length); }, model_);
    if (trouble_) {
      phase_ = Phase::failed;
      return Step::failed;
    }
    time_ = end;
    return ended() ? Step::ended : Step::done;
  }
  // Returns why the last step failed.
  const char* trouble() const { return trouble_ ? trouble_ : ""; }
  bool ended() const {
    return begun_ && std::visit([](const auto& m) { return m.ended(); }, model_);
  }

  // --- saved states: parameters, inputs, time and the model's own ---

  std::vector<std::byte> save() {
    std::vector<std::byte> out;
    append(out, Header{stamp(), phase_, begun_, start_, time_});
    for (const double value : sheet().values()) append(out, value);
    if (begun_) {
      const std::vector<std::byte> own = std::visit([](auto& m) { return m.save(); }, model_);
      out.insert(out.end(), own.begin(), own.end());
    }
    append(out, units::hash(out));
    return out;
  }

  // Throws, and changes nothing, for what is no state of this FMU and version.
  void restore(std::span<const std::byte> saved) {
    if (saved.size() < sizeof(Header) + sizeof(std::uint64_t))
      throw std::runtime_error("a saved state is cut off");
    std::span<const std::byte> end = saved.last(sizeof(std::uint64_t));
    std::span<const std::byte> from = saved.first(saved.size() - sizeof(std::uint64_t));
    if (take<std::uint64_t>(end) != units::hash(from))
      throw std::runtime_error("a saved state is cut off or spoilt");
    const Header header = take<Header>(from);
    if (header.stamp != stamp())
      throw std::runtime_error("a saved state is of another FMU or another version of it");
    Models fresh = make_model<Models>(description_);
    Sheet& values = std::visit([](auto& m) -> Sheet& { return m.sheet(); }, fresh);
    for (double& value : values.values()) value = take<double>(from);
    if (header.begun)
      std::visit(
          [&](auto& m) {
            m.begin(header.start);
            m.restore(from);
          },
          fresh);
    model_ = std::move(fresh);
    phase_ = header.phase;
    begun_ = header.begun;
    start_ = header.start;
    time_ = header.time;
  }

 private:
  struct Header {
    std::uint64_t stamp = 0;
    Phase phase = Phase::made;
    bool begun = false;
    double start = 0, time = 0;
  };

  static std::string word(Variable::Type type) {
    if (type == Variable::Type::boolean) return "a Boolean";
    return type == Variable::Type::integer ? "a whole number" : "a real number";
  }
  static void require(bool right, const std::string& what, const char* when) {
    if (!right) throw std::runtime_error(what + " at the wrong time; expected " + when);
  }

  void begin() {
    std::visit([&](auto& m) { m.begin(start_); }, model_);
    begun_ = true;
  }
  std::uint64_t stamp() const {
    return units::hash(SINEW_VERSION, units::hash(description_.text()));
  }

  Sheet& sheet() {
    return std::visit([](auto& m) -> Sheet& { return m.sheet(); }, model_);
  }
  const Sheet& sheet() const {
    return std::visit([](const auto& m) -> const Sheet& { return m.sheet(); }, model_);
  }

  Description description_;
  Models model_;
  Phase phase_ = Phase::made;
  bool begun_ = false;
  double start_ = 0, time_ = 0;  // [s]
  const char* trouble_ = nullptr;
};

}  // namespace sinew::fmu
