#include "sinew/run/muscle/save.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "sinew/units/hash.h"

namespace sinew::run {

namespace {

using State = air::DrivenMuscle::State;

// The header stands before the state in a save.
struct Header {
  char format[16] = "sinew.muscle/1";
  std::uint64_t model = 0;     // of the description and the library's version
  std::uint64_t checksum = 0;  // of the state
};

std::uint64_t model_of(const MuscleSetup& setup) {
  const std::uint64_t parts[] = {setup.model, sizeof(State)};
  return units::hash(std::as_bytes(std::span(parts)), units::hash(SINEW_VERSION));
}

[[noreturn]] void refuse(const char* what) { throw std::invalid_argument(what); }

}  // namespace

std::vector<std::byte> save(const air::DrivenMuscle& muscle, const MuscleSetup& setup) {
  std::vector<std::byte> out(sizeof(Header) + sizeof(State));
  const std::span<std::byte> state = std::span(out).subspan(sizeof(Header));
  std::memcpy(state.data(), &muscle.state(), sizeof(State));
  const Header header{.model = model_of(setup), .checksum = units::hash(state)};
  std::memcpy(out.data(), &header, sizeof header);
  return out;
}

void restore(air::DrivenMuscle& muscle, const MuscleSetup& setup,
             std::span<const std::byte> saved) {
  Header header;
  if (saved.size() < sizeof header) refuse("save: found too few bytes for one");
  std::memcpy(&header, saved.data(), sizeof header);
  saved = saved.subspan(sizeof header);
  if (std::memcmp(header.format, Header{}.format, sizeof header.format) != 0)
    refuse("save: found something else; expected what save() of a driven muscle gave");
  if (header.model != model_of(setup))
    refuse(
        "save: found that of another muscle, or of another version of Sinew; expected one of the "
        "same description");
  if (saved.size() != sizeof(State) || units::hash(saved) != header.checksum)
    refuse("save: found it cut off or spoilt");
  State state;
  std::memcpy(&state, saved.data(), sizeof state);
  muscle.restore(state);
}

}  // namespace sinew::run
