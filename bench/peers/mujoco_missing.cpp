// Replaces mujoco_leg.cpp if MuJoCo is not installed.
#include <stdexcept>

#include "bench/peers/mujoco_leg.h"

namespace sinew::bench {

struct MujocoLeg::State {};

std::string mujoco_version() { return "none"; }
bool has_mujoco() { return false; }

MujocoLeg::MujocoLeg(const plant::Setup&, const LegSteps&, Integrator) {
  throw std::runtime_error("MuJoCo is not compiled in");
}
MujocoLeg::~MujocoLeg() = default;

signals::Status MujocoLeg::start(const signals::Scan&) noexcept { return signals::Status::fault; }
signals::Status MujocoLeg::drive(signals::Edge) noexcept { return signals::Status::fault; }
signals::Reading MujocoLeg::read(signals::Channel, signals::Tick) noexcept {
  return {0, signals::Status::fault};
}
signals::Status MujocoLeg::stop(signals::Tick) noexcept { return signals::Status::fault; }

void MujocoLeg::place(const LegMotion&) noexcept {}
void MujocoLeg::step_body() noexcept {}
LegMotion MujocoLeg::motion() const noexcept { return {}; }
bool MujocoLeg::touches() const noexcept { return false; }

}  // namespace sinew::bench
