// report/page/scene.h - the machine from the side, as a drawing that a page can move: shapes in
// frames, and for every sample where the frames are. All kinematics happens here.
//
// Frame 0 is the body that carries the first joint, frame k + 1 has its origin in joint k and its x
// along link k. Plane as in robot.h; the page places a frame by x, y and heading and knows no more.
// A robot's file does not say where its muscles are mounted: each is drawn at its true scale beside
// the link it is on, on the side on which it pulls, from an anchor to its joint's cam.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/report/page/channels.h"
#include "sinew/robot/kinematics.h"
#include "sinew/signals/table.h"

namespace sinew::report {

// A place that moves, in which shapes are drawn.
struct Frame {
  std::string name;
  Channel x, y, heading;  // [m], [rad]
};

// A link from its frame's origin along its x.
struct LinkShape {
  int frame = 0;
  double length = 0;  // [m]
};

// Fixed to the distal link, so that it turns with it.
struct CamShape {
  int frame = 0;
  std::vector<robot::Point> outline;  // about the joint [m]
};

// From `anchor` the actuators reach `length` along `direction`; a cord goes on to `touch`.
struct MuscleShape {
  std::string name;
  int frame = 0;
  robot::Point anchor, direction, touch;  // [m], [-], [m]
  int count = 1;                          // actuators side by side
  double longest = 0;                     // of the whole run [m]
  Channel length, diameter, pressure;     // pressure: none in a log of hardware
  Channel inlet, exhaust;                 // valve edges; none where there are none
};

// A line within a frame.
struct Cord {
  int frame = 0;
  robot::Point from, to;  // [m]
};

// That touches the ground.
struct Disc {
  int frame = 0;
  robot::Point center;  // [m]
  double radius = 0;    // [m]
};

// The foot of one leg: its paths are about its first joint.
struct FootShape {
  double at = 0;               // of the leg's first joint, ahead of the body's origin [m]
  Channel path, desired_path;  // topics with fields x and y [m]
  Channel force;               // the same, on the foot [N]
  Channel contact;             // x where the force acts, in the plane [m]
};

struct Track {
  double height = 0, from = 0, to = 0;  // of the first joint's way, at rest above it [m]
  double rear = 0, front = 0;           // where the rollers are, from the first joint [m]
  bool rollers = false;                 // their places are the robot's, not ours
};

// Between trolley and body.
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
  std::vector<Cord> cords;
  std::vector<Disc> discs;
  std::optional<double> surface;  // of the table [m]
  std::optional<Track> track;     // none: the body is fixed
  std::optional<CylinderShape> cylinder;
  std::vector<FootShape> feet;  // by leg, of those that have one
  std::string drawn_from;       // "true angles" or "measured angles"

  bool empty() const { return frames.empty(); }  // the log does not say how the machine stood
};

// `drawn` receives the series that the scene refers to beside those of `channels`: /draw/….
Scene scene(const Channels& channels, const analysis::Machine& machine,
            const analysis::Record& record, signals::Table& drawn);

// Holds the pose of the machine at every row of a log: the part of the scene that moves.

struct Poses {
  std::vector<analysis::Column> angle;  // of every joint [rad]; empty: not known
  analysis::Column trolley, lift;       // of the body [m]; zeros where it does not move
  bool is_true = false;                 // as simulated, not as measured

  // Does the log say how the machine stood?
  bool known() const { return !angle.empty(); }
};

// True angles where the log has them, else measured ones. A joint of which a log of hardware says
// nothing stays at its rest angle, if another one is known.
Poses poses(const analysis::Machine& machine, const analysis::Record& record);

}  // namespace sinew::report
