// identify/pair/pair_problem.h - one law on all recordings of a pair: its parameters, and what it
// leaves of the measured effort.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/fit/wish.h"
#include "sinew/identify/pair/pair_law.h"
#include "sinew/identify/pair/pair_rows.h"

namespace sinew::identify {

// Parameters are physics, then the rigs' sensors, then each recording's bias and start.
class PairProblem {
 public:
  // Both must outlive the problem. The first `fitted` recordings are those that are fitted, 0: all;
  // they alone decide whether a name tells whose parameter it is.
  PairProblem(const PairLaw& law, std::span<const PairRecord> records, std::size_t fitted = 0);

  // Returns the parameters with their ranges; they start from a line through effort over position.
  const std::vector<Parameter>& parameters() const { return parameters_; }

  // Returns several starts: dry friction that bends much or little before it slips, forgets soon or
  // late.
  std::vector<std::vector<double>> starts() const;

  // Writes predicted less measured effort at the rows of each recording, one after the other.
  void residuals(std::span<const double> p, std::span<const PairRows> rows,
                 std::vector<double>& out);

  // Returns the best of the starts, or of one.
  Solution solve(std::span<const PairRows> rows, std::span<const std::vector<double>> starts,
                 const Wishes& wishes, bool correlated);

  // Returns the best of one start with the i-th parameter at that value.
  Solution solve_with(std::span<const PairRows> rows, const std::vector<double>& start,
                      const Wishes& wishes, std::size_t i, double value);

  // Returns the parameters of which `known` has those of its names, and the others are fitted.
  std::vector<double> settled(std::span<const PairRows> rows, const Solution& known);

  // Returns what the parameters mean.
  PairValues values(std::span<const double> p) const;
  PairSensors sensors(std::span<const double> p, std::size_t record) const;

 private:
  struct Series {
    std::vector<double> pressure, effort;
    std::vector<double> key;  // the parameters that `effort`, before bias and gain, was made with
  };

  void add_physics(double stiffness);
  void add_sensors(double stiffness, std::size_t fitted);
  bool scaled_by_start(std::size_t i) const;
  void simulate(std::span<const double> p, std::size_t record);

  const PairLaw& law_;
  std::span<const PairRecord> records_;
  std::vector<Parameter> parameters_;
  std::vector<double PairValues::*> physics_;  // of the first parameters
  std::vector<std::string> rigs_;
  std::vector<std::size_t> delay_, gain_;  // of each rig; gain 0: there is none
  std::vector<std::size_t> bias_, start_;  // of each recording; start 0: there is none
  std::vector<std::size_t> rig_;           // of each recording
  std::vector<Series> series_;
  double range_ = 0, effort_ = 0, duration_ = 0;  // of position, effort and time
};

}  // namespace sinew::identify
