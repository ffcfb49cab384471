// recording/text.h - the bytes of a file as text in UTF-8, whatever they were written in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/source.h"

namespace sinew::recording {

// A text in UTF-8 without a byte order mark.
struct Text {
  std::string utf8;
  std::vector<std::string> notes;  // what was left out of it
};

// UTF-8 and UTF-16 are recognised; Latin-1 must be said. Throws config::Error for what is no text -
// a workbook, an archive - with what it is, and for bytes of another encoding with their place.
Text text_of_bytes(std::string bytes, const std::string& file, std::string_view encoding = {});

// Returns the bytes of the source's text, or of its file; `what` it holds. Of a run's folder it is
// the table that `sinew export` writes, its columns called as the channels. Throws config::Error,
// before reading where a file is larger than this computer's memory can take.
std::string text_of(const Source& source, std::string_view what);

}  // namespace sinew::recording
