// run/card/on_card.h - batches of runs on a graphics card.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sinew/card/driver.h"
#include "sinew/run/card/batch.h"

namespace sinew::run {

// A card. Its first launch, or call of memory(), opens it; it stays open. Threads may use it at the
// same time.
class Card {
 public:
  // Takes one of card::list().
  explicit Card(card::Properties properties) : properties_(std::move(properties)) {}

  // Returns its properties, as the driver gives them.
  const card::Properties& properties() const { return properties_; }
  // Returns the number of runs that keep the card busy.
  std::size_t runs() const;
  // Returns how much memory a launch may take [byte].
  std::size_t memory();

  // Runs a batch. Throws std::runtime_error if the card cannot; has_failed() then stays true.
  void launch(const Batched& batched);
  bool has_failed() const { return has_failed_; }

 private:
  card::Program& program();

  card::Properties properties_;
  std::mutex mutex_;
  std::optional<card::Program> program_;
  std::atomic<bool> has_failed_ = false;
};

}  // namespace sinew::run
