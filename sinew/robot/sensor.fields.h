// robot/sensor.fields.h - the keys of the converter and of its sensors.
#pragma once

#include <string_view>

#include "sinew/robot/control.fields.h"
#include "sinew/robot/robot.h"
#include "sinew/units/field.h"

namespace sinew::robot {

template <class Visitor>
void fields(Visitor& v, Converter& converter) {
  v.integer({.name = "bits", .min = 1, .max = 12, .doc = "bits of a conversion"}, converter.bits);
  v.number({.name = "full_scale", .unit = "V", .min = 1e-3, .doc = "voltage of the largest count"},
           converter.full_scale);
}

// Visits the scale of a sensor, volts per unit or units per volt. It is above 0: with reversed
// wiring the laws would see the joint move against them.
template <class Visitor>
void scale_field(Visitor& v, std::string_view unit, double least, std::string_view doc,
                 double& value) {
  v.number({.name = "scale",
            .unit = unit,
            .min = least,
            .why = "a sensor's reading rises with what it measures",
            .doc = doc},
           value);
}

// Visits the sensor's real values. The unit of `scale` depends on its kind.
template <class Visitor>
void real_fields(Visitor& v, Sensor& sensor) {
  if (sensor.kind == Sensor::Kind::angle)
    scale_field(v, "rad/V", 1e-6, "scale of the potentiometer", sensor.scale);
  if (sensor.kind == Sensor::Kind::tension)
    scale_field(v, "V/N", 1e-9, "scale of the force transducer", sensor.scale);
  if (sensor.kind == Sensor::Kind::pressure)
    scale_field(v, "V/Pa", 1e-12, "scale of the pressure transducer", sensor.scale);
  if (sensor.kind == Sensor::Kind::velocity)
    scale_field(v, "V s/rad", 1e-9, "scale of the velocity sensor", sensor.scale);
  if (sensor.kind == Sensor::Kind::cylinder)
    scale_field(v, "m/V", 1e-9, "scale of the potentiometer", sensor.scale);
  v.number({.name = "at_rest",
            .unit = "count",
            .min = 0,
            .max = 65535,
            .doc = "reading at the joint's rest angle or at zero; of a fixed sensor: always"},
           sensor.at_rest);
  units::optional_amount(v, "noise", "count", "standard deviation of the reading", sensor.noise);
}

// Visits the values that the controller assumes.
template <class Visitor>
void assumed_fields(Visitor& v, Sensor& sensor) {
  if (sensor.kind == Sensor::Kind::angle)
    scale_field(v, "count/rad", 1e-3, "assumed scale, 767 in B.1, 714 by thesis 4.5",
                sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::tension)
    scale_field(v, "V/N", 1e-9, "assumed scale, in B.1 one for all transducers",
                sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::pressure)
    scale_field(v, "V/Pa", 1e-12, "assumed scale of the pressure transducer", sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::velocity)
    scale_field(v, "V s/rad", 1e-9, "assumed scale of the velocity sensor", sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::cylinder)
    scale_field(v, "count/m", 1e-3, "assumed scale of the travel", sensor.assumed_scale);
  v.number({.name = "at_rest",
            .unit = "count",
            .min = 0,
            .max = 65535,
            .optional = true,
            .doc = "assumed reading at the joint's rest angle or at zero"},
           sensor.assumed_at_rest);
}

// Visits the limits of plausible readings.
template <class Visitor>
void limit_fields(Visitor& v, Sensor& sensor) {
  v.numbers({.name = "plausible",
             .unit = "count",
             .min = 0,
             .max = 65535,
             .optional = true,
             .doc = "lowest and highest plausible count; absent: from the joint's range"},
            sensor.plausible);
  v.number({.name = "max_rate",
            .unit = "count/s",
            .min = 1,
            .max = 1e9,
            .optional = true,
            .doc = "largest plausible rate; absent: 60 rad/s for an angle"},
           sensor.max_rate);
  v.number({.name = "frozen_limit",
            .unit = "s",
            .min = 0.1,
            .max = 3600,
            .why = "within ten scans the noise of a converter repeats itself by chance",
            .optional = true,
            .doc = "time of constant counts of a driven joint that ends the run; absent: no limit"},
           sensor.frozen_limit);
}

template <class Visitor>
void fields(Visitor& v, Sensor& sensor) {
  v.choice({.name = "kind", .doc = "measured quantity; fixed: one that never changes"}, sensor.kind,
           {{"angle", Sensor::Kind::angle},
            {"tension", Sensor::Kind::tension},
            {"fixed", Sensor::Kind::fixed},
            {"pressure", Sensor::Kind::pressure},
            {"velocity", Sensor::Kind::velocity},
            {"cylinder", Sensor::Kind::cylinder}});
  v.text({.name = "of",
          .optional = true,
          .doc = "joint of an angle or velocity, muscle of a tension or pressure"},
         sensor.of);
  if (sensor.kind == Sensor::Kind::fixed) board_field(v, sensor.board);
  v.integer({.name = "channel", .min = 0, .max = 255, .doc = "channel of its board's converter"},
            sensor.channel);
  v.integer({.name = "tick",
             .min = 1,
             .max = 65535,
             .doc = "tick of the period at which it is read; the conversion starts a tick earlier"},
            sensor.tick);
  v.group({.name = "real", .doc = "calibration and noise of the hardware"},
          [&](auto& g) { real_fields(g, sensor); });
  v.group({.name = "assumed", .optional = true, .doc = "calibration that the controller assumes"},
          [&](auto& g) { assumed_fields(g, sensor); });
  limit_fields(v, sensor);
}

}  // namespace sinew::robot
