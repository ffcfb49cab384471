// report/page/live_page.h - the page of a run in progress: first the page without samples, then its
// samples, piece by piece.
//
//   LivePage page(topics, {.resolved = …, .name = …, .duration = …});
//   send(fill(page_template(), page.content(more)));
//   send(page.piece(rows));   // the page appends them
//
// Consecutive pieces give the same columns as the whole run. Series that need more than one sample
// (the oscillation, the trolley's travel from torques) are left to the finished run's page.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/config/node.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/signals/table.h"

namespace sinew::report {

class LivePage {
 public:
  struct Of {
    const config::Node& resolved;  // must outlive this
    std::string name;              // name of the experiment
    double duration = 0;           // longest duration of the run [s]
    bool foot_path = false;        // the plan has a foot path
    std::string units{};           // requested units, read by config/shown_units.h
  };

  // `topics` are all that will be recorded; /valve/… are edges, the others rows of one clock.
  // Throws config::Error if the resolved file cannot be read.
  LivePage(const std::vector<signals::Topic>& topics, Of of);

  // Returns the page without samples; `live`, a JSON object, becomes the run's member of that name.
  Content content(const std::string& live) const;

  // Returns the samples of a table as a JSON object {samples, data, phases}: a layout of the page's
  // columns and their base64 (content.h), and the phases of these rows. The table must have rows of
  // all topics but edges, or no rows.
  std::string piece(const signals::Table& table) const;

 private:
  // A table with its derived series and drawings.
  struct Parts;

  Of of_;
  analysis::Machine machine_;
  std::string head_;                       // JSON of the page
  std::string units_;                      // JSON of the units (content.h)
  std::vector<Columns::Request> columns_;  // columns of the page
};

// Returns whether each sample of a derived series depends on samples of the same time only.
bool is_pointwise(std::string_view topic);

}  // namespace sinew::report
