// control/joint/joint_controller.h - the low-level controller of the joints [thesis 5.1, 5.2].
//
// Reads the sensors in a fixed scan, runs each joint's two laws once per period and converts their
// duties to valve edges. It uses neither a port nor a clock: a loop calls it for the next event,
//
//   Tick t = 0;
//   for (; t < end; t = controller.next_event(t)) {
//     if (controller.starts_period(t)) controller.command(gait.update(controller.state(), t));
//     for (const Edge& e : controller.edges(t)) port.drive(e);
//     if (const Conversion* c = controller.due(t))
//       controller.take(*c, port.read(c->channel, t), t);
//   }
//
// or visits every tick: the edges are the same. Ticks must not decrease.
//
//   startup --(startup_vent)--> running --(shut_down, fault, end)--> venting
//   venting --(shutdown_vent)--> off
//
// Embedded core: no heap, no exceptions, no clock, single precision; bit-identical on every
// machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/config.h"
#include "sinew/control/joint/exact.h"
#include "sinew/control/joint/laws.h"
#include "sinew/control/joint/pulse_train.h"
#include "sinew/control/joint/state.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

class JointController {
 public:
  // Requires that problem(config) is nullptr.
  explicit JointController(const JointControllerConfig& config) noexcept;

  // Returns the scan. The span refers to this object.
  signals::Scan scan() const noexcept;

  // Returns the first tick after t with an event: start of a period, edge or conversion.
  signals::Tick next_event(signals::Tick t) noexcept;

  // Returns whether t is a multiple of the period. (A 64-bit remainder is a library call on a small
  // machine.)
  bool starts_period(signals::Tick t) noexcept;

  // Sets the command of the gait controller; called at a period's start.
  void command(const Command& command) noexcept { command_ = command; }

  // Returns the edges to drive at tick t, which were decided earlier; closing ones first. Each is
  // returned once; the span is valid until the next call.
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;

  // Returns the tick of the first edge that edges() has not returned yet, or PulseTrain::never.
  signals::Tick next_edge() const noexcept { return next_edge_; }

  // Returns the conversion to read at tick t, or nullptr.
  const signals::Conversion* due(signals::Tick t) noexcept;
  // Returns the conversion that the hardware starts in this tick and that is read later, or
  // nullptr. Called after due().
  const signals::Conversion* begins(signals::Tick t) const noexcept;

  // Stores a conversion's result and runs the laws that wait for it.
  void take(const signals::Conversion&, signals::Reading, signals::Tick t) noexcept;

  // Return the state, and the configuration that it was constructed from.
  const ControllerState& state() const noexcept { return state_; }
  const JointControllerConfig& config() const noexcept { return config_; }

  // Counts a tick that the clock missed. Its events are still processed.
  void missed(signals::Tick t) noexcept;

  // Vents, then shuts all valves; the loop continues until state().phase is `off`.
  void shut_down(signals::Tick t) noexcept;

  // --- for a supervisor (control/supervise); to be called before edges(t) ---

  // Skips the ticks before t: a valve that should have switched in them is shut at t and stays shut
  // until its joint's next law.
  void skip_to(signals::Tick t) noexcept;

  // Shut valves from t on, until the joint's next law. Valves that do not seal keep their state,
  // since they would vent without current.
  void shut_inlets(signals::Tick t) noexcept;
  void shut_valves(std::size_t joint, signals::Tick t) noexcept;

  // Ends the run as a fault of that channel: inlets shut and exhausts open from t on, without a
  // law's delay.
  void trip(signals::Status, signals::Channel, signals::Tick t) noexcept;

 private:
  static constexpr std::size_t valves_per_joint = 4;  // in the order of Duties
  using JointValves = std::array<PulseTrain, valves_per_joint>;

  enum Side : std::size_t { flexor, extensor };
  static constexpr Side sides[] = {flexor, extensor};

  // A setpoint that a regulator will receive.
  struct PendingLevel {
    signals::Tick at = PulseTrain::never;
    std::uint16_t level = 0;
  };

  // The other joint of a muscle over two joints; the joint whose law runs later drives the valves.
  struct Partner {
    std::int8_t joint = -1;
    Side side = flexor;
    bool drives = true;  // true: this joint drives them, not the partner
  };

  // time and readings
  void locate(signals::Tick t) noexcept;
  void store(signals::Channel, signals::Reading, signals::Tick t) noexcept;
  std::int32_t counts(signals::Channel c) const noexcept { return state_.reading[c.index].counts; }

  // laws
  bool ready(std::size_t joint, signals::Tick t) const noexcept;
  void run_law(std::size_t joint, signals::Tick t) noexcept;
  float speed(std::size_t joint) noexcept;
  Pair lengths(std::size_t joint) const noexcept;
  Stiffness measured_stiffness(std::size_t joint) const noexcept;
  Exact stiffness_output(std::size_t joint) noexcept;
  void set_duties(std::size_t joint, Exact u_k, Exact u_theta) noexcept;
  void set_levels(std::size_t joint, Exact u_k, Exact u_theta) noexcept;
  void open_loop(std::size_t joint) noexcept;
  void share_duties(std::size_t joint) noexcept;

  // valves
  const MuscleConfig& muscle(std::size_t joint, Side side) const noexcept;
  bool drives(std::size_t joint, Side side) const noexcept;
  void find_partners() noexcept;
  void schedule(std::size_t joint, signals::Tick t) noexcept;
  void schedule_openings(signals::Tick t) noexcept;
  void schedule_level(std::size_t joint, Side side, signals::Tick t) noexcept;
  void vent(signals::Tick from, std::uint32_t ticks, Phase during, Phase after) noexcept;
  void collect_edges(signals::Tick t) noexcept;
  void drive(std::size_t joint, std::size_t valve, signals::Tick t) noexcept;
  void collect_levels(signals::Tick t) noexcept;
  void find_next_edge() noexcept;
  void find_next_edge_of(std::size_t joint) noexcept;
  void find_first_edge() noexcept;

  JointControllerConfig config_;
  Command command_;
  ControllerState state_;

  // Laws
  std::array<VelocityState, max_joints> velocity_;
  std::array<RegulatorState, max_joints> regulator_;
  std::array<Pair, max_joints> signed_duties_;  // signed duties of the last law [%]
  std::array<std::uint32_t, max_channels> bad_in_a_row_{};
  std::array<bool, max_channels> has_good_reading_{};  // had a good reading

  // Time
  signals::Tick period_start_ = 0;
  std::size_t cursor_ = 0;       // first conversion of the period at or after the current tick
  signals::Tick phase_end_ = 0;  // end of startup or venting
  Phase next_phase_ = Phase::running;
  signals::Tick opened_ = -1;  // period whose openings were scheduled last

  // Valves
  bool timed_ = false, regulated_ = false;  // at least one joint is
  std::array<std::array<Partner, 2>, max_joints> partner_;
  std::array<JointValves, max_joints> valves_;
  std::array<std::array<PendingLevel, 2>, max_joints> levels_;
  std::array<signals::Tick, max_joints> next_of_{};  // next edge of each joint
  signals::Tick next_edge_ = PulseTrain::never;
  std::array<signals::Edge, max_joints * valves_per_joint> out_;
  std::size_t out_count_ = 0;
};

}  // namespace sinew::control
