// identify/valve/timing.h - predict.dat for a valve: switching times of the coil for which the
// valve itself is open for the commanded duty.
//
//   open = 100 - t_o f_pwm 100,  close = delta - t_c f_pwm 100
//   in hundredths of the period, rounded                                                       B.4
//
// If the delays take too much of the period, a duty is not possible, and the nearest possible
// one is used, including 0 and 100 %.
#pragma once

#include <array>
#include <string>

#include "sinew/signals/timing.h"

namespace sinew::identify {

// Pulses that deliver the commanded duties, as far as the delays allow.
struct CompensatedTiming {
  signals::ValveTiming timing;
  std::array<double, signals::max_duty + 1> delivered{};  // delivered duty for each percent [-]
  double worst = 0;                                       // largest |delivered - duty| [-]
};

// Computes the timing for delays [s] and a pulse frequency [Hz]. Throws Refusal if the opening
// delay takes the whole period.
CompensatedTiming compensated(double opening_delay, double closing_delay, double frequency);

// Returns 101 rows duty,close,open, as config/valve_timing.h reads them.
std::string predict_dat(const signals::ValveTiming& timing);

}  // namespace sinew::identify
