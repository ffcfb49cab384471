// tune/optimizer/tuning.h - what a tuner is asked for, as a file.
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
// and at each of `draws` points of `spread`, the same points for all candidates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/tune/optimizer/goals.h"
#include "sinew/tune/sweep.h"

// An optimiser that is asked for a generation of points and told what
// each of them costs.
//
//   cmaes  CMA-ES (Hansen 2006) for one goal: a normal distribution that follows where points are
//          good
//   nsga2  NSGA-II (Deb et al. 2002) for several: a population that spreads along their front
//
// Both are pagmo's, which is in a module of its own that is opened here and nowhere else. The same
// seed and the same costs give the same points, so a study goes on from its rows: nothing else of
// a method is kept.

struct SinewMethods;

namespace sinew::tune {

// CMA-ES, for one goal; NSGA-II, for several.
enum class MethodKind { cmaes, nsga2 };

// Holds what a method of search is made with.
struct MethodAsked {
  MethodKind kind = MethodKind::cmaes;
  std::size_t dimensions = 0;   // of a point, above 0
  std::size_t costs = 1;        // of a point; cmaes: 1
  std::size_t population = 16;  // at least 5; nsga2: a multiple of 4
  std::uint64_t seed = 1;
  double step = 0.3;  // cmaes: the standard deviation it begins with, a share of each range
};

// A search that is asked for points and told what they cost, generation by generation.
class OptimizerMethod {
 public:
  // Throws std::runtime_error where the program was built without pagmo.
  explicit OptimizerMethod(const MethodAsked& asked);

  // The first generation's points, one after the other, and their costs. Throws std::runtime_error,
  // as the others do.
  void begin(const std::vector<double>& points, const std::vector<double>& costs);

  // Returns the next generation's points, each in [0, 1]; none where the method has converged.
  std::vector<double> ask();

  // Tells what the points cost that were asked for last.
  void tell(const std::vector<double>& costs);

 private:
  void check(bool success) const;

  MethodAsked asked_;
  const SinewMethods* methods_;
  std::unique_ptr<void, void (*)(void*)> method_;
};

}  // namespace sinew::tune

namespace sinew::tune {

// The largest share of a range: the next number below one.
inline constexpr double below_one = 1 - 0x1p-53;

// The file's words.
struct TuningFile {
  std::string title, reproduces, experiment;
  std::vector<std::string> set, tune, maximize, minimize, where, report, spread;
  std::vector<Case> cases;
  // Which method searches; automatic: by the number of goals.
  enum class Method { automatic, cmaes, nsga2 } method = Method::automatic;
  Goals::Over over = Goals::Over::mean;
  double hold = 1, step = 0.3;
  int population = 0;  // 0: as many as suit the ranges
  int generations = 50, tuner_seed = 1;
  int seeds = 0, draws = 0, spread_seed = 1;
  bool allow_unreachable = false;
  config::Origins origins = {};  // where its keys stand, for messages
};

// The same, understood.
struct Tuning {
  std::string file, title;
  // The runs of all generations. Its sample has the ranges that are tuned, then those that are
  // drawn; its shares come with each generation.
  Sweep runs;
  std::size_t tuned = 0;           // ranges
  std::vector<double> drawn = {};  // shares of the drawn ranges, point by point
  std::size_t draws = 1;
  Goals goals;
  MethodAsked method;
  std::size_t generations = 0;
  std::vector<double> start = {};         // shares of what the experiment has; the first candidate
  double atmosphere = units::atmosphere;  // of the experiment, for gauges [Pa]

  // How many runs a candidate has, and a generation.
  std::size_t runs_of_candidate() const { return points(runs) / (generations * method.population); }
  std::size_t runs_of_generation() const { return points(runs) / generations; }
};

// Throws config::Error with everything that is wrong with the file.
TuningFile load_tuning_file(const std::string& path);

// Throws config::Error for words that cannot be, and for an experiment that is wrong. Nothing is
// run.
Tuning tuning_of(const std::string& path, const TuningFile& file);

// Both, with more values for every run, and another number of generations where it is above 0.
Tuning load_tuning(const std::string& path, const std::vector<std::string>& sets = {},
                   int generations = 0);

}  // namespace sinew::tune
