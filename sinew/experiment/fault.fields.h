// experiment/fault.fields.h - the keys of an experiment's list [[fault]].
#pragma once

#include "sinew/experiment/fault.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

// The unit and the range of a fault's amount follow from its kind.
template <class Visitor>
void amount_field(Visitor& v, Fault& fault) {
  const std::string_view unit = unit_of_amount(fault.what);
  if (unit.empty()) return;
  const bool share = unit == "1";
  v.number({.name = "amount",
            .unit = unit,
            .min = share || fault.what == Fault::What::noise ? 0.0 : -4095.0,
            .max = share ? 1.0 : 4095.0,
            .optional = share,
            .doc = "offset, slip: counts that are added; noise: its standard deviation; dropout: "
                   "share of the readings, absent: all"},
           fault.amount);
}

// The size of a leak.
template <class Visitor>
void leak_fields(Visitor& v, Fault& fault) {
  v.number({.name = "area",
            .unit = "m2",
            .min = 0,
            .max = 1e-3,
            .least = 1e-15,
            .why = "no muscle is wider",
            .optional = true,
            .doc = "of the hole, effective; ruptured, absent: a tenth of the cross-section of one "
                   "actuator"},
           fault.area);
  if (fault.what == Fault::What::ruptured) return;
  v.number({.name = "conductance",
            .unit = "kg/(s Pa)",
            .min = 0,
            .max = 1e-5,
            .why = "beyond it is a hole, which has an area",
            .optional = true,
            .doc = "leaking: mass flow per pressure difference, of a seat or a porous wall"},
           fault.conductance);
  v.number({.name = "share",
            .unit = "1",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "leaking: of a valve's area, that stays open"},
           fault.share);
  if (!(fault.area > 0 || fault.conductance > 0 || fault.share > 0))
    units::complain(v, "area", "no leak", "an area, a conductance, or the share of a valve's area",
                    "area = \"0.1 mm2\"");
}

// The keys of a fault of the air beside its part and its times.
template <class Visitor>
void air_fields(Visitor& v, Fault& fault) {
  using What = Fault::What;
  if (fault.what == What::leaking || fault.what == What::ruptured) leak_fields(v, fault);
  if (fault.what == What::failed)
    v.number({.name = "pressure",
              .unit = "Pa abs",
              .min = 1e3,
              .max = 2e6,
              .why = "air of a line, no vacuum",
              .optional = true,
              .doc = "failed: where the supply's line stands; absent: at the room's"},
             fault.pressure);
}

template <class Visitor>
void fields(Visitor& v, Fault& fault) {
  using What = Fault::What;
  v.number({.name = "at", .unit = "s", .min = 0, .doc = "when it begins"}, fault.at);
  v.number({.name = "for",
            .unit = "s",
            .min = 1e-4,
            .optional = true,
            .doc = "how long it lasts; absent: to the end"},
           fault.lasts);
  v.text({.name = "of", .doc = "a sensor; a valve, as in hip_flexor.inlet; a muscle; supply"},
         fault.of);
  v.choice({.name = "what",
            .doc = "sensor: open (top count), short (0), stuck, offset, slip (stays), noise, "
                   "dropout; valve: stuck open, stuck shut, leaking; muscle: leaking, ruptured, "
                   "blocked (its hose); supply: failed"},
           fault.what,
           {{"open", What::open},
            {"short", What::shorted},
            {"stuck", What::stuck},
            {"offset", What::offset},
            {"slip", What::slip},
            {"noise", What::noise},
            {"dropout", What::dropout},
            {"stuck open", What::stuck_open},
            {"stuck shut", What::stuck_shut},
            {"leaking", What::leaking},
            {"ruptured", What::ruptured},
            {"blocked", What::blocked},
            {"failed", What::failed}});
  amount_field(v, fault);
  air_fields(v, fault);
  if (fault.what == What::slip && fault.lasts > 0)
    units::complain(v, "for", "a slip that ends", "a slip, which stays, or an offset",
                    "what = \"offset\"");
}

}  // namespace sinew::experiment
