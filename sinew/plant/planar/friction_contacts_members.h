// plant/planar/friction_contacts_members.h - the members of FrictionContacts, for the files that
// compile its sizes once.
#pragma once

#include <algorithm>
#include <cmath>

#include "sinew/plant/planar/friction_contacts.h"

namespace sinew::plant {

// Over the coordinates that the machine has.
template <int N>
double dot(const BodyConstants<N>& k, const Coordinates<N>& a, const Coordinates<N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < k.coordinates(); ++i) sum += a[i] * b[i];
  return sum;
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
double FrictionContacts<N, D>::stiffest_rate(const Body<N>& body, const BodyState<N>& motion,
                                             const robot::Robot& robot, bool on_ground) const {
  double fastest = 0;
  const auto consider = [&](const Coordinates<N>& row, double damping, double stiffness) {
    const double w = dot(k_, row, body.response(row));
    fastest = std::max({fastest, damping * w, std::sqrt(stiffness * w)});
  };
  for (std::size_t j = 0; j < k_.links(); ++j) {
    const robot::Joint& joint = robot.joints[j];
    consider(row(static_cast<int>(j)), joint.damping + joint.damper + joint.stop.damping,
             joint.spring + joint.stop.stiffness);
  }
  for (int i = 0; i < disc_count_ && ground_.present && on_ground; ++i)
    consider(disc(body, motion, i).rise, ground_.normal_damping, ground_.normal_stiffness);
  return fastest;
}

// Levers of a leg's links up to the last one, where its discs are.
template <int N, int D>
auto FrictionContacts<N, D>::levers(const Body<N>& body, const BodyState<N>& motion,
                                    const Path& path) const -> Levers {
  Levers way;
  way.height = motion.at[up];
  for (std::size_t k = 0; k + 1 < path.count; ++k) {
    way.x[k] = path.reach[k] * body.cos(path.link[k]);
    way.y[k] = path.reach[k] * body.sin(path.link[k]);
    way.height += way.y[k];
  }
  return way;
}

// The way goes on along the last link to a disc: returns how deep it is in the ground.
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
  DiscAt<N> at{};
  at.slip[along_track] = 1;
  at.rise[up] = 1;
  for (std::size_t k = 0; k < path.count; ++k) {
    const std::size_t link = first_link + path.link[k];
    const double rate2 = motion.rate[link] * motion.rate[link];
    at.slip[link] = -way.y[k];
    at.rise[link] = way.x[k];
    at.slip_bias -= way.x[k] * rate2;
    at.rise_bias -= way.y[k] * rate2;
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

// What carries a foot changes its rates by some 20 g at most: a tenth of a millimetre in a
// millisecond.
template <int N, int D>
bool FrictionContacts<N, D>::can_touch(const Pose& pose, const BodyState<N>& motion,
                                       double h) const {
  for (int i = 0; i < disc_count_ && ground_.present; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Disc& d = disc_[k];
    const Path& path = path_[d.foot];
    double rate = std::abs(motion.rate[up]) + 0.5 * (20.0 * k_.gravity) * h;
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
  const auto activate = [&](int c, const Coordinates<N>& row, double bias) {
    const auto k = static_cast<std::size_t>(active_count_++);
    active_[k] = c;
    rows[k] = row;
    problem_.bound[k] = bound[static_cast<std::size_t>(c)];
    problem_.slip[k] = along(c, row, motion.rate);
    slip_rate_[k] = along(c, row, acceleration) + bias;
    column_[k] = pose.response(rows[k]);
  };
  const auto rubs = [&](int c) { return bound[static_cast<std::size_t>(c)] > 0; };
  for (int c = 0; c < static_cast<int>(k_.links()); ++c)
    if (rubs(c)) activate(c, row(c), 0);
  for (const int c : {trolley, lift})
    if (rubs(c)) activate(c, row(c), 0);
  std::array<DiscAt<N>, D> discs;  // of those that touch
  for (int i = 0; i < disc_count_; ++i) {
    const double force = normal[static_cast<std::size_t>(i)];
    if (force <= 0) continue;
    DiscAt<N>& at = discs[touching_count_];
    at = pose.contact[static_cast<std::size_t>(i)];
    touching_[touching_count_] = i;
    normal_[touching_count_++] = force;
    if (rubs(first_disc + i)) activate(first_disc + i, at.slip, at.slip_bias);
  }
  const auto n = static_cast<std::size_t>(active_count_);
  for (std::size_t d = 0; d < n; ++d)
    for (std::size_t c = d; c < n; ++c)
      problem_.response[d][c] = problem_.response[c][d] = along(active_[d], rows[d], column_[c]);

  for (std::size_t i = 0; i < touching_count_; ++i) {
    const DiscAt<N>& at = discs[i];
    const Coordinates<N> column = pose.response(at.rise);
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
void FrictionContacts<N, D>::soften(double h, FrictionProblem<count>& p) const {
  const auto n = static_cast<std::size_t>(active_count_);
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
auto FrictionContacts<N, D>::hold(double h, const Forces& last) const -> Forces {
  const auto n = static_cast<std::size_t>(active_count_);
  FrictionProblem<count> p;
  Forces before{};
  for (std::size_t c = 0; c < n; ++c) {
    before[c] = last[static_cast<std::size_t>(active_[c])];
    p.bound[c] = problem_.bound[c];
    p.slip[c] = problem_.slip[c] + h * slip_rate_[c];
    for (std::size_t d = 0; d < n; ++d) p.response[c][d] = h * problem_.response[c][d];
  }
  if (touching_count_ > 0) soften(h, p);
  const Forces solved = solve_friction<count>(p, before, active_count_);
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
