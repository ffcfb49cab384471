// cli/thesis_figures.h - the curves of the thesis's figures as columns of numbers.
//
// Every curve says what it is:
//
//   computed     a law or a simulation, as the thesis drew it
//   synthetic    in the place of a measured curve that is lost: our stand with stated losses,
//                transducers, noise and seed; no measurement
//   unavailable  not drawn, and why
#pragma once

#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"

namespace sinew::cli {

// One CSV file: `name [unit]` over each column. Empty cells are NaN.
struct Sheet {
  std::string name;  // of the file, without .csv
  std::vector<std::string> headings;
  std::vector<std::vector<double>> rows;
};

struct Curve {
  enum class Kind { computed, synthetic, unavailable };

  std::string figure, what;  // "2-6", "force at 20 psi"
  Kind kind = Kind::computed;
  std::string source;  // law or file that it comes from; why not, if unavailable
  std::string sheet, x, y;
};

struct Figure {
  std::string number, caption;
};

struct FigureSet {
  std::vector<Figure> figures;
  std::vector<Sheet> sheets;
  std::vector<Curve> curves;

  // A sheet whose first column is the x of all others; each of those is a curve.
  void add(const Figure& figure, Curve::Kind kind, const std::string& source, Sheet sheet);
};

// Where the files of the project are.
struct FigureSources {
  std::string root;
  actuator::Actuator actuator;  // robots/leg-as-printed, the gauge pressure in [30]
  gas::Air air;                 // chapter 3's
  gas::Valve chapter3;          // of the test stand
  gas::Valve inlet, exhaust;    // at the bench
};

// 2-6: tension and stiffness, 2-11, 2-13: effectiveness and long end and effectiveness by their
// laws.
void add_actuator_figures(FigureSet& set, const FigureSources& from);

// 2-8 to 2-13: weights hung on the stand with its air shut in, beside the laws.
void add_static_figures(FigureSet& set, const FigureSources& from);

// 3-6 to 3-11, 3-14 to 3-23: length over time on the stand.
void add_dynamic_figures(FigureSet& set, const FigureSources& from);

// 2-8 to 2-13: weights hung on the stand with its air shut in, beside the laws.
void add_static_figures(FigureSet& set, const FigureSources& from);

// 3-6 to 3-11, 3-14 to 3-23: length over time on the stand.
void add_dynamic_figures(FigureSet& set, const FigureSources& from);

// 3-4, 3-13, 4-8, 4-9: flow, delivered duty and coil currents.
void add_valve_figures(FigureSet& set, const FigureSources& from);

}  // namespace sinew::cli
