// bench/peers/mujoco_leg.h - the leg as MuJoCo's users would simulate it: MuJoCo's bodies and
// contacts at steps of a millisecond, muscles by pow_muscle.h at 100 us, driven through the port.
//
// It is made from the same numbers as ours. What differs:
//
//   foot       a ball on a plane by MuJoCo's soft constraint, of 4 ms; ours a spring and a damper
//   tensions   are held over a body step, lengths go straight through it
//   friction   of joints, meshes and trolley is MuJoCo's friction loss, likewise soft; a gauge sees
//              no share of the mesh's
//   valves     move at the next tick of 100 us, not between two
//   track      ends at MuJoCo's limit of a joint
#pragma once

#include <memory>
#include <string>

#include "sinew/mechanism/planar/setup.h"
#include "sinew/signals/port.h"

namespace sinew::bench {

// Returns the version that was compiled in: "2.2.2", or "none".
std::string mujoco_version();
bool has_mujoco();

enum class Integrator { euler, rk4 };

struct LegSteps {
  int body = 10;   // ticks of 100 us
  int muscle = 1;  // steps of a tick
};

// Motion of the body alone: joints [rad], their rates [rad/s], the trolley [m], [m/s].
struct LegMotion {
  double x = 0, x_rate = 0, hip = 0, hip_rate = 0, knee = 0, knee_rate = 0;
};

// Throws std::runtime_error where MuJoCo is not compiled in or refuses the leg.
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

  // Without muscles: sets a motion, makes one step of MuJoCo's, answers where it is.
  void place(const LegMotion& motion) noexcept;
  void step_body() noexcept;
  LegMotion motion() const noexcept;
  bool touches() const noexcept;  // the ground, after the last step

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sinew::bench
