// report/page/scene.h - animated drawing of the machine from the side: shapes in frames, and the
// pose of every frame in every sample. All kinematics is computed here.
//
// Frame 0 is the body that carries the first joint, frame k + 1 has its origin in joint k and its x
// along link k. The plane is that of robot.h; the page only places frames by x, y and heading.
// A robot's file does not contain the mounts of its muscles: each is drawn to scale next to its
// link, on the side on which it pulls, from an anchor to its joint's cam.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/report/page/plot.h"
#include "sinew/robot/kinematics.h"
#include "sinew/signals/table.h"

namespace sinew::report {

// A moving frame of shapes.
struct Frame {
  std::string name;
  Channel x, y, heading;  // [m], [rad]
};

// A link from its frame's origin along its x.
struct LinkShape {
  int frame = 0;
  double length = 0;  // [m]
};

// A cam, fixed to the distal link.
struct CamShape {
  int frame = 0;
  std::vector<robot::Point> outline;  // about the joint [m]
};

// A muscle: from `anchor` the actuators extend by `length` along `direction`; a tendon continues to
// `touch`.
struct MuscleShape {
  std::string name;
  int frame = 0;
  robot::Point anchor, direction, touch;  // [m], [-], [m]
  int count = 1;                          // parallel actuators
  double longest = 0;                     // greatest length of the run [m]
  Channel length, diameter, pressure;     // a log of hardware has no pressure
  Channel inlet, exhaust;                 // valve edges, if the log has them
};

// A tendon within a frame.
struct TendonShape {
  int frame = 0;
  robot::Point from, to;  // [m]
};

// A disc of a foot, which touches the ground.
struct Disc {
  int frame = 0;
  robot::Point center;  // [m]
  double radius = 0;    // [m]
};

// The foot of one leg. Its paths are relative to the leg's first joint.
struct FootShape {
  double at = 0;               // x of the leg's first joint in the body's frame [m]
  Channel path, desired_path;  // topics with fields x and y [m]
  Channel force;               // topic with fields x and y, on the foot [N]
  Channel contact;             // x of the point of the force, in the plane [m]
};

struct Track {
  double height = 0, from = 0, to = 0;  // height above the first joint at rest, its travel [m]
  double rear = 0, front = 0;           // x of the rollers from the first joint [m]
  bool rollers = false;                 // rollers are given by the robot's file, not assumed
};

// The cylinder between trolley and body.
struct CylinderShape {
  double bore = 0, stroke = 0;  // [m]
  Channel up, down;             // pressures
  std::vector<Channel> valves_up, valves_down;
};

struct Scene {
  std::vector<Frame> frames;
  std::vector<LinkShape> links;
  std::vector<CamShape> cams;
  std::vector<MuscleShape> muscles;
  std::vector<TendonShape> tendons;
  std::vector<Disc> discs;
  std::optional<double> surface;  // height of the table [m]
  std::optional<Track> track;     // empty if the body is fixed
  std::optional<CylinderShape> cylinder;
  std::vector<FootShape> feet;  // feet in the order of the legs, without legs that have no foot
  std::string drawn_from;       // "true angles" or "measured angles"

  bool empty() const { return frames.empty(); }  // true if the log lacks the pose
};

// Returns the scene. Series that it refers to and `channels` lacks are added to `drawn`: /draw/….
Scene scene(const Channels& channels, const analysis::Machine& machine,
            const analysis::Record& record, signals::Table& drawn);

}  // namespace sinew::report
