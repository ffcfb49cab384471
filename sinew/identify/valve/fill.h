// identify/valve/fill.h - models of one filling or venting, and their fit.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/valve/chamber.h"
#include "sinew/identify/valve/curve.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

// A model of a filling chamber.
struct FillModel {
  std::string_view name, law, source;
  Chamber::Shape shape = Chamber::Shape::rigid;
  gas::Flow::Law flow = gas::Flow::Law::orifice;
  double exponent = 0;  // 0: fitted
  bool leak = false;
};

// Returns all models.
std::span<const FillModel> fill_models();

// A parameter and its place in the chamber; null: the opening instant.
struct FreeValue {
  Parameter parameter;
  double Chamber::*member = nullptr;
};

// A chamber with trial values.
struct FillCase {
  Chamber chamber;
  double opening = 0;  // [s]
};

// Returns the free parameters of a model, with start values from the curve.
std::vector<FreeValue> free_values(const FillModel& model, const Curve& curve,
                                   const ValveOptions& options);
FillCase fill_case(const FillModel& model, const Curve& curve, const ValveOptions& options,
                   std::span<const FreeValue> free, std::span<const double> values);

// Fits the rows in `keep`. A value at a bound may be an artefact of the model, so the intervals of
// the others treat it as free.
Refit fit_fill(const FillModel& model, const Curve& curve, const ValveOptions& options,
               std::span<const std::size_t> keep, std::span<const std::vector<double>> starts);

}  // namespace sinew::identify
