// python/binding/force_beam.cpp - a beam with strain gages, as `sinew force-beam` reckons it.

#include "python/binding/bind.h"
#include "python/binding/settings.h"
#include "sinew/identify/sensor/transducer_settings.h"
#include "sinew/identify/sensor/transducer_text.h"
#include "sinew/json/json.h"

namespace sinew::python {

namespace {

// Returns what `sinew force-beam --json` prints.
py::object force_beam(const py::dict& given) {
  identify::TransducerSettings s;
  const Settings settings(given);
  settings.quantity("length", "m", s.length);
  settings.quantity("width", "m", s.width);
  settings.quantity("height", "m", s.height);
  settings.quantity("gages", "m", s.gages);
  settings.quantity("modulus", "N/m2", s.modulus);
  settings.quantity("yield_stress", "N/m2", s.yield);
  settings.number("poisson", s.poisson);
  settings.number("concentration", s.concentration);
  settings.text("bridge", s.bridge);
  settings.number("gage_factor", s.gage_factor);
  settings.quantity("excitation", "V", s.excitation);
  settings.number("gain", s.gain);
  settings.quantity("full_scale", "V", s.full_scale);
  settings.integer("bits", s.bits);
  settings.quantity("load", "N", s.load);
  settings.quantity("sensitivity", "V/N", s.sensitivity);
  return py::module_::import("json").attr("loads")(
      identify::json_of(identify::transducer_of(s), identify::wanted_sensitivity(s)));
}

}  // namespace

void bind_force_beam(py::module_& m) { m.def("force_beam", &force_beam, py::arg("settings")); }

}  // namespace sinew::python
