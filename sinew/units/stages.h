// units/stages.h - weighted mean of RK4's four stages.
#pragma once

namespace sinew::units {

// mean(of) is h times the mean of of(0) ... of(3), the rates of the stages at 0, 1/2, 1/2 and 1. S
// is a double or a pack (pack.h).
template <class S>
class StageMean {
 public:
  // Takes the step [s]; operator() returns h times the mean.
  explicit StageMean(const S& h) : sixth_(h / 6.0) {}
  template <class Of>
  [[gnu::always_inline]] S operator()(const Of& of) const {
    return sixth_ * (of(0) + 2.0 * of(1) + 2.0 * of(2) + of(3));
  }

 private:
  S sixth_;
};

}  // namespace sinew::units
