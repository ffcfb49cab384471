// identify/valve/timing.h - predict.dat for a valve: when to switch its coil, so that the valve
// itself is open for the duty.
//
//   open = 100 - t_o f_pwm 100,  close = delta - t_c f_pwm 100
//   in hundredths of the period, rounded                                                       B.4
//
// Where the delays take too much of the period a duty is not possible: the nearest possible one is
// taken, 0 and 100 % among them.
#pragma once

#include <array>
#include <string>

#include "sinew/signals/timing.h"

namespace sinew::identify {

// Pulses that deliver the duties that were asked for, as far as delays allow.
struct CompensatedTiming {
  signals::ValveTiming timing;
  std::array<double, signals::max_duty + 1> delivered{};  // what comes of each percent [-]
  double worst = 0;                                       // |delivered - duty| at most [-]
};

// Delays [s], frequency of the pulses [Hz]. Throws Refusal where an opening delay leaves nothing of
// the period.
CompensatedTiming compensated(double opening_delay, double closing_delay, double frequency);

// 101 rows duty,close,open, as config/valve_timing.h reads them.
std::string predict_dat(const signals::ValveTiming& timing);

}  // namespace sinew::identify
