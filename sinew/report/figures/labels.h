// report/figures/labels.h - a figure's labels in the user's language, from a small file:
//
//   format = "sinew.labels/1"
//   decimal_comma = true
//
//   [words]                       # whole words of the figure = translation
//   "joint angles" = "Gelenkwinkel"
//   "desired" = "Soll"
//
//   [units]
//   "bar gauge" = "bar (Überdruck)"
//
// A label is translated by the longest entry that matches: "hip desired" by "hip desired" if there
// is one, else by "hip" and "desired". Only pictures are translated; CSV files and captions are
// not, so that programs that read them work for every language.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Words of a figure, and their translation.
struct Label {
  std::string ours, yours;
  config::Location where;
};

// Content of a file of labels.
struct Labels {
  std::vector<Label> words, units;
  bool decimal_comma = false;

  // Return the translation of a text, or of a unit's name.
  std::string of(std::string_view text) const;
  std::string unit(std::string_view name) const;
};

// Reads a file of labels. Throws config::Error with the line for a file that cannot be read or has
// other content.
Labels read_labels(const std::string& path);

// Returns the figure with these labels.
Figure labelled(Figure figure, const Labels& labels);

// Texts of figures: words of axes and curves, and units.
struct FigureTexts {
  std::set<std::string> words, units;
  // Adds the texts of a figure.
  void add(const Figure& figure);
};

// Returns a problem for each label that no figure uses, with the most similar one that is used.
std::vector<config::Problem> unused_labels(const Labels& labels, const FigureTexts& phrases);

// Returns a file of labels as a start: each phrase is translated by itself.
std::string labels_file(const FigureTexts& phrases);

}  // namespace sinew::report
