#include "sinew/report/page/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "sinew/actuator/braid.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/legs.h"

namespace sinew::report {

namespace {

using analysis::Column;
using analysis::Record;
using robot::Point;

Column constant(double value, const Record& record) {
  Column out = record.new_column();
  out.assign(record.rows(), value);
  return out;
}

Column or_zeros(Column values, const Record& record) {
  return values.empty() ? constant(0, record) : values;
}

Column first_of(const Record& record, std::initializer_list<const char*> topics) {
  for (const char* topic : topics)
    if (Column found = record.column(topic); !found.empty()) return found;
  return {};
}

// Pose of the machine at every row of a log.
struct Poses {
  std::vector<Column> angle;  // angle of every joint [rad]; empty if unknown
  Column trolley, lift;       // x and y of the body [m]; zeros if it is fixed
  bool is_true = false;       // true angles, not measured ones

  // Returns whether the log has the pose.
  bool known() const { return !angle.empty(); }
};

// Returns the poses, from the true angles if the log has them, else from measured ones. A joint
// without a measured angle stays at its rest angle if another joint has one.
Poses poses(const analysis::Machine& machine, const Record& record) {
  Poses out;
  std::vector<Column> angle;
  bool any = false;
  for (const robot::Joint& joint : machine.robot.joints) {
    const std::string measured = "/joint/" + joint.name + "/angle";
    Column at = record.column("/true" + measured);
    if (!at.empty()) out.is_true = true;
    if (at.empty()) at = record.column(measured);
    any = any || !at.empty();
    if (at.empty()) at = constant(joint.rest_angle, record);
    angle.push_back(std::move(at));
  }
  if (!any) return {};
  out.angle = std::move(angle);
  out.trolley = or_zeros(first_of(record, {"/true/trolley/position", "/trolley/position"}), record);
  out.lift = or_zeros(first_of(record, {"/true/cylinder/position", "/cylinder/position"}), record);
  return out;
}

// Adds a series at the record's rows to `drawn`.
Channel draw(signals::Table& drawn, const analysis::Record& record, const std::string& name,
             const std::string& unit, Column values) {
  drawn.series.push_back(
      {{"/draw/" + name, "", {{"value", unit}}}, record.time_ns(), {std::move(values)}});
  return {"/draw/" + name};
}

struct Maker {
  const Channels& channels;
  const analysis::Machine& machine;
  const analysis::Record& record;
  signals::Table& drawn;
  Poses poses;
  Scene out{};

  const robot::Robot& robot() const { return machine.robot; }
  Channel series(const std::string& name, const std::string& unit, Column values) {
    return draw(drawn, record, name, unit, std::move(values));
  }
  Channel logged(const std::string& topic) const {
    return channels.first_of({robot::logged_topic(robot(), topic)});
  }
  std::vector<double> angles_at(std::size_t row) const {
    std::vector<double> out_angles;
    for (const Column& c : poses.angle) out_angles.push_back(c[row]);
    return out_angles;
  }
};

// --- frames -------------------------------------------------------------------------------------

void add_frames(Maker& m) {
  m.out.frames.push_back({"body",
                          m.series("body/x", "m", m.poses.trolley),
                          m.series("body/y", "m", m.poses.lift),
                          {}});
  const std::size_t n = std::min(m.robot().links.size(), m.robot().joints.size());
  std::vector<Column> x(n, m.record.new_column()), y = x, heading = x;
  for (std::size_t row = 0; row < m.record.rows(); ++row) {
    const std::vector<double> angles = m.angles_at(row);
    const std::vector<robot::LinkPlace> places = robot::places(m.robot(), angles);
    for (std::size_t k = 0; k < n; ++k) {
      x[k].push_back(m.poses.trolley[row] + places[k].joint.x);
      y[k].push_back(m.poses.lift[row] + places[k].joint.y);
      heading[k].push_back(places[k].heading);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const robot::Link& link = m.robot().links[k];
    const std::string at = link.name + "/";
    m.out.frames.push_back({link.name, m.series(at + "x", "m", std::move(x[k])),
                            m.series(at + "y", "m", std::move(y[k])),
                            m.series(at + "heading", "rad", std::move(heading[k]))});
    m.out.links.push_back({static_cast<int>(k) + 1, link.length});
  }
}

// --- muscles ------------------------------------------------------------------------------------

// Returns the outline of a muscle's cam at a joint, in the distal link's frame: the radius at each
// direction is the moment arm at the joint's angle from rest.
std::vector<Point> outline(const robot::Muscle& muscle, const robot::Joint& joint) {
  constexpr int corners = 48;
  std::vector<Point> out;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / corners;
    const double around = std::remainder(turn, 2.0 * std::numbers::pi);
    const double r = std::abs(robot::moment_arm_at(muscle, joint, joint.rest_angle + around));
    out.push_back({r * std::cos(turn), r * std::sin(turn)});
  }
  return out;
}

double reach(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max(largest, std::hypot(p.x, p.y));
  return largest;
}

void add_cams(Maker& m) {
  for (std::size_t j = 0; j < m.robot().joints.size(); ++j) {
    CamShape cam{.frame = static_cast<int>(j) + 1, .outline = {}};
    for (const robot::Muscle& muscle : m.robot().muscles) {
      std::vector<Point> points = outline(muscle, m.robot().joints[j]);
      if (reach(points) > reach(cam.outline)) cam.outline = std::move(points);
    }
    if (!cam.outline.empty()) m.out.cams.push_back(std::move(cam));
  }
}

Column lengths(const Maker& m, const robot::Muscle& muscle) {
  Column logged = m.record.column("/true/muscle/" + muscle.name + "/length");
  if (!logged.empty()) return logged;
  Column out = m.record.new_column();
  for (std::size_t row = 0; row < m.record.rows(); ++row)
    out.push_back(robot::muscle_length(m.robot(), muscle, m.angles_at(row)));
  return out;
}

// Returns the unit vector perpendicular to `along`, on the side of a tendon with that moment arm.
Point side_of(Point along, double pull) {
  const double sign = pull < 0 ? -1.0 : 1.0;
  return {sign * along.y, -sign * along.x};
}

Point plus(Point a, Point b, double times) { return {a.x + times * b.x, a.y + times * b.y}; }

// Position of a joint in its proximal frame, and the direction from it back along the link.
struct JointMount {
  int frame = 0;
  Point joint, back;
  double room = 0;  // length available along the link [m]; 0: unlimited
};
JointMount joint_mount_at(const robot::Robot& robot, std::size_t j) {
  const int parent = robot::parent_of(robot, j);
  const double at = robot::attachment_of(robot, j);
  if (parent < 0) return {0, {at, 0}, {0, 1}, 0};
  return {parent + 1, {at, 0}, {-1, 0}, at};
}

double rest_pull(const robot::Muscle& muscle, const robot::Joint& joint) {
  return robot::moment_arm_at(muscle, joint, joint.rest_angle);
}

// Places a muscle of one joint: its tendon leaves the cam along the proximal link.
void place(MuscleShape& shape, const robot::Robot& robot, const robot::Muscle& muscle,
           std::size_t joint) {
  const JointMount seat = joint_mount_at(robot, joint);
  const double arm = rest_pull(muscle, robot.joints[joint]);
  const double r = std::abs(arm);
  shape.frame = seat.frame;
  shape.touch = plus(seat.joint, side_of(seat.back, arm), r);
  const double away = std::max(shape.longest + 0.6 * r, seat.room - 1.6 * r);
  shape.anchor = plus(shape.touch, seat.back, away);
  shape.direction = {-seat.back.x, -seat.back.y};
}

// Places a muscle of two joints along the link between them, from cam to cam, with a tendon that
// continues beyond the first joint.
void place_across(MuscleShape& shape, Maker& m, const robot::Muscle& muscle, std::size_t first,
                  std::size_t second) {
  const robot::Robot& robot = m.robot();
  const JointMount seat = joint_mount_at(robot, second);
  const double near = rest_pull(muscle, robot.joints[first]);
  const double far = rest_pull(muscle, robot.joints[second]);
  const Point start = plus({}, side_of(seat.back, near), std::abs(near));
  shape.frame = seat.frame;
  shape.touch = plus(seat.joint, side_of(seat.back, far), std::abs(far));
  const double span = std::hypot(shape.touch.x - start.x, shape.touch.y - start.y);
  shape.direction = {(shape.touch.x - start.x) / span, (shape.touch.y - start.y) / span};
  const double before = std::max(0.0, 0.5 * (span - shape.longest));
  shape.anchor = plus(start, shape.direction, before);
  m.out.tendons.push_back({seat.frame, start, shape.anchor});
  const JointMount origin = joint_mount_at(robot, first);
  const Point leaves = plus(origin.joint, side_of(origin.back, near), std::abs(near));
  m.out.tendons.push_back({origin.frame, leaves, plus(leaves, origin.back, 2.0 * std::abs(near))});
}

void add_muscle(Maker& m, const robot::Muscle& muscle) {
  const int first = robot::find_joint(m.robot(), muscle.joint);
  const int second = robot::find_joint(m.robot(), muscle.second.joint);
  const std::string at = "/muscle/" + muscle.name + "/", valve = "/valve/" + muscle.name + "/";
  const actuator::Actuator a = robot::actuator_of(muscle, m.machine.actuators);

  Column length = lengths(m, muscle), diameter = m.record.new_column();
  MuscleShape shape{.name = muscle.name, .count = std::max(1, muscle.count)};
  for (const double l : length) {
    if (std::isfinite(l)) shape.longest = std::max(shape.longest, l);
    diameter.push_back(actuator::diameter(a.braid, l));
  }
  const auto near = static_cast<std::size_t>(std::max(std::min(first, second), 0));
  const auto far = static_cast<std::size_t>(std::max(first, second));
  const bool neighbours = second >= 0 && robot::parent_of(m.robot(), far) == static_cast<int>(near);
  if (neighbours)
    place_across(shape, m, muscle, near, far);
  else
    place(shape, m.robot(), muscle, static_cast<std::size_t>(first));
  shape.length = m.series(at.substr(1) + "length", "m", std::move(length));
  shape.diameter = m.series(at.substr(1) + "diameter", "m", std::move(diameter));
  shape.pressure = m.logged("/true" + at + "pressure");
  shape.inlet = m.logged(valve + "inlet/open");
  shape.exhaust = m.logged(valve + "exhaust/open");
  m.out.muscles.push_back(std::move(shape));
}

// --- feet, track and cylinder -------------------------------------------------------------------

// Adds the discs of a leg's foot; a single disc is at the end of the second link of a leg with an
// ankle, else at the end of the last link.
void add_discs(Maker& m, std::size_t leg) {
  const robot::Foot& foot = robot::foot_of(m.robot(), leg);
  const int last = robot::foot_link(m.robot(), leg);
  if (!foot.present || last < 0 || m.out.links.empty()) return;
  const LinkShape& link = m.out.links[static_cast<std::size_t>(last)];
  for (const robot::Foot::Point& p : foot.points)
    m.out.discs.push_back({link.frame, {p.along, p.across}, p.radius});
  const bool one = robot::is_leg(robot::only_leg(m.robot(), leg));
  const robot::LegParts parts = robot::legs_of(m.robot())[leg];
  const LinkShape& end = one ? m.out.links[static_cast<std::size_t>(parts.joints[1])] : link;
  if (foot.points.empty()) m.out.discs.push_back({end.frame, {end.length, 0}, foot.radius});
  if (m.robot().ground.present) m.out.surface = m.robot().ground.height - foot.radius;
}

// Adds the track. Without rollers in the file their distance is 0.9 times the first link's length.
void add_track(Maker& m) {
  const robot::Robot& robot = m.robot();
  const double unit = robot.links.empty() ? 0.1 : robot.links.front().length;
  if (!robot.trolley.present) return;
  Track track{.height = 0.34 * unit,
              .from = 0,
              .to = robot.trolley.track_length,
              .rear = -0.45 * unit,
              .front = 0.45 * unit};
  if (robot.rollers.present)
    track = {robot.rollers.height, 0,   robot.trolley.track_length, robot.rollers.rear,
             robot.rollers.front,  true};
  m.out.track = track;
}

// Adds the cylinder, unless it is locked, as part of the body, or free.
void add_cylinder(Maker& m) {
  const robot::Cylinder& c = m.robot().cylinder;
  using Mode = robot::Cylinder::Mode;
  if (!c.present || c.mode == Mode::locked || c.mode == Mode::free) return;
  CylinderShape shape{.bore = c.bore, .stroke = c.stroke};
  shape.up = m.logged("/true/cylinder/up/pressure");
  shape.down = m.logged("/true/cylinder/down/pressure");
  for (const char* which : {"inlet", "exhaust"}) {
    shape.valves_up.push_back(m.logged(std::string("/valve/cylinder_up/") + which + "/open"));
    shape.valves_down.push_back(m.logged(std::string("/valve/cylinder_down/") + which + "/open"));
  }
  m.out.cylinder = std::move(shape);
}

// Returns x at which the ground's force acts: under the foot, or between its discs by their loads.
Column contact(const Maker& m, const robot::Foot& foot, const std::string& leg,
               std::span<const Disc> discs) {
  std::vector<Column> load;
  for (const robot::Foot::Point& p : foot.points)
    load.push_back(m.record.column(robot::topic_of_leg(leg, "/true/foot/" + p.name + "/load")));
  Column out = m.record.new_column();
  for (std::size_t row = 0; row < m.record.rows(); ++row) {
    double sum = 0, moment = 0, plain = 0;
    const std::vector<robot::LinkPlace> places = robot::places(m.robot(), m.angles_at(row));
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const robot::LinkPlace& on = places[static_cast<std::size_t>(discs[i].frame - 1)];
      const double x = m.poses.trolley[row] + on.joint.x +
                       discs[i].center.x * std::cos(on.heading) -
                       discs[i].center.y * std::sin(on.heading);
      const double weight = i < load.size() && !load[i].empty() ? load[i][row] : 0.0;
      sum += weight;
      moment += weight * x;
      plain += x / static_cast<double>(discs.size());
    }
    out.push_back(sum > 0 ? moment / sum : plain);
  }
  return out;
}

void add_foot(Maker& m, std::size_t leg) {
  const std::size_t before = m.out.discs.size();
  add_discs(m, leg);
  if (m.out.discs.size() == before) return;
  const robot::LegParts parts = robot::legs_of(m.robot())[leg];
  // Topics without finite values are skipped, such as the desired path of a plan without a path.
  const auto first_of = [&](std::initializer_list<std::string> topics) {
    const auto is_number = [](double v) { return std::isfinite(v); };
    for (const std::string& topic : topics) {
      const Channel of_leg{robot::topic_of_leg(parts.name, topic), "x"};
      if (const Samples x = m.channels.find(of_leg); x && std::ranges::any_of(*x.values, is_number))
        return of_leg;
    }
    return Channel{};
  };
  FootShape foot;
  foot.at = robot::attachment_of(m.robot(), static_cast<std::size_t>(parts.joints.front()));
  foot.path = first_of({"/true/foot/position", "/foot/position"});
  foot.desired_path = first_of({"/desired/foot/position"});
  if (m.robot().ground.present) foot.force = first_of({"/true/foot/force", "/foot/force"});
  const std::span discs = std::span(m.out.discs).subspan(before);
  foot.contact = m.series((parts.name.empty() ? "" : parts.name + "/") + "foot/contact", "m",
                          contact(m, robot::foot_of(m.robot(), leg), parts.name, discs));
  m.out.feet.push_back(std::move(foot));
}

}  // namespace

Scene scene(const Channels& channels, const analysis::Machine& machine,
            const analysis::Record& record, signals::Table& drawn) {
  Maker m{channels, machine, record, drawn, poses(machine, record)};
  if (!m.poses.known() || record.rows() == 0) return {};
  m.out.drawn_from = m.poses.is_true ? "true angles" : "measured angles";
  add_frames(m);
  add_cams(m);
  for (const robot::Muscle& muscle : machine.robot.muscles) add_muscle(m, muscle);
  add_track(m);
  add_cylinder(m);
  for (std::size_t leg = 0; leg < robot::legs_of(machine.robot).size(); ++leg) add_foot(m, leg);
  return std::move(m.out);
}

}  // namespace sinew::report
