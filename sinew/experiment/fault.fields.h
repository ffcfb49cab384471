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
  v.text({.name = "of", .doc = "the sensor"}, fault.of);
  v.choice({.name = "what", .doc = "open: top count; short: 0; slip: an offset that stays"},
           fault.what,
           {{"open", What::open},
            {"short", What::shorted},
            {"stuck", What::stuck},
            {"offset", What::offset},
            {"slip", What::slip},
            {"noise", What::noise},
            {"dropout", What::dropout}});
  amount_field(v, fault);
  if (fault.what == What::slip && fault.lasts > 0)
    units::complain(v, "for", "a slip that ends", "a slip, which stays, or an offset",
                    "what = \"offset\"");
}

}  // namespace sinew::experiment
