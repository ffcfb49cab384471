#include "sinew/log/deflate.h"

#include <zlib.h>

#include <array>
#include <stdexcept>

namespace sinew::log {
namespace {

// Columns of a log shrink by a third at any level; higher levels only take longer.
constexpr int level = 3;

// zlib's interface takes non-const pointers to input bytes.
Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
}

}  // namespace

std::string deflated(std::string_view bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int done = ::compress2(reinterpret_cast<Bytef*>(out.data()), &size, bytes_of(bytes),
                               static_cast<uLong>(bytes.size()), level);
  if (done != Z_OK) throw std::bad_alloc();  // the only possible failure with enough room
  out.resize(size);
  return out;
}

std::string inflated(std::string_view bytes) {
  z_stream stream{};
  if (::inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  stream.next_in = bytes_of(bytes);
  stream.avail_in = static_cast<uInt>(bytes.size());

  std::string out;
  std::array<char, 1 << 16> part;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = part.size();
    state = ::inflate(&stream, Z_NO_FLUSH);
    out.append(part.data(), part.size() - stream.avail_out);
  }
  const bool whole = state == Z_STREAM_END && stream.avail_in == 0;
  ::inflateEnd(&stream);
  if (!whole) throw std::invalid_argument("not zlib's format, or cut off");
  return out;
}

}  // namespace sinew::log
