#include "sinew/actuator/life.h"

namespace sinew::actuator {
namespace {

// Returns the probability of at most `count` failures where `mean` are expected.
double at_most(int count, double mean) {
  double term = std::exp(-mean), sum = term;
  for (int i = 1; i <= count; ++i) sum += term *= mean / i;
  return sum;
}

// Returns the mean with which at most `count` failures have this probability, by bisection.
double mean_of(int count, double probability) {
  double low = 0, high = 1;
  while (at_most(count, high) > probability) high *= 2;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (at_most(count, middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Bounds life_from_failures(int failures, double cycles, double probability) {
  const double tail = 0.5 * (1 - probability);
  Bounds out{.least = cycles / mean_of(failures, tail)};
  if (failures > 0) out.most = cycles / mean_of(failures - 1, 1 - tail);
  return out;
}

}  // namespace sinew::actuator
