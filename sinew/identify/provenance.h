// identify/provenance.h - identified values as parameter files: each with its source and how far it
// can be trusted, as the origins that config::Writer prints.
#pragma once

#include <string>
#include <string_view>

#include "sinew/actuator/actuator.h"
#include "sinew/config/origin.h"
#include "sinew/identify/least_squares.h"

namespace sinew::identify {

class Provenance {
 public:
  // The value at `path` was fitted. Its uncertainty is half the 95 % interval, in its own unit; one
  // that is not identifiable says so in its source.
  void fitted(std::string_view path, const Estimate& estimate, std::string_view source);
  // One that has an uncertainty but was not fitted alone; NaN: none is known.
  void fitted(std::string_view path, std::string_view unit, double uncertainty,
              std::string_view source);
  // Taken over, assumed or guessed.
  void given(std::string_view path, std::string_view source);
  void guessed(std::string_view path, std::string_view source);

  const config::Origins& origins() const { return origins_; }

 private:
  config::Origins origins_;
};

// A file of format sinew.actuator/1; paths begin with "actuator.<name>.".
std::string actuator_file(actuator::Actuator actuator, const Provenance& provenance);

}  // namespace sinew::identify
