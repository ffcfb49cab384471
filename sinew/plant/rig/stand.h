// plant/rig/stand.h - the test stand of figures 2-7 and 3-5 as a Port: one muscle and what pulls
// it.
//
//   hanging   M L'' = M g + F_ext - F(L, L', P) - F_dry                           [36], [37]
//   driven    L(t) as prescribed: a tensile machine, or a clamp
//
//   L      length of the muscle, grows downwards [m]     F      of the muscle, both ends held [N]
//   M      hanging mass [kg]                             F_dry  dry friction, |F_dry| <= Q k, [33]
//
// The air is muscle::AirNetwork's; valves, hoses, leaks, walls, tank and delays all work. A
// regulated stand holds its air at the prescribed pressure instead. With an air cylinder in the
// muscle's place L is how far its rod is out, and it pulls as the pressure on the rod's side pushes
// it in.
//
// One RK4 over body and air. Nodes are multiples of the step and where a valve really moves, and
// nothing else: reads and truth work on a copy and change no bit. Between two nodes the integration
// is cut where something breaks off:
//
//   the mesh comes to rest or breaks loose    at rest it holds while the load asks for no more than
//                                             the bound, a real stick; in motion F_dry is at it
//   L passes L_max or L_min                   [31], [32] break off there; a stage that oversteps
//                                             goes by the side on which the piece began
//   a schedule has a point
//
// and into pieces that suit the fastest rate. So the order of RK4 is kept through friction and end
// stops; docs/theory/test-stand.md has how far it has converged. With `stick = false` the sign of
// the speed is taken in every stage as appendix A does: no cut, first order, and creep at rest.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/muscle/failure.h"
#include "sinew/muscle/network.h"
#include "sinew/plant/rig/setup.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// Static length at which the load hangs, valves holding the start's pressure, without friction [m].
// Throws std::invalid_argument where there is none.
double hanging_length(const StandSetup& setup);

class Stand final : public signals::Port {
  using Air = muscle::AirNetwork<4>;

  enum class Rub : signed char { rests = 0, down = 1, up = -1 };

  // The part of the state that is integrated.
  struct Moving {
    double length = 0, velocity = 0;
    Air::State air{};
    Air::Memory memory{};
    double in = 0, out = 0, leak = 0;  // since the start [kg]
    Rub rub = Rub::rests;              // driven: of the last motion
  };

  // What is prescribed, on the piece at hand.
  struct Order {
    Line mass, force, length, pressure;
    double corner = 0;                 // where it ends [s]
    double shortest = 0, longest = 0;  // lengths whose law holds on it [m]
  };

  struct Look {
    Air::Answer pull;
    double force = 0;  // of the element, dry friction apart [N]
    double bound = 0;  // of the dry friction [N]
    double asks = 0;   // M g + F_ext - force [N]
    double velocity = 0, acceleration = 0;
    double in = 0, out = 0, leak = 0;  // [kg/s]
  };

 public:
  // The stand at its last node, and the commands since. Copied like bytes; of one build of the
  // library, and for stands of equal setups.
  struct State {
    Moving now;
    Air::Valves valves;
    Look first;       // at the last node
    double time = 0;  // of the node [s]
    std::int64_t multiple = 0, nodes = 0;
    bool ended = false;
    muscle::Failure failure;
  };

  // Throws std::invalid_argument for a set-up that is no stand.
  explicit Stand(const StandSetup& setup);

  signals::Status start(const signals::Scan& scan) noexcept override;
  // Valve 0 is the inlet or a 3-way valve, 1 the exhaust; invalid unless the air comes by valves,
  // and for an edge before the last node.
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // The stand at time t [s], at or after every earlier call's; an earlier one is answered with the
  // last node.
  StandTruth truth(double t) noexcept;

  // Commits every node up to t.
  void advance(double t) noexcept;
  double time() const noexcept { return state_.time; }  // of the last node [s]
  std::int64_t nodes() const noexcept { return state_.nodes; }
  const muscle::Failure& failure() const noexcept { return state_.failure; }
  double air_mass() const noexcept;  // in muscle, hose and tank [kg]

  const State& state() const noexcept { return state_; }
  // Goes on from there as the stand did whose state it was: the same bits.
  void restore(const State& state) noexcept { state_ = state; }

 private:
  Order order(double t) const noexcept;
  Order order_from(double t, double length) const noexcept;
  void look(double t, const Order& o, const Moving& s, Look& out) const noexcept;
  void evaluate(double t, double length, double rate, const Air::State& air,
                const Air::Memory& memory, Look& out) const noexcept;
  Moving shifted(const Moving& from, double h, const Look& by) const noexcept;
  Moving rk4(double t, double h, const Order& o, const Moving& s, const Look& first) const noexcept;
  int region(double length) const noexcept;
  bool breaks(double t, const Order& o, const Moving& before, const Moving& after) const noexcept;
  void settle(double t, const Order& o, Moving& s) const noexcept;
  double settling_rate(double exponent, const Moving& s, const Look& at) const noexcept;
  double swinging_rate(double exponent, double mass, const Moving& s,
                       const Look& at) const noexcept;
  double longest_piece(const Order& o, const Moving& s, const Look& at) const noexcept;
  double piece(double t, double end, Moving& s) const noexcept;
  Moving moved(Moving s, double from, double to) const noexcept;
  void place(double t, const Order& o, Moving& s) const noexcept;
  double travel(double length) const noexcept;        // of the cylinder [m]
  double air_in(const Air::State& s) const noexcept;  // in the element [kg]
  void prepare() noexcept;                            // at a new node
  void look_for_failure() noexcept;
  double next_node() const noexcept;
  void commit() noexcept;
  // `truth`, and for a conversion that began before the last node what was prescribed there.
  StandTruth seen(double t) noexcept;
  double quantity(const Transducer& t, double at) noexcept;

  StandSetup setup_;
  Air air_;
  bool driven_ = false, regulated_ = false;
  bool rubs_ = false;                           // dry friction with a real stick
  std::array<double, 2> ends_{};                // L_min, L_max; an air cylinder has none [m]
  double end_stiffness_ = 0, end_damping_ = 0;  // of the stiffer end [N/m], [N s/m]

  State state_;
  std::array<signals::Tick, 256> lag_{};
};

}  // namespace sinew::plant
