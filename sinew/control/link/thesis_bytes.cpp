#include "sinew/control/link/thesis_bytes.h"

#include "sinew/control/link/frame.h"

namespace sinew::link {

using What = ThesisByteResult::What;

namespace {

enum Word : std::uint8_t {
  sendpot = 0,
  sendallpots = 3,
  sendgage = 5,
  sendallgages = 9,
  sendallsnrs = 10,
  enablejoint = 20,
  enableall = 23,
  disableall = 24,
  recvffdc = 25,
  recvthetades = 30,
  recvstiffdes = 41,  // for joint 1
  recvalldes = 50,
  immediate_shutdown = 255,
};

constexpr std::uint8_t pots = 3, gages = 4;
constexpr std::uint16_t no_value = 0xffff;
constexpr std::uint16_t max_hundredths = 0x7fff;  // unit: lbf in/rad

ThesisByteResult readings(std::uint8_t first, std::uint8_t count) noexcept {
  return {.what = What::readings, .first = first, .count = count};
}

std::uint8_t bit(std::uint8_t joint) noexcept { return static_cast<std::uint8_t>(1u << joint); }

// Returns the channel: pots 0-2, then flexor and extensor of joint 1, and of joint 2.
signals::Channel channel_of(std::size_t sensor, const ThesisJoints& joints,
                            const control::JointControllerConfig& config) noexcept {
  if (sensor < pots) return config.joint[joints.joint[sensor]].angle;
  const std::size_t gage = sensor - pots;
  const control::JointConfig& joint = config.joint[joints.joint[1 + gage / 2]];
  return gage % 2 == 0 ? joint.flexor.tension : joint.extensor.tension;
}

}  // namespace

ThesisJoints thesis_joints(const control::JointControllerConfig& config) noexcept {
  ThesisJoints out;
  std::size_t cylinders = 0, others = 0;
  if (config.joints != out.joint.size()) return out;
  for (std::uint8_t j = 0; j < config.joints; ++j) {
    if (config.joint[j].kind == control::JointKind::cylinder)
      out.joint[0] = j, ++cylinders;
    else if (++others <= 2)
      out.joint[others] = j;
  }
  out.found = cylinders == 1;
  return out;
}

void ThesisByteResult::apply(control::Command& command) const noexcept {
  for (std::uint8_t j = 0; j < control::max_joints; ++j) {
    if (angles & bit(j)) command.joint[j].angle = angle[j];
    if (stiffnesses & bit(j)) command.joint[j].stiffness = stiffness[j];
  }
}

std::size_t write_readings(const ThesisByteResult& step, const ThesisJoints& joints,
                           const control::JointControllerConfig& config,
                           const control::ControllerState& state,
                           std::span<std::uint8_t> out) noexcept {
  Writer to(out);
  for (std::size_t i = 0; i < step.count; ++i)
    to.whole(state.reading[channel_of(step.first + i, joints, config).index].counts);
  to.whole(static_cast<std::uint8_t>(finished));
  return to.ok() ? to.size() : 0;
}

ThesisByteResult ThesisByteReader::take(std::uint8_t byte) noexcept {
  if (framed_ > 0) return frame_byte(byte);
  return wanted_ > 0 ? value_byte(byte) : word(byte);
}

bool ThesisByteReader::silent() noexcept {
  framed_ = 0;
  const bool waited = wanted_ > 0;
  wanted_ = 0;
  return waited;
}

ThesisByteResult ThesisByteReader::frame_byte(std::uint8_t byte) noexcept {
  if (framed_ == 1 && byte != sync_second) {  // not a frame
    framed_ = 0;
    return word(byte);
  }
  if (++framed_ == header_size)
    frame_ = static_cast<std::uint16_t>(header_size + byte + crc16_size);
  if (framed_ > header_size && framed_ == frame_) framed_ = 0;
  return {.what = What::frame};
}

ThesisByteResult ThesisByteReader::word(std::uint8_t byte) noexcept {
  if (byte < sendpot + pots) return readings(byte, 1);
  if (byte == sendallpots) return readings(0, pots);
  if (byte >= sendgage && byte < sendgage + gages)
    return readings(static_cast<std::uint8_t>(pots + byte - sendgage), 1);
  if (byte == sendallgages) return readings(pots, gages);
  if (byte == sendallsnrs) return readings(0, pots + gages);
  if (byte >= enablejoint && byte <= disableall) {
    const std::uint8_t all = static_cast<std::uint8_t>(
        bit(joints_.joint[0]) | bit(joints_.joint[1]) | bit(joints_.joint[2]));
    const bool one = byte < enableall;
    return {.what = What::enable,
            .enable = {.joints = one ? bit(joints_.joint[byte - enablejoint]) : all,
                       .enabled = byte != disableall}};
  }
  if (byte == recvffdc) return expect(byte, 4);
  if (byte >= recvthetades && byte < recvthetades + 3) return expect(byte, 1);
  if (byte == recvstiffdes || byte == recvstiffdes + 1) return expect(byte, 1);
  if (byte == recvalldes) return expect(byte, 5);
  if (byte == immediate_shutdown) return {.what = What::shut_down};
  if (byte == sync_first) {
    framed_ = 1;
    return {.what = What::frame};
  }
  return {.what = What::bad};
}

ThesisByteResult ThesisByteReader::expect(std::uint8_t word, std::uint8_t values) noexcept {
  word_ = word;
  wanted_ = values;
  got_ = 0;
  half_ = false;
  return {.what = What::ready};
}

ThesisByteResult ThesisByteReader::give_up(What what) noexcept {
  wanted_ = 0;
  return {.what = what};
}

ThesisByteResult ThesisByteReader::value_byte(std::uint8_t byte) noexcept {
  if (!half_) {
    low_ = byte;
    half_ = true;
    return {};
  }
  half_ = false;
  const std::uint16_t value = static_cast<std::uint16_t>(low_ | byte << 8);
  if (value == no_value) return give_up(What::shut_down);
  if (!possible(value)) return give_up(What::bad);
  value_[got_++] = value;
  if (got_ < wanted_) return {.what = What::ready};
  wanted_ = 0;
  return values();
}

bool ThesisByteReader::possible(std::uint16_t value) const noexcept {
  if (word_ == recvffdc) return value <= signals::max_duty;
  const bool is_stiffness =
      word_ == recvstiffdes || word_ == recvstiffdes + 1 || (word_ == recvalldes && got_ >= 3);
  return value <= (is_stiffness ? max_hundredths : signals::max_counts);
}

void ThesisByteReader::desire_angle(ThesisByteResult& step, std::size_t thesis_joint,
                                    std::uint16_t value) const noexcept {
  const std::uint8_t j = joints_.joint[thesis_joint];
  step.angles = static_cast<std::uint8_t>(step.angles | bit(j));
  step.angle[j] = value;
}

void ThesisByteReader::desire_stiffness(ThesisByteResult& step, std::size_t thesis_joint,
                                        std::uint16_t value) const noexcept {
  const std::uint8_t j = joints_.joint[thesis_joint];
  step.stiffnesses = static_cast<std::uint8_t>(step.stiffnesses | bit(j));
  step.stiffness[j] = static_cast<float>(value) / 100.0f;
}

// Returns the result of a word with all its values.
ThesisByteResult ThesisByteReader::values() noexcept {
  if (word_ == recvffdc)
    return {.what = What::feedforward,
            .feedforward = {.joint = joints_.joint[0],
                            .duties = {value_[0], value_[1], value_[2], value_[3]}}};
  ThesisByteResult out{.what = What::desired};
  if (word_ == recvalldes) {
    for (std::size_t j = 0; j < 3; ++j) desire_angle(out, j, value_[j]);
    for (std::size_t j = 1; j < 3; ++j) desire_stiffness(out, j, value_[2 + j]);
  } else if (word_ < recvstiffdes) {
    desire_angle(out, static_cast<std::size_t>(word_ - recvthetades), value_[0]);
  } else {
    desire_stiffness(out, static_cast<std::size_t>(word_ - recvstiffdes + 1), value_[0]);
  }
  return out;
}

}  // namespace sinew::link
