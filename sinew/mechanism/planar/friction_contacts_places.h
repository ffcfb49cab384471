// mechanism/planar/friction_contacts_places.h - the members of FrictionContacts that say where its
// discs are and how the ground pushes them; friction_contacts_members.h has the others.
#pragma once

#include <cmath>

#include "sinew/mechanism/planar/friction_contacts.h"

namespace sinew::plant {

// Over the coordinates that the machine has.
template <int N>
double dot(const BodyConstants<N>& k, const Coordinates<N>& a, const Coordinates<N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < k.coordinates(); ++i) sum += a[i] * b[i];
  return sum;
}

// Levers of a leg's links up to the last one, where its discs are.
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

// What carries a foot changes its rates by some 20 g at most: a tenth of a millimetre in a
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

}  // namespace sinew::plant
