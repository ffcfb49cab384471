// air/exact_root.cpp - compiled once for all processors (braid_law.h), and for graphics cards.
#include "sinew/air/braid_law.h"

namespace sinew::air {

double exact_root(double density, double inverse_reference, double exponent) noexcept {
  return units::power(density * inverse_reference, exponent);
}

}  // namespace sinew::air
