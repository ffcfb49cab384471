// tests/worlds/on_world.h - any world as a body: the one adapter of this folder.
//
// It uses only what all worlds have in common; a Meaning interprets a set-up and a truth:
//
//   World                        made from a Setup
//   channels(setup)              of its port
//   visit(setup, truth, take)    take(name, kind, number) of each number of a truth, in one order
//   air(setup, truth, held)      its balances, with the air in all of it [kg]
//   energy(setup, truth)         [J]
#pragma once

#include <cstring>
#include <span>
#include <utility>

#include "tests/worlds/body.h"

namespace sinew::worlds {

template <class Meaning>
class OnWorld final : public Body {
  using World = typename Meaning::World;
  using Setup = typename Meaning::Setup;
  using Truth = decltype(std::declval<World&>().truth(0.0));

 public:
  explicit OnWorld(const Setup& s) : setup_(s), world_(s) {
    Meaning::visit(setup_, Truth{}, [&](const char* name, Kind kind, double) {
      quantities_.push_back({name, kind});
    });
  }

  signals::Port& port() override {
    if constexpr (requires { world_.port(); })
      return world_.port();
    else
      return world_;
  }
  std::size_t channels() const override { return Meaning::channels(setup_); }
  void advance(double t) override { world_.advance(t); }
  double time() const override { return world_.time(); }
  std::int64_t nodes() const override { return world_.nodes(); }
  air::Failure failure() const override { return world_.failure(); }

  std::vector<std::byte> save() const override {
    if constexpr (requires { world_.state_size(); }) {
      std::vector<std::byte> out(world_.state_size());
      world_.save(out);
      return out;
    } else {
      const auto bytes = std::as_bytes(std::span(&world_.state(), 1));
      return {bytes.begin(), bytes.end()};
    }
  }
  void restore(std::span<const std::byte> saved) override {
    if constexpr (requires { world_.state_size(); }) {
      world_.restore(saved);
    } else {
      typename World::State state;
      std::memcpy(&state, saved.data(), sizeof state);
      world_.restore(state);
    }
  }

  const std::vector<Quantity>& quantities() const override { return quantities_; }
  void truth(double t, std::span<double> out) override {
    std::size_t n = 0;
    Meaning::visit(setup_, world_.truth(t), [&](const char*, Kind, double x) { out[n++] = x; });
  }
  std::vector<Account> air(double t) override {
    const Truth x = world_.truth(t);
    return Meaning::air(setup_, x, world_.air_mass());
  }
  double energy(double t) override { return Meaning::energy(setup_, world_.truth(t)); }

 private:
  Setup setup_;
  World world_;
  std::vector<Quantity> quantities_;
};

}  // namespace sinew::worlds
