// tests/fuzz/law.h - the laws that a harness checks, in addition to "it does not crash".
//
// A harness is one function of namespace sinew::fuzz in <name>_fuzz.cpp. It takes any bytes, and
// throws Broken where a law does not hold; libFuzzer counts that as a crash (entry.cpp), and
// corpus_test.cpp as a failure: that one tries every input of corpus/<name>/ in ./check.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "sinew/config/diagnostics.h"

namespace sinew::fuzz {

struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

inline void law(bool holds, const std::string& words) {
  if (!holds) throw Broken(words);
}

// An error message names the file, the value found and the value expected, on one line for each
// problem.
inline void law_of_refusal(const config::Error& error, std::string_view file) {
  law(!error.problems().empty(), "a refusal says what is wrong");
  for (const config::Problem& p : error.problems()) {
    law(p.where.file == file, "a problem names the file: " + config::to_text(p));
    law(!p.found.empty() && !p.expected.empty(), "found and expected: " + config::to_text(p));
    for (const char c : config::to_text(p))
      law(static_cast<unsigned char>(c) >= ' ', "a line of text a problem: " + config::to_text(p));
  }
}

void toml(std::string_view input);     // config::parse_text
void migrate(std::string_view input);  // config::migrated
void mcap(std::string_view input);     // log::read
void csv(std::string_view input);      // recording::parse_measured, read_table
void predict(std::string_view input);  // config::parse_valve_timing
void gain(std::string_view input);     // config::parse_gains
void out(std::string_view input);      // thesis::parse_out_dat
void set(std::string_view input);      // config::apply_set and experiment::load, a --set a line
void live(std::string_view input);     // live::read_request
void wire(std::string_view input);     // link::Decoder, all messages, link::ThesisByteReader

}  // namespace sinew::fuzz
