#include "sinew/tune/optimizer/kept.h"

#include <fmt/format.h>

#include <exception>

namespace sinew::tune {
namespace {

// "generation 3 of 40: best trolley.mean_speed [in/s] = 6.21, 12 of 16 feasible"
class Teller {
 public:
  Teller(const Tuning& tuning, const run::Notices& notices) : tuning_(tuning), notices_(notices) {}

  void generation(const std::vector<Candidate>& candidates) {
    std::size_t feasible = 0;
    for (const Candidate& c : candidates) {
      feasible += c.judged.feasible() ? 1 : 0;
      if (!best_ || dominates(tuning_.goals, c.judged, *best_)) best_ = c.judged;
    }
    std::string best = fmt::format("violation {:.3g}", best_->violation);
    if (best_->feasible() && tuning_.goals.goals.size() == 1)
      best = fmt::format("{} = {:.6g}", tuning_.goals.goals.front().figure.heading(),
                         best_->goals.front());
    const bool one = best_->feasible() && tuning_.goals.goals.size() > 1;
    notices_.note(fmt::format("generation {} of {}: {}{} of {} feasible",
                              candidates.front().generation + 1, tuning_.generations,
                              one ? "" : "best " + best + ", ", feasible, candidates.size()));
  }

 private:
  const Tuning& tuning_;
  const run::Notices& notices_;
  std::optional<Judgement> best_;
};

}  // namespace

Tuned optimize_kept(const Tuning& tuning, const std::filesystem::path& file,
                    const KeptOptions& options) {
  Results results(file, asked_of(tuning));
  results.expect(points(tuning.runs));
  TuneOptions own = options.tune;
  own.runs.known = results.rows();
  if (!own.runs.known.empty())
    options.notices.note(fmt::format("{}: {} of {} runs are there", file.string(),
                                     own.runs.known.size(), points(tuning.runs)));
  std::exception_ptr failure;
  const auto stop = [&] {
    if (options.ask_to_stop) options.ask_to_stop();
  };
  own.runs.done = [&](const Row& row) {
    if (!results.add(row)) stop();
  };
  Teller teller(tuning, options.notices);
  own.generation = [&](const std::vector<Candidate>& candidates) {
    if (options.tune.generation) options.tune.generation(candidates);
    teller.generation(candidates);
    std::vector<CandidateRow> rows;
    for (const Candidate& c : candidates) rows.push_back(row_of(c));
    try {
      results.add_candidates(rows);
    } catch (...) {
      failure = std::current_exception();
      stop();
    }
  };
  Tuned out = optimize(tuning, own);
  results.throw_failure();
  if (failure) std::rethrow_exception(failure);
  return out;
}

}  // namespace sinew::tune
