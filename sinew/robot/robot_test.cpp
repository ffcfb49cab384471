#include "sinew/robot/robot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "sinew/robot/robot.fields.h"
#include "sinew/robot/test_leg.h"

namespace sinew::robot::robot_test {
namespace {

// Returns the keys of the contradictions after `damage` is done to a valid leg.
std::vector<std::string> keys_after(const std::function<void(Robot&)>& damage) {
  Robot robot = test::leg();
  damage(robot);
  std::vector<std::string> keys;
  for (const Contradiction& c : contradictions(robot)) keys.push_back(c.key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(Contradictions, NoneInASoundLeg) {
  EXPECT_EQ(keys_after([](Robot&) {}), Keys{});
}

TEST(Contradictions, NamesThatLeadNowhere) {
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors[0].of = "ankle"; }),
            (Keys{"sensor.hip_sensor.of", "joint.hip"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.muscles[0].joint = "ankle"; }),
            (Keys{"muscle.hip_flexor.joint"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.muscles[0].inlet = ""; }),
            (Keys{"muscle.hip_flexor.inlet"}));
}

TEST(Contradictions, StopsHoldTheRestAngle) {
  const auto stop = [](std::vector<double> range, double stiffness) {
    return keys_after([&](Robot& r) { r.joints[1].stop = {std::move(range), stiffness, 0}; });
  };
  EXPECT_EQ(stop({5.0, 6.0}, 100), Keys{});
  EXPECT_EQ(stop({6.0, 5.0}, 100), Keys{"joint.knee.stop.angles"});
  EXPECT_EQ(stop({5.0}, 100), Keys{"joint.knee.stop.angles"});
  EXPECT_EQ(stop({0.1, 1.0}, 100), Keys{"joint.knee.stop.angles"});
  EXPECT_EQ(stop({5.0, 6.0}, 0), Keys{"joint.knee.stop.stiffness"});
}

TEST(Contradictions, PairsAndTheirSensors) {
  EXPECT_EQ(keys_after([](Robot& r) { r.muscles[1].role = Muscle::Role::flexor; }),
            (Keys{"joint.hip"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors.pop_back(); }), (Keys{"muscle.knee_extensor"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.muscles[2].exhaust_bit = r.muscles[0].inlet_bit; }),
            (Keys{"muscle.knee_flexor.exhaust.bit"}));
}

// Valves of a cylinder have bits of their own even where no loop moves it.
TEST(Contradictions, CylindersHaveBitsOfTheirOwn) {
  for (const auto mode : {Cylinder::Mode::valves, Cylinder::Mode::locked})
    for (const int bit : {4, 0}) {
      const Keys keys = keys_after([&](Robot& r) {
        r.cylinder = {.present = true, .mode = mode};
        r.cylinder.up.inlet = r.cylinder.down.inlet = "inlet";
        r.cylinder.up.exhaust = r.cylinder.down.exhaust = "exhaust";
        r.cylinder.down.inlet_bit = 5, r.cylinder.down.exhaust_bit = 13;
        r.cylinder.up.inlet_bit = bit;  // 0 is the hip flexor's
      });
      EXPECT_EQ(std::ranges::count(keys, "cylinder.up.inlet.bit"), bit == 0);
    }
}

// One muscle is enough, no muscle is not; nor are two on one side, where a muscle over two joints
// counts at both.
TEST(Contradictions, AJointHasOneMuscleEachWayAtMost) {
  const auto without = [](Robot& r, std::size_t muscle) {
    const std::string name = r.muscles[muscle].name;
    r.muscles.erase(r.muscles.begin() + static_cast<std::ptrdiff_t>(muscle));
    std::erase_if(r.sensors, [&](const Sensor& s) { return s.of == name; });
  };
  EXPECT_EQ(keys_after([&](Robot& r) { without(r, 1); }), Keys{});
  EXPECT_EQ(keys_after([&](Robot& r) { without(r, 1), without(r, 0); }), (Keys{"joint.hip"}));
  const auto over_both = [](Robot& r) {
    r.muscles[0].second = {.joint = "knee", .role = Muscle::Role::flexor};
  };
  EXPECT_EQ(keys_after([&](Robot& r) { over_both(r); }), (Keys{"joint.knee"}));
  EXPECT_EQ(keys_after([&](Robot& r) { over_both(r), without(r, 2); }), Keys{});
}

// A law that does not use a tension needs no transducer for it.
TEST(Contradictions, SensorsFollowFromTheLaws) {
  const auto without_tensions = [](Robot& r) {
    std::erase_if(r.sensors, [](const Sensor& s) { return s.kind == Sensor::Kind::tension; });
  };
  const auto source = [](Robot& r, StiffnessSource s) {
    for (Joint& j : r.joints) j.stiffness_source = s;
  };
  const Keys all = {"muscle.hip_flexor", "muscle.hip_extensor", "muscle.knee_flexor",
                    "muscle.knee_extensor"};
  EXPECT_EQ(keys_after(without_tensions), all);
  EXPECT_EQ(keys_after([&](Robot& r) { without_tensions(r), source(r, StiffnessSource::none); }),
            Keys{});
  EXPECT_EQ(keys_after(
                [&](Robot& r) { without_tensions(r), source(r, StiffnessSource::extensor_force); }),
            (Keys{"muscle.hip_extensor", "muscle.knee_extensor"}));
  EXPECT_EQ(keys_after([&](Robot& r) { source(r, StiffnessSource::pressures); }), all);
  EXPECT_EQ(keys_after([&](Robot& r) {
              without_tensions(r), source(r, StiffnessSource::none);
              r.joints[0].velocity.tensions = true;
            }),
            (Keys{"muscle.hip_flexor", "muscle.hip_extensor"}));
  EXPECT_EQ(
      keys_after([](Robot& r) { r.joints[1].velocity.estimator = Velocity::Estimator::sensor; }),
      (Keys{"joint.knee"}));
}

TEST(Contradictions, AThreeWayMuscleHasNoExhaust) {
  EXPECT_EQ(keys_after([](Robot& r) {
              r.muscles[0].exhaust = "";
              r.muscles[0].exhaust_bit = r.muscles[0].inlet_bit;
            }),
            Keys{});
}

TEST(Contradictions, TheScanAscendsWithinThePeriod) {
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors[3].tick = r.sensors[2].tick; }),
            (Keys{"sensor.hip_extensor_sensor.tick"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors.back().tick = r.low_level.pwm_ticks; }),
            (Keys{"sensor.knee_extensor_sensor.tick"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors[1].channel = r.sensors[0].channel; }),
            (Keys{"sensor.knee_sensor.channel"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors[0].at_rest = 5000; }),
            (Keys{"sensor.hip_sensor.real.at_rest"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.sensors[0].assumed_scale = 0; }),
            (Keys{"sensor.hip_sensor.assumed.scale"}));
}

TEST(Contradictions, MassesThatDoNotAddUp) {
  EXPECT_EQ(keys_after([](Robot& r) { r.trolley.total_mass = 0.9; }), (Keys{"trolley.total_mass"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.links[0].inertia = 0; }), (Keys{"link.femur"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.foot.present = false; }), (Keys{"ground.present"}));
  EXPECT_EQ(keys_after([](Robot& r) { r.links.pop_back(); }), (Keys{"joint"}));
}

TEST(Robot, TheTrolleyIsWhatTheLegLeaves) {
  const Robot robot = test::leg();
  EXPECT_DOUBLE_EQ(leg_mass(robot), 0.7 + 0.2 + 0.05);
  EXPECT_DOUBLE_EQ(trolley_own_mass(robot) + leg_mass(robot), robot.trolley.total_mass);
  EXPECT_EQ(trolley_own_mass(Robot{}), 0);
}

TEST(Robot, Finders) {
  const Robot robot = test::leg();
  EXPECT_EQ(find_joint(robot, "knee"), 1);
  EXPECT_EQ(find_joint(robot, "ankle"), -1);
  EXPECT_EQ(muscle_of(robot, 1, Muscle::Role::extensor), find_muscle(robot, "knee_extensor"));
  EXPECT_EQ(angle_sensor_of(robot, 1), find_sensor(robot, "knee_sensor"));
  EXPECT_EQ(tension_sensor_of(robot, 3), find_sensor(robot, "knee_extensor_sensor"));
}

// Every key of a file has one line of explanation, and every quantity its unit.
struct Census {
  int count = 0;

  void note(const units::Field& field, bool quantity) {
    ++count;
    EXPECT_FALSE(field.name.empty());
    EXPECT_FALSE(field.doc.empty()) << field.name;
    EXPECT_EQ(field.unit.empty(), !quantity) << field.name;
    EXPECT_LT(field.min, field.max) << field.name;
  }
  void number(const units::Field& f, double&) { note(f, true); }
  void numbers(const units::Field& f, std::vector<double>&) { note(f, true); }
  void integer(const units::Field& f, int&) { note(f, false); }
  void flag(const units::Field& f, bool&) { note(f, false); }
  void text(const units::Field& f, std::string&) { note(f, false); }
  void texts(const units::Field& f, std::vector<std::string>&) { note(f, false); }
  template <class Enum>
  void choice(const units::Field& f, Enum&,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    note(f, false);
    EXPECT_GT(choices.size(), 1u);
  }
  void group(const units::Field& f, const auto& visit) {
    note(f, false);
    visit(*this);
  }
  template <class T>
  void each(const units::Field& f, std::vector<T>& items, const auto& visit) {
    note(f, false);
    for (T& item : items) visit(*this, item);
  }
};

TEST(RobotFields, EveryKeyIsExplained) {
  Robot robot = test::leg();
  Census census;
  fields(census, robot);
  EXPECT_GT(census.count, 100);
}

}  // namespace
}  // namespace sinew::robot::robot_test
