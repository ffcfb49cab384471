// recording/mapping.fields.h - the keys of a mapping's file.
#pragma once

#include "sinew/recording/mapping.h"
#include "sinew/units/field.h"

namespace sinew::recording {

template <class Visitor>
void fields(Visitor& v, TableSettings& t) {
  v.text({.name = "encoding", .optional = true, .doc = "utf-8, utf-16le, utf-16be or latin1"},
         t.encoding);
  v.text({.name = "decimal", .optional = true, .doc = "the decimal mark: . or ,"}, t.decimal);
  v.text({.name = "thousands", .optional = true, .doc = "what parts thousands: . , ' or a blank"},
         t.thousands);
  v.text({.name = "dates", .optional = true, .doc = "day first, month first, or excel"}, t.dates);
  v.flag({.name = "spread_times",
          .optional = true,
          .doc = "rows that share a time are spread evenly up to the next one"},
         t.spread_times);
  v.flag({.name = "drop_incomplete", .optional = true, .doc = "leave out rows without a time"},
         t.drop_incomplete);
  v.texts({.name = "columns",
           .optional = true,
           .doc = "the header, `name [unit]`, of a file that has none"},
          t.columns);
}

template <class Visitor>
void fields(Visitor& v, ClockMapping& c) {
  v.text({.name = "column", .optional = true, .doc = "that holds the times"}, c.column);
  v.text({.name = "unit", .optional = true, .doc = "of its numbers: s, ms, us"}, c.unit);
  v.text({.name = "rate", .optional = true, .doc = "of the rows, 100 Hz, in place of a column"},
         c.rate);
  v.number({.name = "scale",
            .unit = "1",
            .min = 0.5,
            .max = 2,
            .why = "a clock that errs by more has another unit",
            .optional = true,
            .doc = "true seconds in a second of this clock"},
           c.scale);
  v.text({.name = "start",
          .optional = true,
          .doc = "the time of this clock that becomes the log's time 0; absent: the first"},
         c.start);
}

template <class Visitor>
void fields(Visitor& v, Mapping& m) {
  v.group({.name = "table", .optional = true, .doc = "how a table of text is written"},
          [&](auto& g) { fields(g, m.table); });
  v.group({.name = "clock", .optional = true, .doc = "the recording's clock"},
          [&](auto& g) { fields(g, m.clock); });
  v.list({.name = "where", .optional = true, .doc = "which rows are taken: all of these hold"},
         m.where, [](auto& g, WhereMapping& w) {
           g.text({.name = "column", .doc = "of the recording"}, w.column);
           g.text({.name = "values", .doc = "that it has in these rows, with commas between"},
                  w.values);
         });
  v.list(
      {.name = "column", .optional = true, .doc = "what a column of the recording means"},
      m.columns, [](auto& g, ColumnMapping& c) {
        g.text({.name = "name", .doc = "in the recording"}, c.name);
        g.text({.name = "channel",
                .optional = true,
                .doc = "of the machine, /joint/elbow/angle; absent: by the name"},
               c.channel);
        g.text(
            {.name = "unit", .optional = true, .doc = "of its numbers, where its header has none"},
            c.unit);
        g.number({.name = "scale",
                  .unit = "1",
                  .optional = true,
                  .doc = "by which its numbers are multiplied; -1 turns the sign"},
                 c.scale);
        g.text({.name = "offset",
                .optional = true,
                .doc = "which is added then, in a unit of the channel: 90 deg"},
               c.offset);
      });
  v.flag({.name = "keep_others",
          .optional = true,
          .doc = "keep columns that have no channel, as /recorded/<name>"},
         m.keep_others);
}

}  // namespace sinew::recording
