#include "tests/guards/board_cases.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "sinew/experiment/faults.h"
#include "tests/places.h"

namespace sinew::run {

using experiment::Experiment;
using experiment::Fault;
using experiment::FaultPart;
using plant::BoardFailure;
using signals::Tick;

namespace {

constexpr Tick period = 100;
constexpr double when_it_moves = 0.8;  // the vent at the beginning of a run is over  [s]

// To the board, to the host or both ways.
void draw_line(Case& c, Spoil kind, unsigned way, std::mt19937& random) {
  if (way != 1) c.down = kind;
  if (way != 0) c.up = kind;
  c.share = in(random, 0.02, 1);
  c.from = in(random, 0.2, 2);
  c.lasts = random() % 2 ? in(random, 0.02, 1.5) : 1e9;
  constexpr const char* ways[] = {" to the board", " to the host", " both ways"};
  c.name = std::string("line: ") + spoil_names[static_cast<int>(kind)] + ways[way];
}

bool is_angle(const Case& c, const FaultPart& part) {
  return part.kind == FaultPart::Kind::sensor &&
         c.experiment.robot.sensors[static_cast<std::size_t>(part.index)].kind ==
             robot::Sensor::Kind::angle;
}

// A random value where none is required.
void draw_fault(Case& c, const std::vector<FaultPart>& parts, std::optional<Fault::What> wanted,
                std::mt19937& random) {
  const FaultPart& part = parts[random() % parts.size()];
  const auto words = experiment::faults_of(part.kind);
  experiment::FaultName word = words[random() % words.size()];
  if (wanted) word = {*wanted, experiment::name_of(*wanted)};
  Fault f{.at = in(random, 0.3, 2), .of = part.name, .what = word.what};
  using What = Fault::What;
  if (f.what == What::offset || f.what == What::slip) f.amount = in(random, -900, 900);
  if (f.what == What::noise) f.amount = in(random, 2, 300);
  if (f.what == What::dropout) f.amount = in(random, 0.2, 1);
  if (f.what == What::leaking || f.what == What::ruptured) f.amount = in(random, 1e-8, 1e-6);
  if (f.what == What::failed) f.amount = in(random, 101'325, 300'000);
  c.experiment.faults = {f};
  constexpr const char* kinds[] = {"sensor", "valve",  "regulator",
                                   "muscle", "supply", "transducer"};
  c.name = std::string(kinds[static_cast<int>(part.kind)]) + ": " + std::string(word.text);
  if (part.kind != FaultPart::Kind::sensor) return;
  c.of_angle = is_angle(c, part);
  c.name += c.of_angle ? ", an angle" : ", another one";
}

void draw_board(Case& c, unsigned what, std::mt19937& random) {
  c.board_at = in(random, 0.3, 2);
  const auto some = static_cast<std::uint16_t>(3 + random() % 50);
  const struct {
    const char* name;
    BoardFailure failure;
  } kinds[] = {{"board: reset", {BoardFailure::What::reset}},
               {"board: hangs", {BoardFailure::What::stall, 0xffff}},
               {"board: misses ticks", {BoardFailure::What::stall, some}}};
  c.name = kinds[what].name;
  c.failure = kinds[what].failure;
}

// A silence is the only one with a time in the table: it comes twice as often, and half of them are
// permanent.
void draw_line_of_turn(Case& c, unsigned turn, unsigned rounds, std::mt19937& random) {
  using enum Spoil;
  constexpr Spoil kinds[] = {silence, drop,      flip,     babble, silence,
                             delay,   duplicate, truncate, reorder};
  const Spoil kind = kinds[turn % 9];
  draw_line(c, kind, (turn + rounds) % 3, random);
  if (kind == silence) c.from = in(random, when_it_moves, 2);
  if (kind == silence && rounds % 2 == 0) c.lasts = 1e9;
}

// The wire of an angle, whose fault a board detects, then faults that it cannot detect.
void draw_fault_of_turn(Case& c, unsigned turn, std::mt19937& random) {
  using enum FaultPart::Kind;
  constexpr FaultPart::Kind kinds[] = {sensor, valve, sensor, muscle, supply};
  const bool wire = turn % 5 == 0;
  std::vector<FaultPart> parts = experiment::fault_parts(c.experiment);
  std::erase_if(parts, [&](const FaultPart& p) {
    return p.kind != kinds[turn % 5] || (wire && !is_angle(c, p));
  });
  if (parts.empty()) parts = experiment::fault_parts(c.experiment);
  std::optional<Fault::What> wanted;
  if (wire && is_angle(c, parts.front()))
    wanted = turn % 2 == 0 ? Fault::What::open : Fault::What::shorted;
  draw_fault(c, parts, wanted, random);
  if (wanted) c.experiment.faults.front().at = in(random, when_it_moves, 2);
}

Case of_script(unsigned seed, std::mt19937& random) {
  Case c{.seed = seed, .experiment = board_scripts()[random() % board_scripts().size()]};
  c.experiment.seed = static_cast<int>(random() % 1'000'000);
  return c;
}

}  // namespace

const std::vector<Experiment>& board_scripts() {
  static const std::vector<Experiment> all{
      experiment::load(sinew::test::source_dir() + "/experiments/kick.toml"),
      experiment::load(sinew::test::source_dir() + "/experiments/leg-in-air.toml",
                       {"sequence.repeat=1"}),
      experiment::load(sinew::test::source_dir() + "/experiments/one-joint.toml",
                       {"sequence.repeat=1"})};
  return all;
}

Case draw(unsigned seed) {
  std::mt19937 random(seed);
  Case c = of_script(seed, random);
  const unsigned kind = random() % 20;
  if (kind < 10) {
    const auto spoil = static_cast<Spoil>(1 + random() % spoils);
    draw_line(c, spoil, random() % 3, random);
  } else if (kind < 19) {
    draw_fault(c, experiment::fault_parts(c.experiment), {}, random);
  } else {
    draw_board(c, 0, random);
  }
  return c;
}

Case draw_by_turns(unsigned seed) {
  std::mt19937 random(seed);
  Case c = of_script(seed, random);
  enum class Kind { line, plant, board, none };
  using enum Kind;
  constexpr Kind round[] = {line, board, plant, none, line, plant, line, plant};
  constexpr unsigned before[] = {0, 0, 0, 0, 1, 1, 2, 2};  // of its kind in this round
  const unsigned place = (seed - 1) % 8, rounds = (seed - 1) / 8, turn = 3 * rounds + before[place];
  switch (round[place]) {
    case line:
      draw_line_of_turn(c, turn, rounds, random);
      break;
    case board:
      draw_board(c, rounds % 3, random);
      break;
    case plant:
      draw_fault_of_turn(c, turn, random);
      break;
    case none:
      c.is_sound = true;
      c.name = "nothing";
  }
  return c;
}

// --- its line -----------------------------------------------------------------------------------

Proxy::Proxy(const Case& c, Monitor& monitor, bool in_lock_step)
    : case_(c),
      monitor_(&monitor),
      in_lock_step_(in_lock_step),
      down_(c.down, c.share, c.seed * 2 + 1),
      up_(c.up, c.share, c.seed * 2 + 2) {}

Tick Proxy::now() const {
  const Tick now = monitor_->now();
  return in_lock_step_ ? (now + period - 1) / period * period : now;
}

bool Proxy::active() const {
  const double t = signals::tick_seconds * static_cast<double>(monitor_->now());
  return runs_ && t >= case_.from && t < case_.from + case_.lasts;
}

bool Proxy::write(const plant::BoardLine& line, std::span<const std::uint8_t> bytes) {
  const bool is_bad = active();
  if (is_bad && down_.kind() == Spoil::silence && silent_from_ < 0)
    silent_from_ = last_word_ + period;
  const std::vector<std::uint8_t> b = down_({bytes.begin(), bytes.end()}, is_bad);
  if (b.empty()) return true;
  last_word_ = now();
  monitor_->host_speaks(last_word_);
  return line.write(b);
}

std::vector<std::uint8_t> Proxy::up(std::vector<std::uint8_t> bytes) {
  return up_(std::move(bytes), active());
}

// --- seeds --------------------------------------------------------------------------------------

int guard_count(int usual) {
  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  return asked ? std::max(1, std::atoi(asked)) : usual;
}

Seeds seeds(int usual) {
  const char* one = std::getenv("SINEW_GUARD_SEED");
  if (one == nullptr) return {1, static_cast<unsigned>(guard_count(usual))};
  const auto seed = static_cast<unsigned>(std::atoi(one));
  return {seed, seed};
}

}  // namespace sinew::run
