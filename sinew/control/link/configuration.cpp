#include "sinew/control/link/configuration.h"

#include "sinew/signals/crc.h"

namespace sinew::link {
namespace {

constexpr std::size_t counted() noexcept {
  Sizer io;
  const Configuration any;
  fields(io, any);
  return io.size();
}
static_assert(counted() == configuration_size, "its fields have another size");

}  // namespace

bool write(const Configuration& configuration, ConfigurationBytes& out) noexcept {
  Writer to(out);
  fields(to, configuration);
  return to.ok();
}

Refusal read(std::span<const std::uint8_t> bytes, Configuration& out) noexcept {
  const Code code = read<Configuration>(bytes, out);
  if (code == Code::length) return {Code::size};
  if (code != Code::done) return {Code::layout};
  for (const char* words :
       {control::problem(out.joint_controller), control::safety_problem(out.joint_controller),
        control::problem(out.limits), control::problem(out.safety)})
    if (words != nullptr) return {Code::configuration, words};
  return {};
}

ConfigurationSender::ConfigurationSender(const Configuration& configuration) noexcept {
  ok_ = write(configuration, bytes_);
  crc_ = signals::crc32(bytes_);
}

ConfigureBegin ConfigurationSender::begin() const noexcept {
  return {.bytes = configuration_size, .crc = crc_};
}

ConfigureChunk ConfigurationSender::chunk(std::size_t i) const noexcept {
  ConfigureChunk out{.offset = static_cast<std::uint16_t>(i * max_chunk)};
  const std::size_t left = configuration_size - out.offset;
  out.count = static_cast<std::uint8_t>(left < max_chunk ? left : max_chunk);
  for (std::size_t k = 0; k < out.count; ++k) out.data[k] = bytes_[out.offset + k];
  return out;
}

Code ConfigurationReceiver::refuse(Code why) noexcept {
  forget();
  return why;
}

Code ConfigurationReceiver::take(const ConfigureBegin& begin) noexcept {
  if (begun_) return refuse(Code::order);
  if (begin.bytes != configuration_size) return refuse(Code::size);
  begun_ = true;
  size_ = 0;
  crc_ = begin.crc;
  return Code::done;
}

Code ConfigurationReceiver::take(const ConfigureChunk& chunk) noexcept {
  if (!begun_) return Code::order;
  if (chunk.offset != size_) return refuse(Code::gap);
  if (chunk.count > configuration_size - size_) return refuse(Code::size);
  for (std::size_t i = 0; i < chunk.count; ++i) bytes_[size_++] = chunk.data[i];
  return Code::done;
}

Code ConfigurationReceiver::check(const ConfigureEnd& end) const noexcept {
  if (!begun_) return Code::order;
  if (size_ != configuration_size) return Code::size;
  if (end.crc != crc_ || signals::crc32(bytes_) != crc_) return Code::checksum;
  return Code::done;
}

Refusal ConfigurationReceiver::take(const ConfigureEnd& end, Configuration& out) noexcept {
  const Code code = check(end);
  forget();
  return code == Code::done ? read(bytes_, out) : Refusal{code};
}

}  // namespace sinew::link
