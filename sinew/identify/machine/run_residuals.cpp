#include <algorithm>
#include <cmath>

#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

using experiment::Experiment;

RunResiduals::RunResiduals(const Experiment& machine, const DrivenRun& run,
                           std::span<const Parameter> parameters, const RunFitOptions& options,
                           double until)
    : machine_(machine), run_(run), parameters_(parameters), options_(options), until_(until) {
  std::size_t sample = 0;
  for (const RunChannel& c : run.channels())
    for (const double value : c.value) {
      reading_.push_back(value);
      noise_.push_back(c.noise);
      bottom_.push_back(c.bottom);
      top_.push_back(c.top);
      const double t = run.time(sample);
      if (t >= options.from && t <= until_) fitted_.push_back(sample);
      ++sample;
    }
}

Experiment RunResiduals::machine(std::span<const double> p) const {
  Experiment out = machine_;
  const std::vector<MachineNumber> all = machine_numbers(out);
  for (std::size_t i = 0; i < p.size(); ++i)
    *std::ranges::find(all, parameters_[i].name, &MachineNumber::key)->value = p[i];
  return out;
}

bool RunResiduals::operator()(std::span<const double> p, std::span<double> r) const {
  ++simulations_;
  std::vector<double> mean(run_.samples());
  if (!run_.predict(machine(p), mean, until_)) return false;
  std::size_t k = 0;
  for (const std::size_t s : fitted_) r[k++] = (mean[s] - reading_[s]) / noise_[s];
  for (const RunPrior& prior : options_.priors) {
    const auto i = static_cast<std::size_t>(
        std::ranges::find(parameters_, prior.key, &Parameter::name) - parameters_.begin());
    r[k++] = (p[i] - prior.value) / prior.standard_deviation;
  }
  return true;
}

bool RunResiduals::is_cut(std::size_t k, double residual) const {
  constexpr double near = 2;  // in noises
  if (k >= fitted_.size()) return false;
  const std::size_t s = fitted_[k];
  const double mean = reading_[s] + noise_[s] * residual;
  return mean < bottom_[s] + near * noise_[s] || mean > top_[s] - near * noise_[s];
}

double RunResiduals::cost(std::span<const double> p) const {
  std::vector<double> r(count());
  if (!(*this)(p, r)) return unbounded;
  double sum = 0;
  for (const double x : r) sum += 0.5 * x * x;
  return std::isfinite(sum) ? sum : unbounded;
}

}  // namespace sinew::identify
