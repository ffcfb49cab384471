// control/link/thesis_bytes.h - the bytes that the thesis's two computers exchange [B.2].
//
//   0-2  sendpot        3   sendallpots    5-8  sendgage     9     sendallgages   10  sendallsnrs
//   20-22 enablejoint   23  enableall      24   disableall
//   25   recvffdc       30-32 recvthetades 41-42 recvstiffdes      50  recvalldes
//   255  immediate shutdown
//
// The replies are F, finished, B, bad command, and R, ready for 16 bits. B.2 lists the bytes but
// not the format of values. Here each value is 16 bits, low byte first, and R requests each: angles
// and readings in counts, stiffness in hundredths of lbf in/rad, duties in percent. recvalldes
// takes the angles of joints 0, 1, 2 and the stiffnesses of 1 and 2; gages are flexor and
// extensor of joint 1, then of 2.
//
// A framed message begins and ends this mode. Between words the first byte of a frame, AA, is not a
// word: it and the rest of its frame are passed to the decoder.
//
// Two bytes 255 shut down in every state, except within a frame: between words the first one does;
// as a value FFFF is invalid; and as the second byte of a value the first one makes it invalid, and
// the second one is then between words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/joint/config.h"
#include "sinew/control/joint/state.h"
#include "sinew/control/link/messages.h"

namespace sinew::link {

inline constexpr char finished = 'F', bad_command = 'B', ready_for_16 = 'R';

// The thesis's joints 0, 1, 2, which are cylinder, hip and knee, by the board's numbers.
struct ThesisJoints {
  std::array<std::uint8_t, 3> joint{};
  bool found = false;  // false: another machine, which words do not support
};
ThesisJoints thesis_joints(const control::JointControllerConfig& config) noexcept;

// Result of a byte.
struct ThesisByteResult {
  // Kind of result.
  enum class What : std::uint8_t {
    nothing,   // more bytes are needed, no reply
    frame,     // the byte belongs to a frame: pass it to the decoder
    ready,     // reply R
    bad,       // reply B
    readings,  // reply write_readings(), which ends with F
    enable,    // execute it and reply F, as for all below
    feedforward,
    desired,  // change the setpoints: apply()
    shut_down,
  };
  What what = What::nothing;
  std::uint8_t first = 0, count = 0;  // readings: of pots 0-2 and gages, 3-6
  Enable enable;
  SetFeedforward feedforward;

  // desired: by the board's joints
  std::uint8_t angles = 0, stiffnesses = 0;  // a bit for each given value
  std::array<std::int32_t, control::max_joints> angle{};
  std::array<float, control::max_joints> stiffness{};

  // Changes the given values only.
  void apply(control::Command& command) const noexcept;
};

// Writes the requested readings and F. Returns the size; 0 if `out` is too short.
std::size_t write_readings(const ThesisByteResult& step, const ThesisJoints& joints,
                           const control::JointControllerConfig& config,
                           const control::ControllerState& state,
                           std::span<std::uint8_t> out) noexcept;

// Interprets the thesis's bytes one by one.
class ThesisByteReader {
 public:
  // joints.found must be true.
  explicit ThesisByteReader(const ThesisJoints& joints) noexcept : joints_(joints) {}

  // Takes the next byte.
  ThesisByteResult take(std::uint8_t byte) noexcept;

  // Discards an unfinished value or frame after silence on the line. Returns whether to reply B.
  bool silent() noexcept;

 private:
  static constexpr std::size_t max_values = 5;

  ThesisByteResult frame_byte(std::uint8_t byte) noexcept;
  ThesisByteResult word(std::uint8_t byte) noexcept;
  ThesisByteResult expect(std::uint8_t word, std::uint8_t values) noexcept;
  ThesisByteResult value_byte(std::uint8_t byte) noexcept;
  ThesisByteResult values() noexcept;
  bool possible(std::uint16_t value) const noexcept;
  ThesisByteResult give_up(ThesisByteResult::What what) noexcept;
  void desire_angle(ThesisByteResult& step, std::size_t thesis_joint,
                    std::uint16_t value) const noexcept;
  void desire_stiffness(ThesisByteResult& step, std::size_t thesis_joint,
                        std::uint16_t value) const noexcept;

  ThesisJoints joints_;
  std::uint8_t word_ = 0;              // word that waits for values
  std::uint8_t wanted_ = 0, got_ = 0;  // its number of values, and those received
  std::array<std::uint16_t, max_values> value_{};
  std::uint8_t low_ = 0;
  bool half_ = false;         // the low byte was received
  std::uint16_t framed_ = 0;  // received bytes of the current frame
  std::uint16_t frame_ = 0;   // size of that frame, once its length is known
};

}  // namespace sinew::link
