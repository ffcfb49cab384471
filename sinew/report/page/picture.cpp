#include "sinew/report/page/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>

#include "sinew/analysis/record/machine.h"
#include "sinew/config/compose.h"
#include "sinew/report/page/channels.h"
#include "sinew/report/page/scene.h"
#include "sinew/robot/legs.h"

namespace sinew::report {
namespace {

// Colors for light and dark backgrounds.
constexpr const char* metal = "#8a95a5";
constexpr const char* muscle_color = "#2f86c5";
constexpr const char* tendon_color = "#6d7988";

// An SVG drawing with y upwards, which records its extent  [m].
class Drawing {
 public:
  void line(robot::Point a, robot::Point b, double width, const char* color) {
    reach(a, width / 2);
    reach(b, width / 2);
    text_ +=
        fmt::format(R"(<path d="M{:.4f} {:.4f}L{:.4f} {:.4f}" stroke="{}" stroke-width="{:.4f}"/>)",
                    a.x, -a.y, b.x, -b.y, color, width);
  }
  void disc(robot::Point center, double radius, const char* color) {
    reach(center, radius);
    text_ += fmt::format(R"(<circle cx="{:.4f}" cy="{:.4f}" r="{:.4f}" fill="{}"/>)", center.x,
                         -center.y, radius, color);
  }

  // Returns a square picture with a margin.
  std::string svg() const {
    const double side = 1.12 * std::max({high_.x - low_.x, high_.y - low_.y, 1e-3});
    const double x = (low_.x + high_.x - side) / 2, y = -(low_.y + high_.y + side) / 2;
    return fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="{:.4f} {:.4f} {:.4f} {:.4f}" fill="none" stroke-linecap="round">{}</svg>)",
        x, y, side, side, text_);
  }

 private:
  void reach(robot::Point p, double by) {
    low_ = {std::min(low_.x, p.x - by), std::min(low_.y, p.y - by)};
    high_ = {std::max(high_.x, p.x + by), std::max(high_.y, p.y + by)};
  }

  std::string text_;
  robot::Point low_{1e9, 1e9}, high_{-1e9, -1e9};
};

// --- the machine in its initial pose ---

// Returns the angle at which the experiment starts a joint, or else its rest angle  [rad].
double start_angle(const config::Node& resolved, const robot::Joint& joint) {
  const config::Node* node = resolved.find("start");
  for (const std::string& key : {std::string("joint_angles"), joint.name})
    if (node != nullptr) node = node->find(key);
  if (node != nullptr && node->is_value_table()) node = node->find("value");
  double angle = joint.rest_angle;
  if (node != nullptr && node->text.ends_with(" rad"))
    std::from_chars(node->text.data(), node->text.data() + node->text.size(), angle);
  return angle;
}

// Returns a log with a single row.
signals::Table first_row(const config::Node& resolved, const analysis::Machine& machine) {
  signals::Table out;
  for (const robot::Joint& joint : machine.robot.joints) {
    signals::Series s{{robot::logged_topic(machine.robot, "/joint/" + joint.name + "/angle"),
                       "",
                       {{"value", "rad"}}},
                      {},
                      std::vector<signals::Column>(1)};
    s.time_ns.push_back(0);
    s.columns[0].push_back(start_angle(resolved, joint));
    out.series.push_back(std::move(s));
  }
  return out;
}

// Positions in the frames of a scene at its first row.
class FramePoses {
 public:
  FramePoses(const Scene& scene, const signals::Table& drawn) : scene_(scene) {
    channels_.add(drawn);
  }
  double value(const Channel& channel, double otherwise = 0) const {
    const Samples samples = channels_.find(channel);
    return samples ? (*samples.values)[0] : otherwise;
  }
  robot::Point at(int frame, robot::Point p) const {
    const Frame& f = scene_.frames[static_cast<std::size_t>(frame)];
    const double turn = value(f.heading), c = std::cos(turn), s = std::sin(turn);
    return {value(f.x) + c * p.x - s * p.y, value(f.y) + s * p.x + c * p.y};
  }

 private:
  const Scene& scene_;
  Channels channels_;
};

void draw_links(Drawing& out, const Scene& scene, const FramePoses& places, double thick) {
  if (scene.track) {
    const Track& t = *scene.track;
    const double y = t.height;
    out.line(places.at(0, {t.rear, y}), places.at(0, {t.front, y}), 1.6 * thick, metal);
  }
  for (const LinkShape& link : scene.links)
    out.line(places.at(link.frame, {0, 0}), places.at(link.frame, {link.length, 0}), thick, metal);
  for (const LinkShape& link : scene.links)
    out.disc(places.at(link.frame, {0, 0}), 0.9 * thick, tendon_color);
  for (const Disc& disc : scene.discs)
    out.disc(places.at(disc.frame, disc.center), disc.radius, tendon_color);
}

void draw_muscles(Drawing& out, const Scene& scene, const FramePoses& places, double thick) {
  for (const TendonShape& tendon : scene.tendons)
    out.line(places.at(tendon.frame, tendon.from), places.at(tendon.frame, tendon.to), 0.15 * thick,
             tendon_color);
  for (const MuscleShape& m : scene.muscles) {
    const double length = places.value(m.length, m.longest);
    const robot::Point end{m.anchor.x + length * m.direction.x,
                           m.anchor.y + length * m.direction.y};
    out.line(places.at(m.frame, m.anchor), places.at(m.frame, m.touch), 0.15 * thick, tendon_color);
    out.line(places.at(m.frame, m.anchor), places.at(m.frame, end),
             std::max(0.45 * thick, places.value(m.diameter)), muscle_color);
  }
}

std::string picture_of_robot(const config::Node& resolved) {
  const analysis::Machine machine = analysis::read_machine(resolved);
  const signals::Table row = first_row(resolved, machine);
  const analysis::Record record(row, machine);
  Channels channels;
  channels.add(row);
  signals::Table drawn;
  const Scene scene = report::scene(channels, machine, record, drawn);
  if (scene.empty()) return "";
  const FramePoses places(scene, drawn);
  double longest = 0.05;
  for (const LinkShape& link : scene.links) longest = std::max(longest, link.length);
  Drawing out;
  draw_links(out, scene, places, 0.11 * longest);
  draw_muscles(out, scene, places, 0.11 * longest);
  return out.svg();
}

// --- fixed pictures ---

// Draws a muscle on its beam, with a hanging load.
std::string picture_of_stand() {
  Drawing out;
  out.line({-4, 9}, {4, 9}, 0.8, metal);
  out.line({0, 9}, {0, -5}, 0.25, tendon_color);
  out.line({0, 6.5}, {0, -1.5}, 2.4, muscle_color);
  out.line({-1.6, -5.4}, {1.6, -5.4}, 1.2, metal);
  out.line({-2.4, -7.2}, {2.4, -7.2}, 1.2, metal);
  return out.svg();
}

std::string picture_of_recording() {
  Drawing out;
  out.line({0, 0}, {12, 0}, 0.3, metal);
  out.line({0, 0}, {0, 8}, 0.3, metal);
  robot::Point before{0.5, 4};
  for (double x = 0.8; x < 11.5; x += 0.3) {
    const robot::Point next{x, 4 + 2.6 * std::sin(0.9 * x) * std::exp(-0.1 * x)};
    out.line(before, next, 0.5, muscle_color);
    before = next;
  }
  return out.svg();
}

}  // namespace

std::string picture(const config::Node& resolved) {
  if (resolved.find("element")) return picture_of_stand();
  try {
    if (std::string drawn = picture_of_robot(resolved); !drawn.empty()) return drawn;
  } catch (const std::exception&) {
    // The file does not describe a machine that can be drawn; the curve is used instead.
  }
  return picture_of_recording();
}

}  // namespace sinew::report
