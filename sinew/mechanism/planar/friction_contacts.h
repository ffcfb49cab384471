// mechanism/planar/friction_contacts.h - contacts and friction of a machine of any shape: joints,
// trolley, lift and the discs of its feet. It generalises chain_body.h to a list of discs and one
// more coordinate.
//
// A disc's centre is at (along, across) of its leg's last link; slip and normal force refer to its
// lowest point. Contact c slips with the velocity J_c q' and carries the force f_c; see friction.h
// for the law.
//
// The ground is stiff: within a step of length h the normal forces change by about
//
//   dF = -(k h/2 v + beta (a + R dF + A f)),   beta = h (h/6 k + c/2)
//
//   v, a  discs' motion upwards, without dF and friction    R  upward acceleration per normal force
//   f     friction forces                                   A  upward acceleration per friction
//
// This is solved for dF and inserted into the slips: W becomes W - h beta A^T (1 + beta R)^-1 A.
//
// Under a light foot the rate of the ground's damper can exceed the stability limit of RK4, rate
// times step 2.78. Its force is then relaxed in the stages two to four: with g, the relaxation,
//
//   a_s = f_s - g h c B (a_s - a_s-1)     B = M^-1 J^T J, J the rise of the loaded discs
//
// a W-method of the second order along those discs and of the fourth elsewhere. With g = 0.2 a lone
// damper keeps at most a tenth of its velocity over a step for products from 2 to 4.5, and is
// stable up to 7.65. A preview uses the mean over the step, g = 1/2 with zero before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "sinew/mechanism/friction/friction.h"
#include "sinew/mechanism/planar/body.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

// Rates at which springs and dampers of the joints, the ground's spring and its damper bring a
// machine to rest [1/s]: c w and sqrt(k w) with w, the joint's or disc's acceleration per force.
// The stops of the track and of the cylinder count among the joints.
struct FastestRates {
  double joints = 0, ground_spring = 0, ground_damper = 0;
  double lift = 0;  // body's acceleration per force on the piston [1/kg]; 0 if held

  // Takes the larger of each.
  void include(const FastestRates& other) {
    joints = std::max(joints, other.joints);
    ground_spring = std::max(ground_spring, other.ground_spring);
    ground_damper = std::max(ground_damper, other.ground_damper);
    lift = std::max(lift, other.lift);
  }
};

// Dependence of a disc's lowest point on the coordinates.
template <int N>
struct DiscAt {
  Coordinates<N> slip, rise;    // d(slip velocity)/dq', d(y')/dq'
  double slip_bias, rise_bias;  // velocity terms of the accelerations [m/s^2]
};

// A body in its pose, with its discs on the ground: terms shared by several forces of one
// evaluation.
template <int N, int D>
struct BodyOnGround : Body<N> {
  using Body<N>::Body;

  std::array<double, D> depth;       // depth of each disc in the ground [m]
  std::array<DiscAt<N>, D> contact;  // set only where the depth is positive
};

// Contacts of a body with capacity for N links (body.h), on feet with capacity for D discs.
template <int N, int D>
class FrictionContacts {
 public:
  using Pose = BodyOnGround<N, D>;
  static constexpr int trolley = N, lift = trolley + 1, first_disc = lift + 1;
  static constexpr int count = first_disc + D;
  using Forces = std::array<double, count>;  // joints [N m], others [N]
  using Normals = std::array<double, D>;

  // Links from the body to a foot, and the position along each at which the next one is attached;
  // for the last one its end [m].
  struct Path {
    std::size_t count = 0;
    std::size_t first = 0;  // index in `link` of the leg's first link
    bool whole = false;     // it consists of all links, in order
    std::array<std::size_t, N> link{};
    std::array<double, N> reach{};
    double start = 0;  // first link, ahead of the body's origin [m]
  };

  // Takes the robot's feet and friction; the body must outlive the object.
  FrictionContacts(const BodyConstants<N>& body, const robot::Robot& robot);

  // Return the numbers of discs and feet.
  int discs() const { return disc_count_; }
  std::size_t feet() const { return foot_count_; }
  // Returns the path of a leg, also if its foot is not present.
  const Path& leg(std::size_t foot) const { return path_[foot]; }
  std::size_t foot_of(int disc) const { return disc_[static_cast<std::size_t>(disc)].foot; }
  double friction(std::size_t disc) const { return disc_[disc].friction; }  // Coulomb [-]

  // Returns the fastest rates at which the machine is brought to rest in a pose [1/s].
  // `of_muscles`: damping that they add to each joint.
  FastestRates fastest_rates(const Body<N>& body, const BodyState<N>& motion,
                             const robot::Robot& robot, std::span<const double> of_muscles) const;
  DiscAt<N> disc(const Body<N>& body, const BodyState<N>& motion, int i) const;

  // Returns the depth of a disc in the ground; above 0 if they touch [m].
  double depth(const Body<N>& body, const BodyState<N>& motion, int i) const;

  // Returns the compliant force of the ground on a disc at this depth, never pulling [N].
  double push(double depth, const DiscAt<N>& disc, const BodyState<N>& motion) const;

  // Returns whether any disc is on the ground.
  bool touches(const Pose& pose) const;

  // Returns whether a disc can touch or leave the ground within h, by the rates of the links that
  // carry it.
  bool can_change(const Pose& pose, const BodyState<N>& motion, double h) const;

  // Computes depths and contacts of a pose's discs.
  void place(const BodyState<N>& motion, Pose& pose) const;

  // Returns J^T f.
  Coordinates<N> generalised(const Pose& pose, const BodyState<N>& motion, const Forces& f) const;

  // Relaxes the ground's damper in steps longer than this  [s].
  void relax_beyond(double step) { longest_explicit_ = step; }
  static constexpr double stable_relaxed = 7.65, stable_explicit = 2.785;  // rate times step

  // Relaxes accelerations in a step of length h by those of the stage before, with g = share; only
  // for discs that are loaded at the node and here.
  void relax(double h, double share, const Normals& pushed, const Coordinates<N>& before,
             Coordinates<N>& a) const {
    if (h > longest_explicit_ && touching_count_ > 0) relax_touching(share * h, pushed, before, a);
  }

  // Prepares a node: accelerations without friction, bounds, and the ground's forces on the discs.
  void prepare(const Pose& pose, const BodyState<N>& motion, const Coordinates<N>& acceleration,
               const Forces& bound, const Normals& normal);

  // Returns the dry friction of a step of length h; `last`: that of the last step.
  Forces hold(double h, const Forces& last) const;

  // Returns the accelerations under the friction f, given those without friction.
  Coordinates<N> accelerations(Coordinates<N> without, const Forces& f) const;

  // Returns the bound of a contact's dry friction, as computed last.
  double bound(int c) const { return bound_[static_cast<std::size_t>(c)]; }

 private:
  using Matrix = std::array<Normals, D>;

  // Returns J of a joint, of the trolley or of the lift, as a row.
  Coordinates<N> row(int c) const;
  // Returns the product of contact c's row with rates or accelerations.
  double along(int c, const Coordinates<N>& row, const Coordinates<N>& v) const;
  // `Count` is an integer, or a constant of its own type.
  template <class Count>
  Forces hold_of(double h, const Forces& last, Count active) const;
  template <class Count>
  void soften(double h, Count active, FrictionProblem<count>& problem) const;
  void relax_touching(double time, const Normals& pushed, const Coordinates<N>& before,
                      Coordinates<N>& a) const;
  void eliminate(Matrix& m) const;
  void solve(const Matrix& m, Normals& b) const;  // for an eliminated m

  struct Disc {
    std::size_t foot = 0;
    double along = 0, across = 0, radius = 0;  // position on its leg's last link [m]
    double friction = 0;                       // [-]
    double surface = 0;                        // height of the ground [m]
  };
  // Levers from each link of a path to the next, or to a disc, and the height of its last link [m].
  struct Levers {
    std::array<double, N> x, y;
    double height;
  };
  void add_foot(const robot::Robot& robot, std::size_t leg);
  Levers levers(const Body<N>& body, const BodyState<N>& motion, const Path& path) const;
  double reach(const Body<N>& body, const Disc& d, Levers& way) const;
  DiscAt<N> disc_at(const Levers& way, const Disc& d, const BodyState<N>& motion) const;

  BodyConstants<N> k_;
  robot::Ground ground_;
  std::array<Path, robot::max_legs> path_{};
  std::size_t foot_count_ = 0;
  std::array<Disc, D> disc_{};
  int disc_count_ = 0;
  double longest_explicit_ = std::numeric_limits<double>::infinity();  // [s]

  // Contacts that can carry force at the node, stored contiguously: only these are solved.
  int active_count_ = 0;
  std::array<int, count> active_{};             // their indices
  std::array<Coordinates<N>, count> column_{};  // M^-1 J^T
  FrictionProblem<count> problem_{};            // slips at the node, responses per second
  Forces slip_rate_{};                          // rates of the slips, without friction
  Forces bound_{};                              // bounds of all contacts

  // Discs that touch the ground at the node, stored the same way.
  std::size_t touching_count_ = 0;
  std::array<int, D> touching_{};                             // their indices
  Normals normal_{};                                          // force of the ground on them [N]
  Normals rise_{}, rise_rate_{};                              // without friction
  std::array<Coordinates<N>, D> rise_row_{}, rise_column_{};  // J, M^-1 J^T
  Matrix response_{};                                         // R
  std::array<Forces, D> along_{};                             // A, for the active contacts
};

// Sums over the coordinates that the machine has.
template <int N>
double dot(const BodyConstants<N>& k, const Coordinates<N>& a, const Coordinates<N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < k.coordinates(); ++i) sum += a[i] * b[i];
  return sum;
}

// Returns the levers of a leg's links up to the last one, where its discs are.
template <int N, int D>
auto FrictionContacts<N, D>::levers(const Body<N>& body, const BodyState<N>& motion,
                                    const Path& path) const -> Levers {
  Levers way;
  way.height = motion.at[up];
  const auto add = [&](std::size_t k, std::size_t link) {
    way.x[k] = path.reach[k] * body.cos(link);
    way.y[k] = path.reach[k] * body.sin(link);
    way.height += way.y[k];
  };
  if (BodyConstants<N>::exact && path.whole)
    for (std::size_t k = 0; k + 1 < N; ++k) add(k, k);
  else
    for (std::size_t k = 0; k + 1 < path.count; ++k) add(k, path.link[k]);
  return way;
}

// Extends the levers along the last link to a disc and returns the disc's depth in the ground.
template <int N, int D>
double FrictionContacts<N, D>::reach(const Body<N>& body, const Disc& d, Levers& way) const {
  const std::size_t last = path_[d.foot].count - 1, link = path_[d.foot].link[last];
  way.x[last] = d.along * body.cos(link) - d.across * body.sin(link);
  way.y[last] = d.along * body.sin(link) + d.across * body.cos(link);
  return d.surface + d.radius - (way.height + way.y[last]);
}

template <int N, int D>
DiscAt<N> FrictionContacts<N, D>::disc_at(const Levers& way, const Disc& d,
                                          const BodyState<N>& motion) const {
  const Path& path = path_[d.foot];
  DiscAt<N> at;
  at.slip[along_track] = at.rise[up] = 1;
  at.slip[up] = at.rise[along_track] = 0;
  at.slip_bias = at.rise_bias = 0;
  const auto add = [&](std::size_t k, std::size_t link) {
    const double rate2 = motion.rate[link] * motion.rate[link];
    at.slip[link] = -way.y[k];
    at.rise[link] = way.x[k];
    at.slip_bias -= way.x[k] * rate2;
    at.rise_bias -= way.y[k] * rate2;
  };
  if (BodyConstants<N>::exact && path.whole) {
    for (std::size_t k = 0; k < N; ++k) add(k, first_link + k);
  } else {
    for (std::size_t link = first_link; link < k_.coordinates(); ++link)
      at.slip[link] = at.rise[link] = 0;
    for (std::size_t k = 0; k < path.count; ++k) add(k, first_link + path.link[k]);
  }
  at.slip[first_link + path.link[path.count - 1]] += d.radius;
  return at;
}

template <int N, int D>
DiscAt<N> FrictionContacts<N, D>::disc(const Body<N>& body, const BodyState<N>& motion,
                                       int i) const {
  const Disc& d = disc_[static_cast<std::size_t>(i)];
  Levers way = levers(body, motion, path_[d.foot]);
  (void)reach(body, d, way);
  return disc_at(way, d, motion);
}

template <int N, int D>
double FrictionContacts<N, D>::depth(const Body<N>& body, const BodyState<N>& motion, int i) const {
  if (!ground_.present) return 0;
  const Disc& d = disc_[static_cast<std::size_t>(i)];
  Levers way = levers(body, motion, path_[d.foot]);
  return reach(body, d, way);
}

template <int N, int D>
bool FrictionContacts<N, D>::touches(const Pose& pose) const {
  for (std::size_t k = 0; k < static_cast<std::size_t>(disc_count_); ++k)
    if (pose.depth[k] > 0) return true;
  return false;
}

// The rates of a foot's links change by some 20 g at most: a tenth of a millimetre in a
// millisecond.
template <int N, int D>
bool FrictionContacts<N, D>::can_change(const Pose& pose, const BodyState<N>& motion,
                                        double h) const {
  const double spare = 0.5 * (20.0 * k_.gravity) * h;
  for (std::size_t k = 0; k < static_cast<std::size_t>(disc_count_) && ground_.present; ++k) {
    if (pose.depth[k] > 0) {
      const double rate = std::abs(dot(k_, pose.contact[k].rise, motion.rate)) + spare;
      if (!(pose.depth[k] - rate * h > 0)) return true;
      continue;
    }
    const Disc& d = disc_[k];
    const Path& path = path_[d.foot];
    double rate = std::abs(motion.rate[up]) + spare;
    for (std::size_t at = 0; at < path.count; ++at) {
      const bool last = at + 1 == path.count;
      const double reach = last ? std::abs(d.along) + std::abs(d.across) : std::abs(path.reach[at]);
      rate += reach * std::abs(motion.rate[first_link + path.link[at]]);
    }
    if (!(pose.depth[k] + rate * h < 0)) return true;
  }
  return false;
}

template <int N, int D>
double FrictionContacts<N, D>::push(double depth, const DiscAt<N>& disc,
                                    const BodyState<N>& motion) const {
  if (depth <= 0) return 0;
  const double rate = dot(k_, disc.rise, motion.rate);
  const double force = ground_.normal_stiffness * depth - ground_.normal_damping * rate;
  return force > 0 ? force : 0.0;
}

template <int N, int D>
void FrictionContacts<N, D>::place(const BodyState<N>& motion, Pose& pose) const {
  Levers way;
  const Path* of = nullptr;
  for (int i = 0; i < disc_count_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Disc& d = disc_[k];
    if (!ground_.present) {
      pose.depth[k] = 0;
      continue;
    }
    if (of != &path_[d.foot]) way = levers(pose, motion, *(of = &path_[d.foot]));
    pose.depth[k] = reach(pose, d, way);
    if (!(pose.depth[k] <= 0)) pose.contact[k] = disc_at(way, d, motion);
  }
}

template <int N, int D>
FrictionContacts<N, D>::FrictionContacts(const BodyConstants<N>& body, const robot::Robot& robot)
    : k_(body), ground_(robot.ground) {
  const std::size_t legs = std::max<std::size_t>(1, robot.legs.size());
  for (std::size_t leg = 0; leg < legs && leg < path_.size(); ++leg) add_foot(robot, leg);
}

template <int N, int D>
void FrictionContacts<N, D>::add_foot(const robot::Robot& robot, std::size_t leg) {
  foot_count_ = leg + 1;
  const robot::Foot& foot = robot::foot_of(robot, leg);
  const int last = robot::foot_link(robot, leg);
  if (last < 0) return;

  // Built from the foot inwards, then reversed.
  Path& path = path_[leg];
  const auto foot_link = static_cast<std::size_t>(last);
  double reach = k_.length[foot_link];
  for (std::size_t link = foot_link;; link = k_.on(link)) {
    path.link[path.count] = link;
    path.reach[path.count++] = reach;
    reach = k_.attachment[link];
    if (!k_.hangs_on_link(link)) break;
  }
  path.start = reach;
  const std::vector<robot::LegParts> legs = robot::legs_of(robot);
  path.first = path.count - std::min(path.count, legs[leg].joints.size());
  const auto n = static_cast<std::ptrdiff_t>(path.count);
  std::reverse(path.link.begin(), path.link.begin() + n);
  std::reverse(path.reach.begin(), path.reach.begin() + n);
  path.whole = path.count == k_.links();
  for (std::size_t k = 0; k < path.count; ++k) path.whole = path.whole && path.link[k] == k;

  if (!foot.present) return;
  const auto add = [&](double along, double across, double radius) {
    if (disc_count_ < D)
      disc_[static_cast<std::size_t>(disc_count_++)] = {
          leg, along, across, radius, foot.friction, robot.ground.height - foot.radius};
  };
  if (foot.points.empty()) add(k_.length[foot_link], 0, foot.radius);
  for (const robot::Foot::Point& p : foot.points) add(p.along, p.across, p.radius);
}

template <int N, int D>
FastestRates FrictionContacts<N, D>::fastest_rates(const Body<N>& body, const BodyState<N>& motion,
                                                   const robot::Robot& robot,
                                                   std::span<const double> of_muscles) const {
  FastestRates fastest;
  const auto per_force = [&](const Coordinates<N>& row) {
    return dot(k_, row, body.response(row));
  };
  const auto include = [&](double w, double damping, double stiffness) {
    fastest.include({.joints = std::max(damping * w, std::sqrt(stiffness * w))});
  };
  for (std::size_t j = 0; j < k_.links(); ++j) {
    const robot::Joint& joint = robot.joints[j];
    include(per_force(row(static_cast<int>(j))),
            joint.damping + joint.damper + joint.stop.damping + of_muscles[j],
            joint.spring + joint.stop.stiffness);
  }
  if (!k_.held[along_track])
    include(per_force(row(trolley)), robot.trolley.stop_damping, robot.trolley.stop_stiffness);
  if (!k_.held[up]) {
    fastest.lift = per_force(row(lift));
    include(fastest.lift, robot.cylinder.damping + robot.cylinder.stop_damping,
            robot.cylinder.stop_stiffness);
  }
  for (int i = 0; i < disc_count_ && ground_.present; ++i) {
    const double w = per_force(disc(body, motion, i).rise);
    fastest.include({.ground_spring = std::sqrt(ground_.normal_stiffness * w),
                     .ground_damper = ground_.normal_damping * w});
  }
  return fastest;
}

template <int N, int D>
Coordinates<N> FrictionContacts<N, D>::row(int c) const {
  Coordinates<N> j{};
  if (c == trolley) j[along_track] = 1;
  if (c == lift) j[up] = 1;
  if (c >= N || c >= static_cast<int>(k_.links())) return j;
  const auto link = static_cast<std::size_t>(c);
  j[first_link + link] = 1;
  if (k_.hangs_on_link(link)) j[first_link + k_.on(link)] = -1;
  return j;
}

template <int N, int D>
double FrictionContacts<N, D>::along(int c, const Coordinates<N>& row,
                                     const Coordinates<N>& v) const {
  if (c >= first_disc) return dot(k_, row, v);
  if (c == trolley) return v[along_track];
  if (c == lift) return v[up];
  const auto link = static_cast<std::size_t>(c);
  return v[first_link + link] - (k_.hangs_on_link(link) ? v[first_link + k_.on(link)] : 0.0);
}

// A disc that has left the ground still carries the force that it is given.
template <int N, int D>
Coordinates<N> FrictionContacts<N, D>::generalised(const Pose& pose, const BodyState<N>& motion,
                                                   const Forces& f) const {
  Coordinates<N> sum{};
  for (std::size_t j = 0; j < k_.links(); ++j) {
    sum[first_link + j] += f[j];
    if (k_.hangs_on_link(j)) sum[first_link + k_.on(j)] -= f[j];
  }
  sum[along_track] += f[trolley];
  sum[up] += f[lift];
  for (int i = 0; i < disc_count_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double force = f[first_disc + k];
    if (force == 0) continue;
    const auto add = [&](const DiscAt<N>& at) {
      for (std::size_t c = 0; c < k_.coordinates(); ++c) sum[c] += at.slip[c] * force;
    };
    if (!(pose.depth[k] <= 0))
      add(pose.contact[k]);
    else
      add(disc(pose, motion, i));
  }
  return sum;
}

template <int N, int D>
void FrictionContacts<N, D>::prepare(const Pose& pose, const BodyState<N>& motion,
                                     const Coordinates<N>& acceleration, const Forces& bound,
                                     const Normals& normal) {
  bound_ = bound;
  active_count_ = 0;
  touching_count_ = 0;
  std::array<Coordinates<N>, count> rows;
  const auto activate = [&](auto last_forced, int c, const Coordinates<N>& row, double bias) {
    const auto k = static_cast<std::size_t>(active_count_++);
    active_[k] = c;
    rows[k] = row;
    problem_.bound[k] = bound[static_cast<std::size_t>(c)];
    problem_.slip[k] = along(c, row, motion.rate);
    slip_rate_[k] = along(c, row, acceleration) + bias;
    column_[k] = pose.template response_up_to<last_forced>(rows[k]);
  };
  const auto has_friction = [&](int c) { return bound[static_cast<std::size_t>(c)] > 0; };
  using All = std::integral_constant<std::size_t, N + 1>;
  if constexpr (BodyConstants<N>::exact) {
    unroll<N>([&](auto joint) {
      constexpr int c = joint;
      if (has_friction(c))
        activate(std::integral_constant<std::size_t, first_link + c>{}, c, row(c), 0);
    });
  } else {
    for (int c = 0; c < static_cast<int>(k_.links()); ++c)
      if (has_friction(c)) activate(All{}, c, row(c), 0);
  }
  if (has_friction(trolley))
    activate(std::integral_constant<std::size_t, along_track>{}, trolley, row(trolley), 0);
  if (has_friction(lift)) activate(std::integral_constant<std::size_t, up>{}, lift, row(lift), 0);
  std::array<DiscAt<N>, D> discs;  // discs that touch
  for (int i = 0; i < disc_count_; ++i) {
    const double force = normal[static_cast<std::size_t>(i)];
    if (force <= 0) continue;
    DiscAt<N>& at = discs[touching_count_];
    at = pose.contact[static_cast<std::size_t>(i)];
    touching_[touching_count_] = i;
    normal_[touching_count_++] = force;
    if (has_friction(first_disc + i)) activate(All{}, first_disc + i, at.slip, at.slip_bias);
  }
  const auto n = static_cast<std::size_t>(active_count_);
  for (std::size_t d = 0; d < n; ++d)
    for (std::size_t c = d; c < n; ++c)
      problem_.response[d][c] = problem_.response[c][d] = along(active_[d], rows[d], column_[c]);

  for (std::size_t i = 0; i < touching_count_; ++i) {
    const DiscAt<N>& at = discs[i];
    const Coordinates<N> column = pose.response(at.rise);
    rise_row_[i] = at.rise;
    rise_column_[i] = column;
    rise_[i] = dot(k_, at.rise, motion.rate);
    rise_rate_[i] = dot(k_, at.rise, acceleration) + at.rise_bias;
    for (std::size_t k = 0; k < touching_count_; ++k)
      response_[k][i] = dot(k_, discs[k].rise, column);
    for (std::size_t c = 0; c < n; ++c) along_[i][c] = dot(k_, at.rise, column_[c]);
  }
}

// Eliminates the discs that touch (Gauss); the matrix is a unit matrix plus a positive one. Entries
// below the diagonal are the multipliers; those on the diagonal are the pivots' inverses.
template <int N, int D>
void FrictionContacts<N, D>::eliminate(Matrix& m) const {
  const std::size_t n = touching_count_;
  for (std::size_t i = 0; i < n; ++i) {
    m[i][i] = 1.0 / m[i][i];
    for (std::size_t k = i + 1; k < n; ++k) {
      const double share = m[k][i] * m[i][i];
      for (std::size_t j = i + 1; j < n; ++j) m[k][j] -= share * m[i][j];
      m[k][i] = share;
    }
  }
}

template <int N, int D>
void FrictionContacts<N, D>::solve(const Matrix& m, Normals& b) const {
  const std::size_t n = touching_count_;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) b[k] -= m[k][i] * b[i];
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] -= m[i][j] * b[j];
    b[i] *= m[i][i];
  }
}

// Inserts the ground's compliance within the step into slips, responses and bounds.
template <int N, int D>
template <class Count>
void FrictionContacts<N, D>::soften(double h, Count active, FrictionProblem<count>& p) const {
  const auto n = static_cast<std::size_t>(active);
  const std::size_t touching = touching_count_;
  const double k = ground_.normal_stiffness;
  const double beta = h * (h / 6.0 * k + 0.5 * ground_.normal_damping);
  Matrix m{};
  Normals change{};
  for (std::size_t i = 0; i < touching; ++i) {
    for (std::size_t j = 0; j < touching; ++j)
      m[i][j] = (i == j ? 1.0 : 0.0) + beta * response_[i][j];
    change[i] = -(0.5 * h * k * rise_[i] + beta * rise_rate_[i]);
  }
  eliminate(m);
  solve(m, change);

  std::array<bool, D> bears{};
  for (std::size_t i = 0; i < touching; ++i) {
    const double mean = normal_[i] + change[i];
    bears[i] = mean > 0;
    for (std::size_t c = 0; c < n; ++c)
      if (active_[c] == first_disc + touching_[i])
        p.bound[c] = bears[i] ? friction(static_cast<std::size_t>(touching_[i])) * mean : 0.0;
  }
  for (std::size_t c = 0; c < n; ++c) {
    Normals give{};  // change of the normal forces per friction force c, divided by -beta
    for (std::size_t i = 0; i < touching; ++i) give[i] = bears[i] ? along_[i][c] : 0.0;
    solve(m, give);
    for (std::size_t i = 0; i < touching; ++i) {
      if (!bears[i]) continue;
      p.slip[c] += h * along_[i][c] * change[i];
      const double given = h * beta * give[i];
      for (std::size_t d = 0; d < n; ++d) p.response[d][c] -= along_[i][d] * given;
    }
  }
}

template <int N, int D>
void FrictionContacts<N, D>::relax_touching(double time, const Normals& pushed,
                                            const Coordinates<N>& before, Coordinates<N>& a) const {
  const std::size_t n = touching_count_;
  const double damping = time * ground_.normal_damping;
  Coordinates<N> back;
  for (std::size_t c = 0; c < k_.coordinates(); ++c) back[c] = before[c] - a[c];
  Matrix m{};
  Normals force{};
  for (std::size_t i = 0; i < n; ++i) {
    m[i][i] = 1;
    const auto is_pushed = [&](std::size_t k) {
      return pushed[static_cast<std::size_t>(touching_[k])] > 0;
    };
    if (!is_pushed(i)) continue;
    force[i] = damping * dot(k_, rise_row_[i], back);
    for (std::size_t j = 0; j < n; ++j)
      if (is_pushed(j)) m[i][j] += damping * response_[i][j];
  }
  eliminate(m);
  solve(m, force);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < k_.coordinates(); ++c) a[c] += rise_column_[i][c] * force[i];
}

template <int N, int D>
auto FrictionContacts<N, D>::hold(double h, const Forces& last) const -> Forces {
  // A leg with an ankle: the usual numbers of contacts, as compile-time constants.
  if constexpr (N == 3 && D == 2) {
    if (active_count_ == 4) return hold_of(h, last, std::integral_constant<int, 4>{});
    if (active_count_ == 5) return hold_of(h, last, std::integral_constant<int, 5>{});
    if (active_count_ == 6) return hold_of(h, last, std::integral_constant<int, 6>{});
  }
  return hold_of(h, last, active_count_);
}

// Returns the friction forces of the step, for the given number of active contacts.
template <int N, int D>
template <class Count>
auto FrictionContacts<N, D>::hold_of(double h, const Forces& last, Count active) const -> Forces {
  const auto n = static_cast<std::size_t>(active);
  FrictionProblem<count> p;
  Forces before{};
  for (std::size_t c = 0; c < n; ++c) {
    before[c] = last[static_cast<std::size_t>(active_[c])];
    p.bound[c] = problem_.bound[c];
    p.slip[c] = problem_.slip[c] + h * slip_rate_[c];
    for (std::size_t d = 0; d < n; ++d) p.response[c][d] = h * problem_.response[c][d];
  }
  if (touching_count_ > 0) soften(h, active, p);
  const Forces solved = solve_friction<count>(p, before, active);
  Forces all{};
  for (std::size_t c = 0; c < n; ++c) all[static_cast<std::size_t>(active_[c])] = solved[c];
  return all;
}

template <int N, int D>
Coordinates<N> FrictionContacts<N, D>::accelerations(Coordinates<N> without,
                                                     const Forces& f) const {
  for (std::size_t c = 0; c < static_cast<std::size_t>(active_count_); ++c) {
    const double force = f[static_cast<std::size_t>(active_[c])];
    for (std::size_t i = 0; i < k_.coordinates(); ++i) without[i] += column_[c][i] * force;
  }
  return without;
}

}  // namespace sinew::plant
