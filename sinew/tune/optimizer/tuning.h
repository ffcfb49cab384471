// tune/optimizer/tuning.h - definition of a tuning, as a file.
//
//   format     = "sinew.tuning/1"
//   title      = "A faster walk"
//   experiment = "../experiments/walk-test-1.toml"
//   tune       = ["joint.hip.angle_gain=0.02:0.1 %/count log", "phase.swing.duration=0.4:1.5 s"]
//   maximize   = ["trolley.mean_speed_m_per_s [in/s]"]
//   where      = ["passiveness >= 90 %"]
//   generations = 40
//
// Each candidate is run in every circumstance: in each [[case]], with the noise of each of `seeds`,
// and at each of `draws` points of `spread`. The points are the same for all candidates.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/tune/figure.h"
#include "sinew/tune/optimizer/module/methods.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {

// Evaluation of a candidate's runs: its goals, and its distance from the limits. Pure.
//
// A candidate has a run in each circumstance: each case, seed and draw of uncertain values. A run
// violates a limit by (value - limit) / |limit|, or by the difference itself if the limit is 0; a
// run without figures violates every limit by `without_figures`.
//
//   holds      the share of the runs' weights for which all limits hold
//   violation  the mean of the runs' violations, the least first, over the share `hold`; it is 0 if
//              all limits hold for that share: the candidate is then feasible

// A figure that is minimised or maximised.
struct Goal {
  Figure figure;
  bool maximize = false;
};

// A limit for a figure.
struct Limit {
  Figure figure;
  Condition::Is is = Condition::Is::at_most;
  double limit = 0;  // in the figure's unit
  std::string text;  // as written
  double si = 0;     // `limit` in SI
};

// Goals and limits that order the candidates.
struct Goals {
  // mean: weighted mean of the runs; worst: the worst run.
  enum class Over { mean, worst };

  std::vector<Goal> goals;    // at least one
  std::vector<Limit> limits;  // held by the runs
  Over over = Over::mean;     // combines the runs of a candidate
  double hold = 1;  // share of the runs for which all limits must hold, above 0, at most 1
};

// The figures of one run, in the units of the goals and limits.
struct Figures {
  double weight = 1;
  bool ok = false;  // has all figures
  std::vector<double> goals, limits;
};

inline constexpr double without_figures = 1000;  // a violation larger than that of any figure

// The evaluation of a candidate's runs.
struct CandidateEvaluation {
  std::vector<double> goals;   // over the runs with figures; NaN without such runs
  std::vector<double> limits;  // the worst of those runs
  double violation = 0;
  double holds = 1;

  // Returns whether all limits hold.
  bool feasible() const { return violation == 0; }
};

// Evaluates at least one run. Does not throw.
CandidateEvaluation evaluate(const Goals& goals, std::span<const Figures> runs);

// Returns the costs that an optimiser minimises, one per goal. An infeasible candidate costs more
// than any feasible one, increasing with its violation.
std::vector<double> costs(const Goals& goals, const CandidateEvaluation& evaluation);

// Returns whether `a` is as good as `b` in every goal and better in one, or feasible while `b` is
// not, or less infeasible than `b`.
bool dominates(const Goals& goals, const CandidateEvaluation& a, const CandidateEvaluation& b);

// Returns the indices of those that no other dominates, the best in the first goal first; of equal
// ones the first. Empty if none is feasible.
std::vector<std::size_t> front(const Goals& goals, std::span<const CandidateEvaluation> evaluation);

// An optimiser that returns a generation of points and is given the cost of each.
//
//   cmaes  CMA-ES (Hansen 2006) for one goal: a normal distribution that moves to low costs
//   nsga2  NSGA-II (Deb et al. 2002) for several: a population that spreads along their front
//
// Both are implemented by pagmo, in a separate module that only this class opens. The same seed and
// the same costs give the same points, so a study continues from its rows: no other state of a
// method is stored.
class OptimizerMethod {
 public:
  // Throws std::runtime_error if the program was built without pagmo.
  explicit OptimizerMethod(const MethodParameters& parameters);

  // Sets the first generation's points, one after the other, and their costs. Throws
  // std::runtime_error, as do the others.
  void begin(const std::vector<double>& points, const std::vector<double>& costs);

  // Returns the next generation's points, with coordinates in [0, 1]; empty if the method has
  // converged.
  std::vector<double> ask();

  // Sets the costs of the points that ask() returned last.
  void tell(const std::vector<double>& costs);

 private:
  void check(bool success) const;

  MethodParameters parameters_;
  const SinewMethods* methods_;
  std::unique_ptr<void, void (*)(void*)> method_;
};

// The largest share of a range: the next number below 1.
inline constexpr double below_one = 1 - 0x1p-53;

// The keys of the file.
struct TuningFile {
  std::string title, reproduces, experiment;
  std::vector<std::string> set, tune, maximize, minimize, where, report, spread;
  std::vector<Case> cases;
  // Method of search; automatic: by the number of goals.
  enum class Method { automatic, cmaes, nsga2 } method = Method::automatic;
  Goals::Over over = Goals::Over::mean;
  double hold = 1, step = 0.3;
  int population = 0;  // 0: by the number of ranges
  int generations = 50, tuner_seed = 1;
  int seeds = 0, draws = 0, spread_seed = 1;
  bool allow_unreachable = false;
  config::Origins origins = {};  // origins of its keys, for messages
  Places places = {};            // places of its values, for messages
};

// The file, parsed.
struct Tuning {
  std::string file, title;
  // The runs of all generations. Its sample has the tuned ranges, then the drawn ones; its shares
  // are set for each generation.
  Sweep runs;
  std::size_t tuned = 0;           // number of tuned ranges
  std::vector<double> drawn = {};  // shares of the drawn ranges, point by point
  std::size_t draws = 1;
  Goals goals;
  MethodParameters method;
  std::size_t generations = 0;
  std::vector<double> start = {};         // shares of the experiment's values; the first candidate
  double atmosphere = units::atmosphere;  // for gauge pressures of the experiment [Pa]

  // Return the number of runs of a candidate, and of a generation.
  std::size_t runs_of_candidate() const { return points(runs) / (generations * method.population); }
  std::size_t runs_of_generation() const { return points(runs) / generations; }
};

// Throws config::Error with all faults of the file.
TuningFile load_tuning_file(const std::string& path);

// Returns the parsed file. Throws config::Error for invalid texts, and for a faulty experiment.
// Runs nothing.
Tuning tuning_of(const std::string& path, const TuningFile& file);

// Loads and parses a file, with additional values for every run, and with another number of
// generations if it is above 0.
Tuning load_tuning(const std::string& path, const std::vector<std::string>& sets = {},
                   int generations = 0);

}  // namespace sinew::tune
