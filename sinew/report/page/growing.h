// report/page/growing.h - the page of a run that still goes: first the page without samples, then
// its samples, piece by piece.
//
//   Growing growing(topics, {.resolved = …, .name = …, .duration = …});
//   send(fill(page_template(), growing.content(more)));
//   send(growing.piece(rows));   // the page appends them
//
// Pieces that follow each other give the columns that the whole gives: what looks at more than one
// sample (the oscillation, the trolley's way from torques) waits for the finished run's page.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/config/node.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/signals/table.h"

namespace sinew::report {

class Growing {
 public:
  struct Of {
    const config::Node& resolved;  // outlives this
    std::string name;              // of the experiment
    double duration = 0;           // at the latest [s]
    bool foot_path = false;        // the plan has one
    std::string units{};           // asked for now, as config/shown_units.h reads it
  };

  // `topics`: all that will be recorded; /valve/… are edges, the others rows of one clock. Throws
  // config::Error where the resolved file cannot be read.
  Growing(const std::vector<signals::Topic>& topics, Of of);

  // The page without samples; `live`, a JSON object, becomes the run's member of that name.
  Content content(const std::string& live) const;

  // What the table holds, as a JSON object {samples, data, phases}: a layout of the page's columns
  // and their base64 (content.h), and the phases of these rows. The table has rows of all topics
  // that are no edges, or no rows at all.
  std::string piece(const signals::Table& table) const;

 private:
  // What a table holds and what is drawn of it.
  struct Parts;

  Of of_;
  analysis::Machine machine_;
  std::string head_;                     // JSON of the page
  std::string units_;                    // JSON: those that it begins in, and the others
  std::vector<Columns::Asked> columns_;  // of the page
};

// Whether a derived series needs no sample but its own.
bool is_pointwise(std::string_view topic);

}  // namespace sinew::report
