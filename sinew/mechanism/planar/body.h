// mechanism/planar/body.h - equations of motion of a planar tree of links under a trolley that
// slides and a body that a cylinder moves up and down: those of chain.h with one more coordinate.
//
//   q = (x_t, x_c, phi_1 ... phi_N)      trolley, lift, absolute link angles
//
//   M x_t'' - sum_i S_i sin(phi_i) phi_i''                  = F_x + sum_i S_i cos(phi_i) phi_i'^2
//   m_L x_c'' + sum_i S_i cos(phi_i) phi_i''      = F_y - m_L g   + sum_i S_i sin(phi_i) phi_i'^2
//   -S_i sin(phi_i) x_t'' + S_i cos(phi_i) x_c'' + sum_j I_ij cos(phi_i - phi_j) phi_j''
//                         = tau_i - g S_i cos(phi_i) - sum_j I_ij sin(phi_i - phi_j) phi_j'^2
//
//   S_i   first moment of link i and all links beyond it, about its joint   [kg m]
//   I_ij  l_ij S_j where j is beyond i, l_ij along i up to where the path to j leaves it; 0 where
//         neither is beyond the other: branches are joined at the body alone  [kg m^2]
//   I_ii  moment of inertia of link i about its joint, with links beyond it as points [kg m^2]
//   M     mass that slides [kg]    m_L  mass that is lifted [kg]    tau_i  generalised force [N m]
//
// A chain is the tree in which each link is at the end of the one before, with the same bits. A
// held coordinate (no trolley, locked cylinder) keeps its value with the acceleration 0. Links with
// only the body in common are coupled by x and y alone: the mass matrix is factored from the tips
// inwards, where each row has entries only with the coordinates that carry the link.
//
// N is the capacity for links; a small body has exactly N. If its links moreover form a chain on a
// trolley that moves, the code walks no tree, with the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"
#include "sinew/units/math.h"

namespace sinew::plant {

// Fully unrolled loops: compilers leave nested loops over matrices of three or four rows as
// loops, whose overhead exceeds their content.

// Visits 0 ... Count - 1, each as a constant of its own type.
template <std::size_t Count, class Visit>
[[gnu::always_inline]] constexpr void unroll(Visit visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit(std::integral_constant<std::size_t, I>{}), ...);
  }
  (std::make_index_sequence<Count>{});
}

// One number per coordinate: x, y, then the links.
template <int N>
using Coordinates = std::array<double, N + 2>;
enum Coordinate : std::size_t { along_track, up, first_link };

template <int N>
struct BodyConstants {
  // Bodies with so few links have exactly N.
  static constexpr bool exact = N <= 4;
  template <class T>
  using PerLink = std::array<T, N>;

  std::size_t count = N;                     // number of links
  PerLink<int> parent{};                     // link that carries this one; -1: the body
  PerLink<double> attachment{};              // along the parent, or ahead of the origin [m]
  PerLink<double> length{}, first_moment{};  // l [m], c [kg m]
  PerLink<double> hanging{};                 // mass of the link and all links that it carries [kg]
  PerLink<PerLink<double>> inertia{};        // A [kg m^2]
  double sliding_mass = 0, lifted_mass = 0;  // M, L [kg]
  double gravity = 9.80665;                  // [m/s^2]
  std::array<bool, 2> held{};                // x, y
  // Coordinate that carries this one: a link's parent; for a link on the body, the lift or the
  // track, if it moves; -1: no coordinate.
  std::array<int, N + 2> above{};
  bool chain = false;  // exact, and a chain of links on a trolley that moves

  constexpr std::size_t links() const { return exact ? N : count; }           // number of links
  constexpr std::size_t coordinates() const { return first_link + links(); }  // their number
  // Return the parent of a link that has one, and whether the link has a parent link.
  std::size_t on(std::size_t link) const { return static_cast<std::size_t>(parent[link]); }
  bool hangs_on_link(std::size_t link) const { return parent[link] >= 0; }
  // Returns the link on the body that carries this link, or the link itself.
  std::size_t first_on(std::size_t link) const {
    while (hangs_on_link(link)) link = on(link);
    return link;
  }
};

// Returns whether a body of N links can represent this robot.
template <int N>
bool fits(const robot::Robot& robot) {
  const std::size_t links = robot.links.size();
  return BodyConstants<N>::exact ? links == N : links <= N;
}

// Returns the constants. Requires parents before children (robot::contradictions) and
// holds<N>(robot).
template <int N>
BodyConstants<N> body_of(const robot::Robot& robot);

// The generalized state of a body: coordinates and their rates.
template <int N>
struct BodyState {
  Coordinates<N> at{}, rate{};
};

// Terms of the equations that depend on the motion, evaluated once and used for several right
// sides.
template <int N>
class Body {
 public:
  Body(const BodyConstants<N>& constants, const BodyState<N>& motion);  // both outlive it

  double sin(std::size_t link) const { return sin_[link]; }  // sine of the link's angle
  double cos(std::size_t link) const { return cos_[link]; }  // cosine

  // Returns the accelerations under these forces, gravity and the velocity terms.
  Coordinates<N> accelerations(Coordinates<N> force) const;

  // Returns the accelerations by the forces alone: the inverse mass matrix times `force`.
  Coordinates<N> response(const Coordinates<N>& force) const;

  // Returns the same, faster, if no force acts on coordinates after `Last`; the bits are the same.
  template <std::size_t Last>
  Coordinates<N> response_up_to(const Coordinates<N>& force) const;

 private:
  void factor();
  void factor_tree();
  Coordinates<N> response_of_tree(Coordinates<N> force) const;

  // Moving coordinates of a chain in order: all, or all except a lift that is held.
  template <bool Lifts>
  static constexpr std::size_t moving = N + (Lifts ? 2 : 1);
  template <bool Lifts>
  static constexpr std::size_t coordinate(std::size_t k) {
    return Lifts || k == along_track ? k : k + 1;
  }
  template <bool Lifts>
  void factor_chain();
  // `Forced`: number of moving coordinates up to the last one with a force.
  template <bool Lifts, std::size_t Forced = moving<Lifts>>
  Coordinates<N> response_of_chain(Coordinates<N> force) const;

  const BodyConstants<N>& k_;
  const BodyState<N>& motion_;
  // Set only for the coordinates that exist.
  std::array<double, N> sin_, cos_;
  std::array<Coordinates<N>, N + 2> lower_;  // rows by coordinate, entries with those that carry it
  Coordinates<N> inverse_pivot_;
};

// Returns kinetic plus potential energy [J], with zero potential at the origin.
template <int N>
double energy(const BodyConstants<N>& k, const BodyState<N>& motion);

// Returns the momentum of all moving masses, along the track and upwards [N s].
template <int N>
std::array<double, 2> momentum(const BodyConstants<N>& k, const BodyState<N>& motion);

// Returns the mass at the end of each link: that of its foot, if present [kg].
template <int N>
std::array<double, N> end_masses(const robot::Robot& robot) {
  std::array<double, N> out{};
  for (std::size_t leg = 0; leg < std::max<std::size_t>(1, robot.legs.size()); ++leg) {
    const int link = robot::foot_link(robot, leg);
    const robot::Foot& foot = robot::foot_of(robot, leg);
    if (foot.present && link >= 0) out[static_cast<std::size_t>(link)] += foot.mass;
  }
  return out;
}

template <int N>
BodyConstants<N> body_of(const robot::Robot& robot) {
  BodyConstants<N> k;
  k.count = robot.links.size();
  k.gravity = robot.gravity;
  k.hanging = end_masses<N>(robot);
  for (std::size_t i = 0; i < k.links(); ++i) {
    const robot::Link& link = robot.links[i];
    const double l = link.length, r = link.center_of_mass;
    k.parent[i] = robot::parent_of(robot, i);
    k.attachment[i] = robot::attachment_of(robot, i);
    k.length[i] = l;
    k.first_moment[i] = link.mass * r + l * k.hanging[i];
    k.inertia[i][i] = link.inertia + link.mass * r * r + l * l * k.hanging[i];
  }
  // Goes from the tips inwards, so that a link's load is complete before it is added to its parent.
  for (std::size_t i = k.links(); i-- > 0;) {
    k.hanging[i] += robot.links[i].mass;
    if (!k.hangs_on_link(i)) continue;
    const std::size_t p = k.on(i);
    const double at = k.attachment[i];
    k.first_moment[p] += at * k.hanging[i];
    k.inertia[p][p] += at * at * k.hanging[i];
    k.hanging[p] += k.hanging[i];
  }
  // Each link with all links that carry it, up to the body.
  for (std::size_t j = 0; j < k.links(); ++j)
    for (std::size_t child = j; k.hangs_on_link(child); child = k.on(child)) {
      const std::size_t i = k.on(child);
      k.inertia[i][j] = k.inertia[j][i] = k.attachment[child] * k.first_moment[j];
    }

  const bool lifts = robot.cylinder.present && robot.cylinder.mode != robot::Cylinder::Mode::locked;
  k.held = {!robot.trolley.present, !lifts};
  const int on_track = k.held[along_track] ? -1 : static_cast<int>(along_track);
  const int on_body = k.held[up] ? on_track : static_cast<int>(up);
  k.above[along_track] = -1;
  k.above[up] = k.held[up] ? -1 : on_track;
  for (std::size_t i = 0; i < k.links(); ++i)
    k.above[first_link + i] =
        k.hangs_on_link(i) ? k.parent[i] + static_cast<int>(first_link) : on_body;
  k.chain = BodyConstants<N>::exact && !k.held[along_track];
  for (std::size_t i = 0; i < k.links(); ++i)
    k.chain = k.chain && k.parent[i] == static_cast<int>(i) - 1;
  k.sliding_mass = robot.trolley.moving_mass();
  k.lifted_mass = robot::leg_mass(robot) + robot.cylinder.body_mass;
  return k;
}

template <int N>
Body<N>::Body(const BodyConstants<N>& constants, const BodyState<N>& motion)
    : k_(constants), motion_(motion) {
  for (std::size_t i = 0; i < k_.links(); ++i) {
    const units::SinCos sc = units::sin_cos(motion.at[first_link + i]);
    sin_[i] = sc.sin;
    cos_[i] = sc.cos;
  }
  factor();
}

template <int N>
void Body<N>::factor() {
  if constexpr (BodyConstants<N>::exact)
    if (k_.chain) return k_.held[up] ? factor_chain<false>() : factor_chain<true>();
  factor_tree();
}

// Factors the mass matrix as L^T D L, from the tips inwards: a coordinate has entries only with
// those that carry it, before and after. A held one has the row of a unit matrix.
template <int N>
void Body<N>::factor_tree() {
  const auto above = [this](std::size_t c) { return k_.above[c]; };
  lower_[along_track][along_track] = k_.held[0] ? 1.0 : k_.sliding_mass;
  lower_[up][up] = k_.held[1] ? 1.0 : k_.lifted_mass;
  lower_[up][along_track] = 0;
  for (std::size_t i = 0; i < k_.links(); ++i) {
    Coordinates<N>& row = lower_[first_link + i];
    row[first_link + i] = k_.inertia[i][i];
    std::size_t j = i;
    for (; k_.hangs_on_link(j); j = k_.on(j)) {
      const std::size_t on = k_.on(j);
      row[first_link + on] = k_.inertia[i][on] * (cos_[i] * cos_[on] + sin_[i] * sin_[on]);
    }
    row[along_track] = -k_.first_moment[i] * sin_[i];
    row[up] = k_.first_moment[i] * cos_[i];
  }
  for (std::size_t c = k_.coordinates(); c-- > 0;) {
    Coordinates<N>& row = lower_[c];
    inverse_pivot_[c] = 1.0 / row[c];
    for (int a = above(c); a >= 0; a = above(static_cast<std::size_t>(a))) {
      const auto i = static_cast<std::size_t>(a);
      const double share = row[i] * inverse_pivot_[c];
      for (int b = a; b >= 0; b = above(static_cast<std::size_t>(b)))
        lower_[i][static_cast<std::size_t>(b)] -= share * row[static_cast<std::size_t>(b)];
      row[i] = share;
    }
  }
}

// Does the work of factor_tree for a chain, where each coordinate is carried by all before it.
template <int N>
template <bool Lifts>
void Body<N>::factor_chain() {
  lower_[along_track][along_track] = k_.sliding_mass;
  lower_[up][up] = Lifts ? k_.lifted_mass : 1.0;
  lower_[up][along_track] = 0;
  if (!Lifts) inverse_pivot_[up] = 1.0;
  for (std::size_t i = 0; i < N; ++i) {
    Coordinates<N>& row = lower_[first_link + i];
    row[first_link + i] = k_.inertia[i][i];
    for (std::size_t on = 0; on < i; ++on)
      row[first_link + on] = k_.inertia[i][on] * (cos_[i] * cos_[on] + sin_[i] * sin_[on]);
    row[along_track] = -k_.first_moment[i] * sin_[i];
    row[up] = k_.first_moment[i] * cos_[i];
  }
  unroll<moving<Lifts>>([&](auto from_last) {
    constexpr std::size_t c = moving<Lifts> - 1 - from_last, at = coordinate<Lifts>(c);
    Coordinates<N>& row = lower_[at];
    const double inverse = 1.0 / row[at];
    inverse_pivot_[at] = inverse;
    unroll<c>([&](auto from_c) {
      constexpr std::size_t a = c - 1 - from_c, i = coordinate<Lifts>(a);
      const double share = row[i] * inverse;
      unroll<a + 1>(
          [&](auto b) { lower_[i][coordinate<Lifts>(b)] -= share * row[coordinate<Lifts>(b)]; });
      row[i] = share;
    });
  });
}

template <int N>
template <bool Lifts, std::size_t Forced>
Coordinates<N> Body<N>::response_of_chain(Coordinates<N> a) const {
  if (!Lifts) a[up] = 0;
  unroll<Forced>([&](auto from_last) {
    constexpr std::size_t c = Forced - 1 - from_last, at = coordinate<Lifts>(c);
    unroll<c>([&](auto k) {
      constexpr std::size_t i = coordinate<Lifts>(k);
      a[i] -= lower_[at][i] * a[at];
    });
  });
  unroll<moving<Lifts>>([&](auto c) {
    constexpr std::size_t at = coordinate<Lifts>(c);
    double one = a[at] * inverse_pivot_[at];
    unroll<c>([&](auto from_c) {
      constexpr std::size_t i = coordinate<Lifts>(c - 1 - from_c);
      one -= lower_[at][i] * a[i];
    });
    a[at] = one;
  });
  return a;
}

template <int N>
Coordinates<N> Body<N>::response(const Coordinates<N>& force) const {
  if constexpr (BodyConstants<N>::exact)
    if (k_.chain)
      return k_.held[up] ? response_of_chain<false>(force) : response_of_chain<true>(force);
  return response_of_tree(force);
}

template <int N>
template <std::size_t Last>
Coordinates<N> Body<N>::response_up_to(const Coordinates<N>& force) const {
  if constexpr (BodyConstants<N>::exact)
    if (k_.chain)
      return k_.held[up] ? response_of_chain<false, (Last > up ? Last : Last + 1)>(force)
                         : response_of_chain<true, Last + 1>(force);
  return response_of_tree(force);
}

template <int N>
Coordinates<N> Body<N>::response_of_tree(Coordinates<N> a) const {
  const std::size_t n = k_.coordinates();
  const auto above = [this](std::size_t c) { return k_.above[c]; };
  if (k_.held[0]) a[along_track] = 0;
  if (k_.held[1]) a[up] = 0;
  for (std::size_t c = n; c-- > 0;)
    for (int i = above(c); i >= 0; i = above(static_cast<std::size_t>(i)))
      a[static_cast<std::size_t>(i)] -= lower_[c][static_cast<std::size_t>(i)] * a[c];
  for (std::size_t c = 0; c < n; ++c) {
    a[c] *= inverse_pivot_[c];
    for (int i = above(c); i >= 0; i = above(static_cast<std::size_t>(i)))
      a[c] -= lower_[c][static_cast<std::size_t>(i)] * a[static_cast<std::size_t>(i)];
  }
  return a;
}

template <int N>
Coordinates<N> Body<N>::accelerations(Coordinates<N> force) const {
  force[up] -= k_.lifted_mass * k_.gravity;
  for (std::size_t i = 0; i < k_.links(); ++i) {
    const double rate = motion_.rate[first_link + i], rate2 = rate * rate;
    force[along_track] += k_.first_moment[i] * cos_[i] * rate2;
    force[up] += k_.first_moment[i] * sin_[i] * rate2;
    double& q = force[first_link + i];
    q -= k_.gravity * k_.first_moment[i] * cos_[i];
    const auto couple = [&](std::size_t on) {
      const double other = motion_.rate[first_link + on];
      const double turn = k_.inertia[i][on] * (sin_[i] * cos_[on] - cos_[i] * sin_[on]);
      q -= turn * (other * other);
      force[first_link + on] += turn * rate2;
    };
    if (BodyConstants<N>::exact && k_.chain)
      for (std::size_t on = i; on-- > 0;) couple(on);
    else
      for (std::size_t j = i; k_.hangs_on_link(j); j = k_.on(j)) couple(k_.on(j));
  }
  return response(force);
}

template <int N>
double energy(const BodyConstants<N>& k, const BodyState<N>& motion) {
  const double x = motion.rate[along_track], y = motion.rate[up];
  double e = 0.5 * k.sliding_mass * x * x + 0.5 * k.lifted_mass * y * y +
             k.lifted_mass * k.gravity * motion.at[up];
  for (std::size_t i = 0; i < k.links(); ++i) {
    const units::SinCos a = units::sin_cos(motion.at[first_link + i]);
    const double rate = motion.rate[first_link + i];
    e += k.first_moment[i] * (k.gravity * a.sin + rate * (y * a.cos - x * a.sin));
    for (std::size_t j = 0; j < k.links(); ++j) {
      const units::SinCos b = units::sin_cos(motion.at[first_link + j]);
      e += 0.5 * k.inertia[i][j] * (a.cos * b.cos + a.sin * b.sin) * rate *
           motion.rate[first_link + j];
    }
  }
  return e;
}

template <int N>
std::array<double, 2> momentum(const BodyConstants<N>& k, const BodyState<N>& motion) {
  std::array<double, 2> p{k.sliding_mass * motion.rate[along_track],
                          k.lifted_mass * motion.rate[up]};
  for (std::size_t i = 0; i < k.links(); ++i) {
    const units::SinCos a = units::sin_cos(motion.at[first_link + i]);
    const double m = k.first_moment[i] * motion.rate[first_link + i];
    p[0] -= m * a.sin;
    p[1] += m * a.cos;
  }
  return p;
}

}  // namespace sinew::plant
