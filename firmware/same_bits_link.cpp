// firmware/same_bits_link.cpp - self-test of the wire: random telemetry, commands and a
// configuration are sent as frames over a line that damages some of them, and are decoded; all that
// is sent and received goes into the hash.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/same_bits.h"
#include "sinew/control/joint/test_leg.h"
#include "sinew/control/link/baud.h"
#include "sinew/control/link/command_queue.h"
#include "sinew/control/link/configuration.h"
#include "sinew/control/link/telemetry.h"
#include "sinew/control/link/thesis_bytes.h"

namespace sinew::firmware {
namespace {

// Visitor that fills a message with random valid values.
class RandomFields {
 public:
  static constexpr bool reads = true;

  explicit RandomFields(Random& random) : random_(&random) {}

  template <class T>
  void whole(T& x) {
    std::uint64_t bits = random_->below(1u << 24);
    bits = bits << 24 ^ random_->below(1u << 24);
    bits = bits << 24 ^ random_->below(1u << 24);
    x = std::bit_cast<T>(static_cast<link::as_bits::Of<T>>(bits));
  }
  template <class T>
  void limited(T& x, T low, T) {
    x = static_cast<T>(low + static_cast<T>(random_->below(2)));
  }
  void finite(float& x) { x = 1000.0f * random_->unit() - 300.0f; }

 private:
  Random* random_;
};

void add(Hash& hash, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t b : bytes) hash.add(std::uint32_t{b});
}

// Both ends of a line.
struct Ends {
  link::Decoder decoder;
  link::TelemetryJoiner joiner{100};
  link::CommandQueue queue{100};
  std::uint8_t sequence = 0;

  void carry(link::Type type, const link::Body& body, Random& random, Hash& hash) {
    std::array<std::uint8_t, link::max_frame> frame{};
    const std::size_t size =
        link::encode(static_cast<std::uint8_t>(type), {1, sequence++}, body.span(), frame);
    if (random.below(8) == 0) frame[random.below(static_cast<std::uint32_t>(size))] ^= 4u;
    add(hash, std::span(frame).first(size));
    decoder.push(std::span(frame).first(size));
    if (random.below(4) == 0) decoder.silent();
    while (const link::Frame* f = decoder.next()) receive(*f, hash);
  }

  void receive(const link::Frame& f, Hash& hash) {
    add(hash, f.body);
    link::CommandFor command;
    if (link::decode(f, command) == link::Code::done)
      hash.add(static_cast<std::uint32_t>(queue.put(command, command.from - 100)));
    const link::Telemetry* t = joiner.take(f.type, f.body);
    if (t) add(hash, link::part_of(*t, 1).body.span());
  }
};

void run_telemetry(Random& random, Ends& ends, Hash& hash) {
  RandomFields random_fields(random);
  for (signals::Tick tick = 0; tick < 20'000; tick += 100) {
    link::Telemetry t{.tick = tick, .joints = 5, .channels = 19};
    for (control::JointState& j : t.controller.joint) link::fields(random_fields, j);
    for (control::SensorStatistics& s : t.supervised.sensor) link::fields(random_fields, s);
    link::fields(random_fields, t.supervised.trip);
    for (std::uint8_t p = 0; p < link::parts_of(t.joints, t.channels); ++p) {
      const link::TelemetryMessage m = link::part_of(t, p);
      ends.carry(m.type, m.body, random, hash);
    }
    link::CommandFor command{.from = tick + 100, .joints = 5};
    for (control::JointCommand& c : command.joint) link::fields(random_fields, c);
    ends.carry(link::Type::command, link::body_of(command), random, hash);
    hash.add(std::uint32_t{ends.queue.at(tick + 100) != nullptr});
  }
  hash.add(ends.joiner.lost());
  hash.add(ends.decoder.line().crc16);
}

void run_configuration(Hash& hash) {
  const link::Configuration sent{control::test_leg(), {}};
  const link::ConfigurationSender sender(sent);
  link::ConfigurationReceiver receiver;
  hash.add(static_cast<std::uint32_t>(receiver.take(sender.begin())));
  for (std::size_t i = 0; i < link::ConfigurationSender::chunks; ++i)
    hash.add(static_cast<std::uint32_t>(receiver.take(sender.chunk(i))));
  link::Configuration got;
  hash.add(static_cast<std::uint32_t>(receiver.take(sender.end(), got).code));
  hash.add(link::ConfigurationSender(got).crc());
  constexpr std::uint32_t choices[] = {115'200, 921'600, 2'000'000};
  hash.add(link::choose_baud(got.joint_controller, true, choices));
}

void run_words(Random& random, Hash& hash) {
  link::ThesisByteReader reader(link::thesis_joints(control::test_leg()));
  control::Command command;
  for (int i = 0; i < 5000; ++i) {
    const link::ThesisByteResult step = reader.take(
        static_cast<std::uint8_t>(random.below(2) ? random.below(60) : random.below(256)));
    step.apply(command);
    hash.add(static_cast<std::uint32_t>(step.what));
    hash.add(command.joint[0].stiffness);
    hash.add(command.joint[1].angle);
  }
}

}  // namespace

void run_link(std::uint32_t seed, Hash& hash) {
  Random random(seed);
  Ends ends;
  run_telemetry(random, ends, hash);
  run_configuration(hash);
  run_words(random, hash);
}

}  // namespace sinew::firmware
