// recording/stamp.h - dates and times of day as instruments write them.
//
//   2026-11-24T10:15:30.125   2026/11/24 10:15:30   24.11.2026 10:15:30,125   11/24/2026 1:15:30 PM
//   10:15:30.125              2026-11-24            2026-11-24T10:15:30Z      05:30.5
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::recording {

// Order of the parts of a date: "24.11.2026", "11/24/2026", "2026-11-24".
enum class DateOrder { unknown, day_first, month_first, year_first };

// An instant, or a part of one.
struct Stamp {
  bool has_date = false, has_time = false;
  int first = 0, second = 0,
      year = 0;  // parts of the date as written; with year_first: month and day
  DateOrder order = DateOrder::unknown;
  std::int64_t time = 0;    // since midnight  [ns]
  std::int64_t offset = 0;  // the zone: local minus UTC  [ns]
  bool has_zone = false;
};

// Returns the stamp, or nothing if the text is not a stamp.
std::optional<Stamp> stamp_in(std::string_view text);

// Returns the date in days since 1970-01-01; nothing if there is no such day in that order. A
// date that shows its own order is read in that order.
std::optional<std::int64_t> days_of(const Stamp& stamp, DateOrder order);

// Returns a zone, local minus UTC  [ns], as ISO 8601 writes it: "Z", "+01:00".
std::string zone_text(std::int64_t offset);

// Returns the start of a recording as text: in its own zone, and with the zone, if it has one;
// without a date if the instant is since a midnight.
std::string start_text(std::int64_t nanoseconds, bool has_date, std::optional<std::int64_t> zone);

// Returns ISO 8601 of nanoseconds since 1970-01-01T00:00 of the stamp's clock:
// "2026-11-24T10:15:30.125".
std::string iso_text(std::int64_t nanoseconds);

}  // namespace sinew::recording
