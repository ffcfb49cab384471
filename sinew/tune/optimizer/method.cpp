#include "sinew/tune/optimizer/method.h"

#include <stdexcept>
#include <string>

#include "sinew/host/module.h"
#include "sinew/tune/optimizer/module/methods.h"

namespace sinew::tune {
namespace {

const SinewMethods* methods() {
  void* module = host::open_module("sinew_pagmo.so");
  if (!module)
    throw std::runtime_error(
        "this program was built without pagmo, which tuning needs; try: apt-get install "
        "libpagmo-dev, then cmake --preset release && cmake --build --preset all");
  const auto get =
      reinterpret_cast<const SinewMethods* (*)()>(host::function_of(module, "sinew_methods_1"));
  if (!get)
    throw std::runtime_error(
        "sinew_pagmo.so is of another version of Sinew; build and install both again");
  return get();
}

SinewMethodAsked of_module(const MethodAsked& asked) {
  return {.nsga2 = asked.kind == MethodKind::nsga2 ? 1 : 0,
          .dimensions = asked.dimensions,
          .costs = asked.costs,
          .population = asked.population,
          .seed = asked.seed,
          .step = asked.step};
}

}  // namespace

OptimizerMethod::OptimizerMethod(const MethodAsked& asked)
    : asked_(asked), methods_(methods()), method_(nullptr, methods_->end) {
  const SinewMethodAsked all = of_module(asked);
  method_.reset(methods_->make(&all));
  if (!method_) throw std::runtime_error("pagmo refuses this method");
}

void OptimizerMethod::check(bool success) const {
  if (!success) throw std::runtime_error(std::string("pagmo: ") + methods_->words(method_.get()));
}

void OptimizerMethod::begin(const std::vector<double>& points, const std::vector<double>& costs) {
  check(methods_->begin(method_.get(), points.data(), costs.data()));
}

std::vector<double> OptimizerMethod::ask() {
  std::vector<double> out(asked_.population * asked_.dimensions);
  std::size_t count = 0;
  check(methods_->ask(method_.get(), out.data(), &count));
  out.resize(count * asked_.dimensions);
  return out;
}

void OptimizerMethod::tell(const std::vector<double>& costs) {
  check(methods_->tell(method_.get(), costs.data()));
}

}  // namespace sinew::tune
