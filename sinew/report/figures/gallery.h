// report/figures/gallery.h - figures beside what their source says of them: index.html and
// index.json.
//
// The page stands in the folder of the pictures and needs nothing else: no network, no program. It
// works without its one script, which only hides figures that are not asked for. The same figures
// give the same bytes.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/figures/claim.h"
#include "sinew/report/figures/figure.h"

namespace sinew::report {

// A figure and what is said of it.
struct Exhibit {
  Figure figure;
  std::vector<Claim> claims;
};

struct Gallery {
  std::string title;   // "Figures of Colbrunn (2000)"
  std::string lead;    // one paragraph below it
  std::string prefix;  // before a figure's name: "Figure "
  std::vector<Exhibit> exhibits;
  std::vector<std::string> pictures = {};  // endings of the files that were drawn, the first is
                                           // shown: "svg", "png"; none: links to the data alone
  bool scripts = false;                    // are <figure>.gp there?
};

// Returns the page with all figures.
std::string index_html(const Gallery& gallery);

// "sinew.figures/1": figures with their curves, the files that hold them, what is missing, claims
// with class and verdict, and how many there are of each.
std::string index_json(const Gallery& gallery);

// Counts the statements of all figures.
Tally tally(const Gallery& gallery);

}  // namespace sinew::report
