// identify/valve/fill.h - models of one filling or venting, and how they are fitted.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/valve/chamber.h"
#include "sinew/identify/valve/curve.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

// A law by which a chamber may fill.
struct FillModel {
  std::string_view name, law, source;
  Chamber::Shape shape = Chamber::Shape::rigid;
  gas::Flow::Law flow = gas::Flow::Law::orifice;
  double exponent = 0;  // 0: fitted
  bool leak = false;
};

// Returns all of them.
std::span<const FillModel> fill_models();

// A parameter and where it goes; no member: the opening instant.
struct FreeValue {
  Parameter parameter;
  double Chamber::*member = nullptr;
};

// A chamber with the values that are tried.
struct FillCase {
  Chamber chamber;
  double opening = 0;  // [s]
};

// What a model leaves to be fitted to the curve, from sensible starts.
std::vector<FreeValue> free_values(const FillModel& model, const Curve& curve,
                                   const ValveOptions& options);
FillCase fill_case(const FillModel& model, const Curve& curve, const ValveOptions& options,
                   std::span<const FreeValue> free, std::span<const double> values);

// Fits the rows in `keep`. A value that ends at a bound is true only if it is really there: the
// intervals of the others count it as free.
Refit fit_fill(const FillModel& model, const Curve& curve, const ValveOptions& options,
               std::span<const std::size_t> keep, std::span<const std::vector<double>> starts);

}  // namespace sinew::identify
