// report/figures/gallery.h - page of figures with the source's statements about them: index.html
// and index.json.
//
// The page is in the folder of the pictures and needs neither a network nor a program. It works
// without its script, which only filters the figures. The same figures give the same bytes.
#pragma once

#include <string>
#include <vector>

#include "sinew/json/json.h"
#include "sinew/report/figures/claim.h"
#include "sinew/report/figures/figure.h"

namespace sinew::report {

// A figure and the statements about it.
struct Exhibit {
  Figure figure;
  std::vector<Claim> claims;
};

struct Gallery {
  std::string title;   // "Figures of Colbrunn (2000)"
  std::string lead;    // one paragraph below the title
  std::string prefix;  // before a figure's name: "Figure "
  std::vector<Exhibit> exhibits;
  std::vector<std::string> pictures = {};  // endings of the files that were drawn, the first is
                                           // shown: "svg", "png"; empty: links to the data alone
  bool scripts = false;                    // <figure>.gp exist
};

// Returns the page with all figures.
std::string index_html(const Gallery& gallery);

// Returns "sinew.figures/1": figures with their curves, files and missing parts, claims with class
// and verdict, and the number of each.
std::string index_json(const Gallery& gallery);

// Returns a table of such figures: name, title and number of curves.
std::string text_of_figures(const Json& figures);

// Counts the statements of all figures.
Tally tally(const Gallery& gallery);

}  // namespace sinew::report
