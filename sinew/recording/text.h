// recording/text.h - conversion of a file's bytes to UTF-8 from the supported encodings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/source.h"

namespace sinew::recording {

// Text in UTF-8 without a byte order mark.
struct Text {
  std::string utf8;
  std::vector<std::string> notes;  // parts that were left out of the text
};

// Converts bytes to text. UTF-8 and UTF-16 are recognised; `encoding` must be given for Latin-1.
// Throws config::Error for a file that is not text, such as a workbook or an archive, and gives the
// place of bytes in another encoding.
Text text_of_bytes(std::string bytes, const std::string& file, std::string_view encoding = {});

// Returns the bytes of the source's text or file; `what` names the expected content in messages.
// For a run's folder it returns the table that `sinew export` writes, with columns named like the
// channels. Throws config::Error; a file that is larger than this computer's memory can hold is
// refused before it is read.
std::string text_of(const Source& source, std::string_view what);

}  // namespace sinew::recording
