// muscle/test_bank.h - a bank with its valves and references beside it, for tests that ask the law
// itself.
#pragma once

#include "sinew/muscle/bank.h"

namespace sinew::muscle {

class BankByHand : public Bank {
 public:
  using Bank::Bank;

  void electrical(int valve, double t, bool open) { Bank::electrical(valve, t, open, valves); }
  void node(double t) { Bank::node(t, valves); }
  int follow(const Lanes& drift) { return Bank::follow(drift, reference); }
  void evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                Pull& out) const {
    Bank::evaluate(t, length, rate, mass, valves, reference, out);
  }
  bool any_open() const { return Bank::any_open(valves); }
  double open_share(int valve, double t) const { return Bank::open_share(valve, t, valves); }
  double next_change() const { return valves.next_change; }

  Valves valves = valves_at_rest();
  Reference reference = reference_at_rest();
};

}  // namespace sinew::muscle
