// recording/mapping.fields.h - the keys of a mapping's file.
#pragma once

#include "sinew/recording/mapping.h"
#include "sinew/units/field.h"

namespace sinew::recording {

template <class Visitor>
void fields(Visitor& v, TableSettings& t) {
  v.text({.name = "encoding", .optional = true, .doc = "utf-8, utf-16le, utf-16be or latin1"},
         t.encoding);
  v.text({.name = "decimal", .optional = true, .doc = "decimal mark: . or ,"}, t.decimal);
  v.text({.name = "thousands", .optional = true, .doc = "separator of thousands: . , ' or a blank"},
         t.thousands);
  v.text({.name = "dates",
          .optional = true,
          .doc = "order of dates: day first, month first, or excel"},
         t.dates);
  v.flag({.name = "spread_times",
          .optional = true,
          .doc = "true: rows with equal times are spread evenly up to the next time"},
         t.spread_times);
  v.flag({.name = "drop_incomplete",
          .optional = true,
          .doc = "true: leave out rows that lack a time, a number or a cell"},
         t.drop_incomplete);
  v.texts({.name = "columns",
           .optional = true,
           .doc = "header of a file that has none, `name [unit]` for each column"},
          t.columns);
}

template <class Visitor>
void fields(Visitor& v, ClockMapping& c) {
  v.text({.name = "column", .optional = true, .doc = "column with the times"}, c.column);
  v.text({.name = "unit", .optional = true, .doc = "unit of the times: s, ms, us"}, c.unit);
  v.text(
      {.name = "rate", .optional = true, .doc = "rate of the rows, 100 Hz, in place of a column"},
      c.rate);
  v.number({.name = "scale",
            .unit = "1",
            .min = least_clock_scale,
            .max = most_clock_scale,
            .why = clock_scale_why,
            .optional = true,
            .doc = "true seconds per second of this clock"},
           c.scale);
  v.text({.name = "start",
          .optional = true,
          .doc = "time of this clock that becomes the log's time 0; absent: the first"},
         c.start);
}

template <class Visitor>
void fields(Visitor& v, Mapping& m) {
  v.group({.name = "table", .optional = true, .doc = "format of a text table"},
          [&](auto& g) { fields(g, m.table); });
  v.group({.name = "clock", .optional = true, .doc = "clock of the recording"},
          [&](auto& g) { fields(g, m.clock); });
  v.list({.name = "where",
          .optional = true,
          .doc = "conditions for the rows that are used; all must hold"},
         m.where, [](auto& g, WhereMapping& w) {
           g.text({.name = "column", .doc = "column of the recording"}, w.column);
           g.text({.name = "values", .doc = "values of these rows, separated by commas"}, w.values);
         });
  v.list({.name = "column", .optional = true, .doc = "meaning of a column of the recording"},
         m.columns, [](auto& g, ColumnMapping& c) {
           g.text({.name = "name", .doc = "name in the recording"}, c.name);
           g.text({.name = "channel",
                   .optional = true,
                   .doc = "channel of the machine, /joint/elbow/angle; absent: by the name"},
                  c.channel);
           g.text({.name = "unit",
                   .optional = true,
                   .doc = "unit of its numbers, in place of the header's"},
                  c.unit);
           g.number({.name = "scale",
                     .unit = "1",
                     .optional = true,
                     .doc = "factor of its numbers; -1 reverses the sign"},
                    c.scale);
           g.text({.name = "offset",
                   .optional = true,
                   .doc = "value added after the factor, in a unit of the channel: 90 deg"},
                  c.offset);
         });
  v.flag({.name = "keep_others",
          .optional = true,
          .doc = "true: keep columns without a channel, as /recorded/<name>"},
         m.keep_others);
}

}  // namespace sinew::recording
