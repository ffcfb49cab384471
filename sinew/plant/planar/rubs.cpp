#include "sinew/plant/planar/rubs.h"

#include <algorithm>
#include <cmath>

namespace sinew::plant {
namespace {

// Over the coordinates that the machine has.
double dot(const BodyConstants& k, const Coordinates& a, const Coordinates& b) {
  double sum = 0;
  for (std::size_t i = 0; i < k.coordinates(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Rubs::Rubs(const BodyConstants& body, const robot::Robot& robot) : k_(body), ground_(robot.ground) {
  const std::size_t legs = std::max<std::size_t>(1, robot.legs.size());
  for (std::size_t leg = 0; leg < legs && leg < path_.size(); ++leg) add_foot(robot, leg);
}

void Rubs::add_foot(const robot::Robot& robot, std::size_t leg) {
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
    if (disc_count_ < most_discs)
      disc_[static_cast<std::size_t>(disc_count_++)] = {
          leg, along, across, radius, foot.friction, robot.ground.height - foot.radius};
  };
  if (foot.points.empty()) add(k_.length[foot_link], 0, foot.radius);
  for (const robot::Foot::Point& p : foot.points) add(p.along, p.across, p.radius);
}

double Rubs::stiffest_rate(const Body& body, const Motion& motion,
                           const robot::Robot& robot) const {
  double fastest = 0;
  const auto consider = [&](const Coordinates& row, double damping, double stiffness) {
    const double w = dot(k_, row, body.response(row));
    fastest = std::max({fastest, damping * w, std::sqrt(stiffness * w)});
  };
  for (std::size_t j = 0; j < k_.links; ++j) {
    const robot::Joint& joint = robot.joints[j];
    consider(row(static_cast<int>(j), {}), joint.damping + joint.damper + joint.stop.damping,
             joint.spring + joint.stop.stiffness);
  }
  for (int i = 0; i < disc_count_ && ground_.present; ++i)
    consider(disc(body, motion, i).rise, ground_.normal_damping, ground_.normal_stiffness);
  return fastest;
}

DiscAt Rubs::disc(const Body& body, const Motion& motion, int i) const {
  const Disc& d = disc_[static_cast<std::size_t>(i)];
  const Path& path = path_[d.foot];
  DiscAt at;
  at.x = motion.at[along_track] + path.start;
  at.y = motion.at[up];
  at.slip[along_track] = 1;
  at.rise[up] = 1;
  for (std::size_t k = 0; k < path.count; ++k) {
    const std::size_t link = path.link[k];
    const bool last = k + 1 == path.count;
    const double a = last ? d.along : path.reach[k], b = last ? d.across : 0.0;
    const double dx = a * body.cos(link) - b * body.sin(link);
    const double dy = a * body.sin(link) + b * body.cos(link);
    const double rate = motion.rate[first_link + link];
    at.x += dx;
    at.y += dy;
    at.slip[first_link + link] = (last ? d.radius : 0.0) - dy;
    at.rise[first_link + link] = dx;
    at.slip_bias -= dx * rate * rate;
    at.rise_bias -= dy * rate * rate;
  }
  return at;
}

double Rubs::push(const DiscAt& disc, int i, const Motion& motion) const {
  if (!ground_.present) return 0;
  const Disc& d = disc_[static_cast<std::size_t>(i)];
  const double depth = d.surface + d.radius - disc.y;
  if (depth <= 0) return 0;
  const double rate = dot(k_, disc.rise, motion.rate);
  const double force = ground_.normal_stiffness * depth - ground_.normal_damping * rate;
  return force > 0 ? force : 0.0;
}

Coordinates Rubs::row(int c, const std::array<DiscAt, most_discs>& discs) const {
  if (c >= first_disc) return discs[static_cast<std::size_t>(c - first_disc)].slip;
  Coordinates j{};
  if (c == trolley) j[along_track] = 1;
  if (c == lift) j[up] = 1;
  if (c >= most_links || c >= static_cast<int>(k_.links)) return j;
  const auto link = static_cast<std::size_t>(c);
  j[first_link + link] = 1;
  if (k_.hangs_on_link(link)) j[first_link + k_.on(link)] = -1;
  return j;
}

Coordinates Rubs::generalised(const Body& body, const Motion& motion, const Forces& f) const {
  std::array<DiscAt, most_discs> discs;
  for (int i = 0; i < disc_count_; ++i)
    if (f[static_cast<std::size_t>(first_disc + i)] != 0)
      discs[static_cast<std::size_t>(i)] = disc(body, motion, i);
  Coordinates sum{};
  for (int c = 0; c < count; ++c) {
    const double force = f[static_cast<std::size_t>(c)];
    if (force == 0) continue;
    const Coordinates j = row(c, discs);
    for (std::size_t i = 0; i < k_.coordinates(); ++i) sum[i] += j[i] * force;
  }
  return sum;
}

void Rubs::prepare(const Body& body, const Motion& motion, const Coordinates& acceleration,
                   const Forces& bound, const Normals& normal) {
  std::array<DiscAt, most_discs> discs;
  for (int i = 0; i < disc_count_; ++i) discs[static_cast<std::size_t>(i)] = disc(body, motion, i);

  bound_ = bound;
  normal_ = normal;
  active_count_ = 0;
  std::array<Coordinates, count> rows;
  for (int c = 0; c < count; ++c) {
    if (!(bound[static_cast<std::size_t>(c)] > 0)) continue;
    const auto k = static_cast<std::size_t>(active_count_++);
    active_[k] = c;
    rows[k] = row(c, discs);
    problem_.bound[k] = bound[static_cast<std::size_t>(c)];
    problem_.slip[k] = dot(k_, rows[k], motion.rate);
    slip_rate_[k] = dot(k_, rows[k], acceleration);
    if (c >= first_disc) slip_rate_[k] += discs[static_cast<std::size_t>(c - first_disc)].slip_bias;
    column_[k] = body.response(rows[k]);
  }
  const auto n = static_cast<std::size_t>(active_count_);
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t d = 0; d < n; ++d) problem_.response[d][c] = dot(k_, rows[d], column_[c]);

  for (std::size_t i = 0; i < discs_there(); ++i) {
    if (normal[i] <= 0) continue;
    const DiscAt& at = discs[i];
    const Coordinates column = body.response(at.rise);
    rise_[i] = dot(k_, at.rise, motion.rate);
    rise_rate_[i] = dot(k_, at.rise, acceleration) + at.rise_bias;
    for (std::size_t k = 0; k < discs_there(); ++k)
      response_[k][i] = normal[k] > 0 ? dot(k_, discs[k].rise, column) : 0.0;
    for (std::size_t c = 0; c < n; ++c) along_[i][c] = dot(k_, at.rise, column_[c]);
  }
}

// Gaussian elimination of the discs that touch; the matrix is a unit matrix plus a positive one.
Rubs::Normals Rubs::solve(Matrix m, Normals b) const {
  for (std::size_t i = 0; i < discs_there(); ++i)
    for (std::size_t k = i + 1; k < discs_there(); ++k) {
      const double share = m[k][i] / m[i][i];
      for (std::size_t j = i; j < discs_there(); ++j) m[k][j] -= share * m[i][j];
      b[k] -= share * b[i];
    }
  for (std::size_t i = discs_there(); i-- > 0;) {
    for (std::size_t j = i + 1; j < discs_there(); ++j) b[i] -= m[i][j] * b[j];
    b[i] /= m[i][i];
  }
  return b;
}

// The ground's give within the step, put into slips, responses and bounds.
void Rubs::soften(double h, FrictionProblem<count>& p) const {
  const auto n = static_cast<std::size_t>(active_count_);
  const double k = ground_.normal_stiffness;
  const double beta = h * (h / 6.0 * k + 0.5 * ground_.normal_damping);
  Matrix m{};
  Normals change{};
  for (std::size_t i = 0; i < discs_there(); ++i) {
    m[i][i] = 1.0;
    if (normal_[i] <= 0) continue;
    for (std::size_t j = 0; j < discs_there(); ++j)
      if (normal_[j] > 0) m[i][j] += beta * response_[i][j];
    change[i] = -(0.5 * h * k * rise_[i] + beta * rise_rate_[i]);
  }
  change = solve(m, change);

  std::array<bool, most_discs> bears{};
  for (std::size_t i = 0; i < discs_there(); ++i) {
    const double mean = normal_[i] + change[i];
    bears[i] = normal_[i] > 0 && mean > 0;
    for (std::size_t c = 0; c < n; ++c)
      if (active_[c] == first_disc + static_cast<int>(i))
        p.bound[c] = bears[i] ? disc_[i].friction * mean : 0.0;
  }
  for (std::size_t c = 0; c < n; ++c) {
    Normals give{};  // change of the normal forces per friction force c, divided by -beta
    for (std::size_t i = 0; i < discs_there(); ++i) give[i] = bears[i] ? along_[i][c] : 0.0;
    give = solve(m, give);
    for (std::size_t i = 0; i < discs_there(); ++i) {
      if (!bears[i]) continue;
      p.slip[c] += h * along_[i][c] * change[i];
      for (std::size_t d = 0; d < n; ++d) p.response[d][c] -= h * beta * along_[i][d] * give[i];
    }
  }
}

Rubs::Forces Rubs::hold(double h, const Forces& last) const {
  const auto n = static_cast<std::size_t>(active_count_);
  FrictionProblem<count> p;
  Forces before;
  for (std::size_t c = 0; c < n; ++c) {
    before[c] = last[static_cast<std::size_t>(active_[c])];
    p.bound[c] = problem_.bound[c];
    p.slip[c] = problem_.slip[c] + h * slip_rate_[c];
    for (std::size_t d = 0; d < n; ++d) p.response[c][d] = h * problem_.response[c][d];
  }
  bool touches = false;
  for (const double force : normal_) touches = touches || force > 0;
  if (touches) soften(h, p);
  const Forces solved = solve_friction<count>(p, before, active_count_);
  Forces all{};
  for (std::size_t c = 0; c < n; ++c) all[static_cast<std::size_t>(active_[c])] = solved[c];
  return all;
}

Coordinates Rubs::accelerations(Coordinates without, const Forces& f) const {
  for (std::size_t c = 0; c < static_cast<std::size_t>(active_count_); ++c) {
    const double force = f[static_cast<std::size_t>(active_[c])];
    for (std::size_t i = 0; i < k_.coordinates(); ++i) without[i] += column_[c][i] * force;
  }
  return without;
}

}  // namespace sinew::plant
