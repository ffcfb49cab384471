#include "sinew/run/ensemble/many.h"

#include <algorithm>
#include <atomic>
#include <exception>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/host/side_by_side.h"
#include "sinew/run/card/on_card.h"
#include "sinew/run/ensemble/batches.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/units/letters.h"

namespace sinew::run {
namespace {

// Returns the first problem, as one line of a table.
std::string first_problem(const config::Error& e) {
  const std::size_t more = e.problems().size() - 1;
  return config::to_text(e.problems().front()) +
         (more > 0 ? fmt::format(" (and {} more)", more) : "");
}

// Returns the result of work(), or its refusal.
template <class Work>
RunResult refusing(const Work& work) {
  RunResult out;
  try {
    return work();
  } catch (const config::Error& e) {
    out.status = "refused: " + first_problem(e);
  } catch (const std::exception& e) {
    out.status = std::string("refused: ") + e.what();
  }
  return out;
}

RunResult run_alone(BegunRun begun) {
  const Outcome outcome =
      run(begun.member->experiment,
          {.topics = begun.member->selection ? &begun.member->selection->topics() : nullptr});
  return begun.ensemble->result(std::move(begun.member), outcome);
}

// A run, begun or refused, and its number.
struct NumberedRun {
  std::size_t number = 0;
  BegunRun run;
};

const signals::TopicNames* topics_of(const BegunRun& run) {
  return run.member->selection ? &run.member->selection->topics() : nullptr;
}

// Begins a run; reports it if it is refused, and has no member then.
void begin_member(const Many& many, NumberedRun& its) {
  RunResult refused = refusing([&] {
    its.run = many.begin(its.number);
    return RunResult{};
  });
  if (!its.run.member) many.done(its.number, std::move(refused));
}

// Reports a run with its outcome, or with the exception in place of one.
void end_member(const Many& many, NumberedRun its, const Outcome& outcome,
                const std::exception_ptr& thrown = nullptr) {
  many.done(its.number, refusing([&] {
              if (thrown) std::rethrow_exception(thrown);
              return its.run.ensemble->result(std::move(its.run.member), outcome);
            }));
}

}  // namespace

void run_many(const Many& many) {
  std::vector<NumberedRun> going;
  const auto find = [&](const experiment::Experiment& e) {
    return std::ranges::find_if(
        going, [&](const NumberedRun& its) { return &its.run.member->experiment == &e; });
  };
  const auto next = [&]() -> const experiment::Experiment* {
    while (const std::optional<std::size_t> number = many.next()) {
      NumberedRun its{*number, {}};
      begin_member(many, its);
      if (its.run.member) return &going.emplace_back(std::move(its)).run.member->experiment;
    }
    return nullptr;
  };
  const auto topics = [&](const experiment::Experiment& e) { return topics_of(find(e)->run); };
  const auto done = [&](const experiment::Experiment& e, const Outcome& outcome,
                        const std::exception_ptr& thrown) {
    const auto at = find(e);
    NumberedRun ended = std::move(*at);
    going.erase(at);
    end_member(many, std::move(ended), outcome, thrown);
  };
  run_in_lanes({.next = next, .done = done, .most = many.lanes, .topics = topics});
}

namespace {

bool is_stopped(const Many& many) { return many.stopped && many.stopped(); }

// The next runs, begun in parallel, at most `most`; `is_last`: there are no more.
struct Batch {
  std::vector<NumberedRun> members;
  bool is_last = false;
};
Batch begin_batch(const Many& many, std::size_t most, int threads) {
  Batch batch;
  while (batch.members.size() < most && !batch.is_last) {
    const std::optional<std::size_t> number = many.next();
    if (number)
      batch.members.push_back({*number, {}});
    else
      batch.is_last = true;
  }
  host::side_by_side(
      batch.members.size(), [&](std::size_t i) { begin_member(many, batch.members[i]); }, nullptr,
      threads);
  std::erase_if(batch.members, [](const NumberedRun& its) { return !its.run.member; });
  return batch;
}

// Runs one of each ensemble whose channels are not known by itself, which finds them for the
// others.
void find_channels(const Many& many, std::vector<NumberedRun>& members) {
  for (NumberedRun& its : members) {
    if (its.run.member->selection) continue;
    its.run.member->selection = its.run.ensemble->selection();
    if (its.run.member->selection || is_stopped(many)) continue;
    many.done(its.number, refusing([&] { return run_alone(std::move(its.run)); }));
    its.run.member.reset();
  }
  std::erase_if(members, [](const NumberedRun& its) { return !its.run.member; });
}

// Runs all in lanes on threads.
void run_in_threads(const Many& many, std::size_t threads) {
  host::side_by_side(
      threads, [&](std::size_t) { run_many(many); }, nullptr, static_cast<int>(threads));
}

// Runs what a batch could not hold.
void run_rest(const Many& many, std::vector<NumberedRun> rest, int threads) {
  std::atomic<std::size_t> taken{0};
  const auto next = [&]() -> std::optional<std::size_t> {
    const std::size_t i = is_stopped(many) ? rest.size() : taken++;
    return i < rest.size() ? std::optional(i) : std::nullopt;
  };
  const auto begin = [&](std::size_t i) { return std::move(rest[i].run); };
  const auto done = [&](std::size_t i, RunResult result) {
    many.done(rest[i].number, std::move(result));
  };
  run_on({.kind = Device::Kind::cpu}, rest.size(),
         {.next = next, .begin = begin, .done = done, .lanes = many.lanes}, threads);
}

}  // namespace

void run_many_in_batches(const Many& many, const InBatches& how, int threads) {
  for (bool failed = false, is_last = false; !failed && !is_last;) {
    Batch batch = begin_batch(many, how.most, threads);
    is_last = batch.is_last;
    find_channels(many, batch.members);
    std::vector<BatchedRun> runs;
    for (const NumberedRun& its : batch.members)
      runs.push_back({topics_of(its.run) ? &its.run.member->experiment : nullptr,
                      topics_of(its.run), its.run.ensemble->plan_of(*its.run.member)});
    const auto done = [&](std::size_t i, const Outcome& outcome) {
      end_member(many, std::move(batch.members[i]), outcome);
    };
    try {
      run_batch(
          runs, how.launcher, threads, [&] { return is_stopped(many); }, done);
    } catch (const WrongBits&) {
      throw;
    } catch (const std::exception& e) {
      if (!how.continues) throw;
      failed = true;
      if (many.notice) many.notice(std::string(e.what()) + "; the processor continues");
    }
    std::vector<NumberedRun> rest;
    for (NumberedRun& its : batch.members)
      if (its.run.member) rest.push_back(std::move(its));
    run_rest(many, std::move(rest), threads);
  }
  run_in_threads(many, static_cast<std::size_t>(threads));
}

void run_on(const Device& device, std::size_t runs, const Many& many, int threads) {
  const bool is_named = device.kind == Device::Kind::gpu;
  if (!device.card || (!is_named && (runs < fewest_on_card || device.card->has_failed()))) {
    const std::size_t count =
        std::min(static_cast<std::size_t>(threads), std::max<std::size_t>(1, runs));
    Many its = many;
    its.lanes = lanes_of(runs, count, many.lanes);
    return run_in_threads(its, count);
  }
  Card& card = *device.card;
  run_many_in_batches(
      many,
      {{[&](const Batched& batched) { card.launch(batched); }, [&] { return card.memory(); }},
       card.runs(),
       !is_named},
      threads);
}

int lanes_of(std::size_t runs, std::size_t threads, int most) {
  const std::size_t each = (runs + threads - 1) / std::max<std::size_t>(1, threads);
  return static_cast<int>(std::clamp<std::size_t>(each, 1, static_cast<std::size_t>(most)));
}

// The settings of a run: those with numbers, which may differ within an ensemble, and the others.
struct Ensembles::Split {
  std::vector<std::string> fixed, keys, values;

  // Moves the numbers for which `moves` holds to the fixed settings.
  template <class Moves>
  void fix(const Moves& moves) {
    for (std::size_t i = keys.size(); i-- > 0;) {
      if (!moves(keys[i])) continue;
      fixed.push_back(keys[i] + "=" + values[i]);
      keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
};

namespace {

// Returns whether a value begins as a number does.
bool looks_like_number(std::string_view value) {
  return value.find_first_of("0123456789") == value.find_first_not_of("+-. ") &&
         value.find_first_of("0123456789") != value.npos;
}

}  // namespace

// Returns the ensemble of an experiment with these settings. Keys that turn out to be
// words become fixed.
std::shared_ptr<const Ensemble> Ensembles::ensemble(const std::string& experiment, Split& split) {
  constexpr std::size_t most = 100;  // kept at a time: words as values make one for each run
  for (;;) {
    std::vector<std::string> name{experiment};
    {
      const std::lock_guard lock(mutex_);
      split.fix([&](const std::string& key) { return fixed_.contains({experiment, key}); });
      name.insert(name.end(), split.fixed.begin(), split.fixed.end());
      name.insert(name.end(), split.keys.begin(), split.keys.end());
      if (const auto found = ensembles_.find(name); found != ensembles_.end()) return found->second;
    }
    auto made = std::make_shared<const Ensemble>(files_, experiment, split.fixed, split.keys,
                                                 split.values, figures_, allow_unreachable_);
    const std::vector<std::string> unknown = made->unknown();
    const std::lock_guard lock(mutex_);
    for (const std::string& key : unknown) fixed_.insert({experiment, key});
    if (!unknown.empty()) continue;
    if (split.keys.empty()) return made;  // serves this run alone
    if (ensembles_.size() >= most) ensembles_.clear();
    return ensembles_.try_emplace(std::move(name), std::move(made)).first->second;
  }
}

BegunRun Ensembles::begin(const std::string& experiment, const std::vector<std::string>& sets) {
  Split split;
  for (const std::string& set : sets) {
    const std::size_t equals = std::min(set.find('='), set.size());
    const std::string key(units::trimmed(std::string_view(set).substr(0, equals)));
    const std::string value(
        units::trimmed(std::string_view(set).substr(std::min(equals + 1, set.size()))));
    // A later setting overrides earlier ones of the same key, and of keys within its table.
    const bool number = looks_like_number(value);
    if (number) {
      split.fix([&](const std::string& other) { return other == key; });
      split.keys.push_back(key);
      split.values.push_back(value);
    } else {
      split.fix([&](const std::string& other) { return other.starts_with(key); });
      split.fixed.push_back(set);
    }
  }
  std::shared_ptr<const Ensemble> its = ensemble(experiment, split);
  std::unique_ptr<Ensemble::Member> member = its->member(split.values);
  return {std::move(its), std::move(member)};
}

RunResult Ensembles::run_once(const std::string& experiment, const std::vector<std::string>& sets) {
  return refusing([&] { return run_alone(begin(experiment, sets)); });
}

RunResult run_once(const std::string& experiment, const std::vector<std::string>& sets,
                   bool allow_unreachable) {
  return Ensembles({}, allow_unreachable).run_once(experiment, sets);
}

}  // namespace sinew::run
