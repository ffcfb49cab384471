// identify/task/found_text.h - what a method of identification found, as text: its laws with their
// scores, the parameters of the chosen one, what only this method has, and what the data do not
// show.
//
// JSON (to_json in methods.h) and the page (identify/page) have the same content.
#pragma once

#include <string>
#include <type_traits>

#include "sinew/config/shown_units.h"
#include "sinew/identify/task/methods.h"

namespace sinew::identify {

struct TextOptions {
  config::UnitsToShow units = {};         // chosen ones; else each number has the method's own
  double atmosphere = units::atmosphere;  // reference of gauges [Pa]
  std::size_t width = 0;                  // letters in a line; 0: any number

  // A number in the unit in which it is shown.
  struct Shown {
    double number;
    std::string unit;  // "1": none
    double scale;      // factor of differences
  };

  // Returns the number in the chosen unit; unchanged where none was chosen or none exists.
  Shown shown(double number, const std::string& unit) const;
};

// Append the laws of a report with the parameters of the chosen one, and what the data do not show.
void put_report(std::string& out, const Report& report, const TextOptions& how);
void put_unseen(std::string& out, const Report& report);

// Append what a method has besides a report.
void put_more(std::string& out, const GeometryFound& found, const TextOptions& how);
void put_more(std::string& out, const SensorFound& found, const TextOptions& how);
void put_more(std::string& out, const DynamicFound& found, const TextOptions& how);
void put_more(std::string& out, const JointFound& found, const TextOptions& how);
void put_more(std::string& out, const PairFound& found, const TextOptions& how);
void put_more(std::string& out, const Checkup& found, const TextOptions& how);
void put_more(std::string& out, const RunFitFound& found, const TextOptions& how);
void put_more(std::string& out, const ScaleFound& found, const TextOptions& how);
void put_more(std::string& out, const PlanFound& found, const TextOptions& how);
inline void put_more(std::string&, const ValveFound&, const TextOptions&) {}
inline void put_more(std::string&, const StaticFound&, const TextOptions&) {}
inline void put_more(std::string&, const CreepResult&, const TextOptions&) {}

// Returns the report, if there is one, and what the method adds; of several sensors a table alone.
template <class Found>
std::string text_of(const Found& found, const TextOptions& how = {}) {
  std::string out;
  const Reports reports = reports_of(found);
  const bool several_sensors = std::is_same_v<Found, SensorFound> && reports.size() > 1;
  const bool has_report = !reports.empty() && !several_sensors;
  if (has_report) put_report(out, *reports[0], how);
  put_more(out, found, how);
  if (has_report) put_unseen(out, *reports[0]);
  return out;
}

}  // namespace sinew::identify
