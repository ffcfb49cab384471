// experiment/stand.h - what an experiment does with a test stand: its start, what drives its
// valves, and what is measured.
#pragma once

#include <string>
#include <vector>

#include "sinew/robot/stand.h"

namespace sinew::experiment {

struct Stand : robot::Stand {
  // The drive opens and shuts the valves: run/controllers/drive.h.
  struct Drive {
    // Names the law: nothing; pulses of a duty; single pulses; by the model to a length; by a
    // sensor to a length.
    enum class Kind { none, pwm, pulses, feed_forward, feedback };
    // Names how the feedback corrects an error: by full pulses beyond the dead band, or a duty by
    // the error.
    enum class Law { on_off, proportional };

    // One opening of a valve.
    struct Pulse {
      double at = 0, open = 0;  // [s]
      bool exhaust = false;
    };

    Kind kind = Kind::none;
    double period = 0.04;                          // of the pulses, and of the law [s]
    double duty = 0;                               // pwm: of the inlet [-]
    std::vector<signals::Schedule::Point> duties;  // pwm: from their instants on
    std::vector<Pulse> pulses;
    double desired = 0;                             // feed-forward, feedback: length [m]
    std::vector<signals::Schedule::Point> lengths;  // the same over time
    double believed_load = 0;                       // feed-forward: hangs on the element [N]
    Law law = Law::proportional;                    // feedback
    std::string sensor;                             // feedback: of the length
    double dead_band = 0;                           // feedback: error without a pulse [m]
    double gain = 0;                                // proportional: duty per error [1/m]
  };

  // Each duty on a stand of its own, all from the same start: settled length against duty.
  struct Sweep {
    double from = 0, to = 0, step = 0;  // duties; step 0: no sweep [-]
  };

  // measured.csv: what an operator of the stand writes down.
  struct Measured {
    double period = 0;  // between rows; 0: that of the log [s]
    double from = 0;    // the first [s]
  };

  double duration = 0;       // of the run [s]
  double step = 5e-4;        // between nodes, at most [s]
  double accuracy = 3.4e-7;  // of a swing, per radian of it, between nodes [-]

  double start_pressure = 0;  // absolute [Pa]
  double start_length = 0;    // 0: where the load hangs [m]
  double displacement = 0;    // [m]
  Drive drive;
  Sweep sweep;
  Measured measured;
};

}  // namespace sinew::experiment
