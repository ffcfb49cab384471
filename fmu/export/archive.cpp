#include "fmu/export/archive.h"

#include <minizip/zip.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace sinew::fmu {

namespace {

// File in memory, for minizip's I/O functions.
struct Memory {
  std::string bytes;
  std::size_t at = 0;
};

Memory& memory(void* stream) { return *static_cast<Memory*>(stream); }

void* open_memory(void* opaque, const void*, int) { return opaque; }

uLong read_memory(void*, void* stream, void* out, uLong size) {
  Memory& m = memory(stream);
  const std::size_t count = std::min<std::size_t>(size, m.bytes.size() - m.at);
  std::memcpy(out, m.bytes.data() + m.at, count);
  m.at += count;
  return count;
}

uLong write_memory(void*, void* stream, const void* from, uLong size) {
  Memory& m = memory(stream);
  if (m.bytes.size() < m.at + size) m.bytes.resize(m.at + size);
  std::memcpy(m.bytes.data() + m.at, from, size);
  m.at += size;
  return size;
}

ZPOS64_T tell_memory(void*, void* stream) { return memory(stream).at; }

long seek_memory(void*, void* stream, ZPOS64_T offset, int origin) {
  Memory& m = memory(stream);
  std::size_t from = 0;
  if (origin == ZLIB_FILEFUNC_SEEK_CUR) from = m.at;
  if (origin == ZLIB_FILEFUNC_SEEK_END) from = m.bytes.size();
  m.at = from + offset;
  return m.at <= m.bytes.size() ? 0 : -1;
}

int close_memory(void*, void*) { return 0; }
int error_of_memory(void*, void*) { return 0; }

void add(zipFile zip, const ArchiveFile& file) {
  zip_fileinfo info{};
  info.dosDate = 0x00210000;  // 1980-01-01, the earliest date of a zip archive
  bool good = zipOpenNewFileInZip(zip, file.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                                  Z_DEFLATED, Z_DEFAULT_COMPRESSION) == ZIP_OK;
  good = good && zipWriteInFileInZip(zip, file.bytes.data(),
                                     static_cast<unsigned>(file.bytes.size())) == ZIP_OK;
  good = good && zipCloseFileInZip(zip) == ZIP_OK;
  if (!good) throw std::runtime_error("cannot put " + file.name + " into the archive");
}

}  // namespace

std::string archive_of(const std::vector<ArchiveFile>& files) {
  Memory out;
  zlib_filefunc64_def functions{open_memory, read_memory,  write_memory,    tell_memory,
                                seek_memory, close_memory, error_of_memory, &out};
  const zipFile zip = zipOpen2_64("memory", APPEND_STATUS_CREATE, nullptr, &functions);
  if (!zip) throw std::runtime_error("cannot begin a zip archive");
  try {
    for (const ArchiveFile& file : files) add(zip, file);
  } catch (...) {
    zipClose(zip, nullptr);
    throw;
  }
  if (zipClose(zip, nullptr) != ZIP_OK) throw std::runtime_error("cannot end the zip archive");
  return std::move(out.bytes);
}

}  // namespace sinew::fmu
