// mechanism/planar/friction_contacts_members.h - the members of FrictionContacts, for the files
// that compile its sizes once.
#pragma once

#include <algorithm>
#include <cmath>

#include "sinew/mechanism/planar/friction_contacts.h"
#include "sinew/mechanism/planar/friction_contacts_places.h"

namespace sinew::plant {

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

  // From the foot inwards, then turned round.
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
                                                   const robot::Robot& robot) const {
  FastestRates fastest;
  const auto per_force = [&](const Coordinates<N>& row) {
    return dot(k_, row, body.response(row));
  };
  const auto include = [&](double w, double damping, double stiffness) {
    fastest.include({.joints = std::max(damping * w, std::sqrt(stiffness * w))});
  };
  for (std::size_t j = 0; j < k_.links(); ++j) {
    const robot::Joint& joint = robot.joints[j];
    include(per_force(row(static_cast<int>(j))), joint.damping + joint.damper + joint.stop.damping,
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

// A disc that has left the ground carries what it is given all the same.
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
  const auto rubs = [&](int c) { return bound[static_cast<std::size_t>(c)] > 0; };
  using All = std::integral_constant<std::size_t, N + 1>;
  if constexpr (BodyConstants<N>::exact) {
    unroll<N>([&](auto joint) {
      constexpr int c = joint;
      if (rubs(c)) activate(std::integral_constant<std::size_t, first_link + c>{}, c, row(c), 0);
    });
  } else {
    for (int c = 0; c < static_cast<int>(k_.links()); ++c)
      if (rubs(c)) activate(All{}, c, row(c), 0);
  }
  if (rubs(trolley))
    activate(std::integral_constant<std::size_t, along_track>{}, trolley, row(trolley), 0);
  if (rubs(lift)) activate(std::integral_constant<std::size_t, up>{}, lift, row(lift), 0);
  std::array<DiscAt<N>, D> discs;  // of those that touch
  for (int i = 0; i < disc_count_; ++i) {
    const double force = normal[static_cast<std::size_t>(i)];
    if (force <= 0) continue;
    DiscAt<N>& at = discs[touching_count_];
    at = pose.contact[static_cast<std::size_t>(i)];
    touching_[touching_count_] = i;
    normal_[touching_count_++] = force;
    if (rubs(first_disc + i)) activate(All{}, first_disc + i, at.slip, at.slip_bias);
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

// Gaussian elimination of the discs that touch; the matrix is a unit matrix plus a positive one.
// What is below the diagonal are the shares by which rows were taken from others; on it are the
// pivots' inverses.
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

// The ground's give within the step, put into slips, responses and bounds.
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
  // A leg with an ankle: the usual numbers of contacts, known to the compiler.
  if constexpr (N == 3 && D == 2) {
    if (active_count_ == 4) return hold_of(h, last, std::integral_constant<int, 4>{});
    if (active_count_ == 5) return hold_of(h, last, std::integral_constant<int, 5>{});
    if (active_count_ == 6) return hold_of(h, last, std::integral_constant<int, 6>{});
  }
  return hold_of(h, last, active_count_);
}

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
