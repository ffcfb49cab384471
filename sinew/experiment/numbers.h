// experiment/numbers.h - numbers of an experiment that are set again and again, in place of reading
// its file with --set again and again.
//
//   const Numbers numbers(experiment, {"joint.hip.damping"});
//   if (!numbers.set(experiment, values)) …   // read the file with these values instead
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/units/each_field.h"

namespace sinew::experiment {

class Numbers {
 public:
  // Finds the numbers of these keys in an experiment as load() returns it.
  Numbers(const Experiment& like, const std::vector<std::string>& keys);

  // Returns the unit of each key in SI, as in a field table; "" for a whole number, and for a
  // key that cannot be set (has()) because it does not exist or has another type.
  const std::vector<std::string>& units() const { return units_; }
  bool has(std::size_t key) const { return has_[key]; }
  // Returns the values in `like`, in SI; 0 for a key that cannot be set.
  const std::vector<double>& values() const { return values_; }

  // Sets the numbers to values in SI, one for each key, and the plan's gains, pulses and
  // times, which follow from them. `e` must have the same tables as `like`. Returns false if the
  // file has to be read with these values instead, because one of them is out of its bounds or the
  // element of a list, or because keys appear or vanish with it; `e` has an unspecified value then.
  // Contradictions among the values are not found here.
  bool set(Experiment& e, std::span<const double> values) const;
  // Sets them without regard to the bounds of their fields, for a search that has its own. Returns
  // false if keys appear or vanish.
  bool set_unbounded(Experiment& e, std::span<const double> values) const;

 private:
  static constexpr std::size_t absent = static_cast<std::size_t>(-1);

  void find_elements(const units::VisitedField& list, const std::vector<std::string>& keys);
  bool put(Experiment& e, std::span<const double> values, bool bounded) const;

  std::vector<bool> has_;      // for each key, and what follows
  bool has_elements_ = false;  // a key is that of an element of a list: the file has to be read
  std::vector<std::string> units_;
  std::vector<double> values_;
  std::vector<std::size_t> key_of_;  // for each visited field; `absent`: it is not set
  std::uint64_t hash_ = 0;           // hashed paths of all visited fields
};

// Returns whether two experiments have the same values, to the bit.
bool same_values(const Experiment& a, const Experiment& b);

}  // namespace sinew::experiment
