// report/figures/labels.h - a figure's labels in somebody's own language, from a small file:
//
//   format = "sinew.labels/1"
//   decimal_comma = true
//
//   [words]                       # whole words as figures have them = yours
//   "joint angles" = "Gelenkwinkel"
//   "desired" = "Soll"
//
//   [units]
//   "bar gauge" = "bar (Überdruck)"
//
// A label is translated by the longest words that the file has: "hip desired" by "hip desired", or
// else by "hip" and "desired". Pictures have the file's words; CSV files and captions stay as they
// are, so that a program that reads them works for every language.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Words of a figure, and what is to stand in their place.
struct Label {
  std::string ours, yours;
  config::Location where;
};

// Holds what a file of labels says.
struct Labels {
  std::vector<Label> words, units;
  bool decimal_comma = false;

  // Returns a text, or a unit's name, in the file's words.
  std::string of(std::string_view text) const;
  std::string unit(std::string_view name) const;
};

// Throws config::Error, with the line, for a file that cannot be read or has something else in it.
Labels read_labels(const std::string& path);

// Returns the figure with these labels.
Figure labelled(Figure figure, const Labels& labels);

// Lists what figures say: words of axes and curves, and units.
struct Phrases {
  std::set<std::string> words, units;
  // Adds what a figure says.
  void add(const Figure& figure);
};

// Returns a problem for each label that no figure says, with the nearest that one does.
std::vector<config::Problem> unsaid(const Labels& labels, const Phrases& phrases);

// Returns a file of labels, to begin with: each phrase stands for itself.
std::string labels_file(const Phrases& phrases);

}  // namespace sinew::report
