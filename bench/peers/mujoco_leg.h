// bench/peers/mujoco_leg.h - the leg in MuJoCo, as its users would simulate it: bodies and contacts
// of MuJoCo in steps of 1 ms, muscles of pow_muscle.h in steps of 100 us, driven through the port.
//
// It has the same parameters as ours. Differences:
//
//   foot       a ball on a plane with MuJoCo's soft constraint of 4 ms; ours has a spring and a
//   damper tensions   are constant over a body step; lengths are interpolated linearly friction of
//   joints, meshes and trolley is MuJoCo's friction loss, which is also soft; tension
//              sensors do not include that of the mesh
//   valves     switch at the next tick of 100 us, not between two
//   track      ends at a joint limit of MuJoCo
#pragma once

#include <memory>
#include <string>

#include "sinew/mechanism/planar/setup.h"
#include "sinew/signals/port.h"

namespace sinew::bench {

// Returns the version that was compiled in, such as "2.2.2".
std::string mujoco_version();

enum class Integrator { euler, rk4 };

struct LegSteps {
  int body = 10;   // ticks of 100 us
  int muscle = 1;  // steps per tick
};

// Motion of the body: joint angles [rad], their rates [rad/s], the trolley's position [m] and speed
// [m/s].
struct LegMotion {
  double x = 0, x_rate = 0, hip = 0, hip_rate = 0, knee = 0, knee_rate = 0;
};

// Throws std::runtime_error if MuJoCo refuses the model.
class MujocoLeg final : public signals::Port {
 public:
  MujocoLeg(const plant::Setup& setup, const LegSteps& steps = {},
            Integrator integrator = Integrator::euler);
  ~MujocoLeg();
  MujocoLeg(const MujocoLeg&) = delete;
  MujocoLeg& operator=(const MujocoLeg&) = delete;

  signals::Status start(const signals::Scan& scan) noexcept override;
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // Without muscles: sets a motion, makes one MuJoCo step, and returns the motion.
  void place(const LegMotion& motion) noexcept;
  void step_body() noexcept;
  LegMotion motion() const noexcept;
  bool touches() const noexcept;  // the ground, after the last step

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sinew::bench
