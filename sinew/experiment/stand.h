// experiment/stand.h - test stand of an experiment: its start, the drive of its valves, and what is
// measured.
#pragma once

#include <string>
#include <vector>

#include "sinew/robot/stand.h"

namespace sinew::experiment {

struct Stand : robot::Stand {
  // Drive that opens and shuts the valves (run/controllers/drive.h).
  struct Drive {
    // Law of the drive: none; pulses with a duty; single pulses; a length by the model; a length by
    // a sensor.
    enum class Kind { none, pwm, pulses, feed_forward, feedback };
    // Correction of the feedback: full pulses beyond the dead band, or a duty proportional to the
    // error.
    enum class Law { on_off, proportional };

    // One opening of a valve.
    struct Pulse {
      double at = 0, open = 0;  // [s]
      bool exhaust = false;
    };

    Kind kind = Kind::none;
    double period = 0.04;                          // period of the pulses and of the law [s]
    double duty = 0;                               // pwm: duty of the inlet [-]
    std::vector<signals::Schedule::Point> duties;  // pwm: duties from their instants on
    std::vector<Pulse> pulses;
    double desired = 0;                             // feed-forward, feedback: desired length [m]
    std::vector<signals::Schedule::Point> lengths;  // desired length over time
    double assumed_load = 0;                        // feed-forward: assumed load on the element [N]
    Law law = Law::proportional;                    // feedback
    std::string sensor;                             // feedback: sensor of the length
    double dead_band = 0;                           // feedback: largest error without a pulse [m]
    double gain = 0;                                // proportional: duty per error [1/m]
  };

  // Sweep of the duty, each on a separate stand with the same start: settled length over duty.
  struct Sweep {
    double from = 0, to = 0, step = 0;  // duties; step 0: no sweep [-]
  };

  // Rows of measured.csv, the record of a stand's operator.
  struct Measured {
    double period = 0;  // between rows; 0: the log's period [s]
    double from = 0;    // time of the first row [s]
  };

  double duration = 0;       // length of the run [s]
  double step = 5e-4;        // longest step between nodes [s]
  double accuracy = 3.4e-7;  // error of an oscillation per radian, between nodes [-]

  double start_pressure = 0;  // absolute [Pa]
  double start_length = 0;    // 0: where the load is in balance [m]
  double displacement = 0;    // shift from there with the same air, positive down [m]
  Drive drive;
  Sweep sweep;
  Measured measured;
};

}  // namespace sinew::experiment
