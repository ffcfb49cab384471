// config/reported.h - figure that a source reports, [[reported]] in an experiment. The analysis
// compares the result with it (analysis/verdict/reported.h). docs/evidence/evidence.md defines
// classes, wordings and verdicts.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::config {

// Class of a statement: the evidence that agreement provides.
enum class StatementClass {
  none,               // not given: not judged, or the file is older than classes
  predicted,          // no part was fitted or put in
  fitted,             // one of our parameters was chosen for agreement
  put_in,             // our model was built with it
  by_construction,    // true for any numbers: an identity, a definition, a bound of the range
  code_against_code,  // identical equations computed twice
};

inline const std::initializer_list<units::Choice<StatementClass>> statement_classes = {
    {"predicted", StatementClass::predicted},
    {"fitted", StatementClass::fitted},
    {"put in", StatementClass::put_in},
    {"by construction", StatementClass::by_construction},
    {"code against code", StatementClass::code_against_code}};

// Wording of the source, which determines the figure's band (analysis/verdict/band.h).
enum class Wording {
  another,  // a band of our own, with its reason
  measured,
  percentage,
  about,
  negligible,
  noticeable,
  small,
  substantial,
  much_less,
  much_more,
  range,
  computed,
};

inline const std::initializer_list<units::Choice<Wording>> wordings = {
    {"measured", Wording::measured},
    {"percentage", Wording::percentage},
    {"about", Wording::about},
    {"negligible", Wording::negligible},
    {"noticeable", Wording::noticeable},
    {"small", Wording::small},
    {"substantial", Wording::substantial},
    {"much less", Wording::much_less},
    {"much more", Wording::much_more},
    {"range", Wording::range},
    {"computed", Wording::computed}};

// Returns the word of a value; `otherwise`, "another band" or "-", if it has none.
template <class Enum>
std::string_view word_of(Enum value, std::initializer_list<units::Choice<Enum>> words,
                         std::string_view otherwise) {
  for (const units::Choice<Enum>& choice : words)
    if (choice.value == value) return choice.word;
  return otherwise;
}
inline std::string_view to_text(StatementClass c) { return word_of(c, statement_classes, "-"); }
inline std::string_view to_text(Wording w) { return word_of(w, wordings, "another band"); }

struct Reported {
  std::string key;                  // key in summary.json, "trolley.distance_m"
  std::string value;                // as reported, free text that ends with the unit
  std::vector<std::string> accept;  // lowest and highest that agree; empty: see `wording`
  std::string source;
  std::string because;  // why a deviation is expected; empty: it should agree
  StatementClass statement_class = StatementClass::none;
  Wording wording = Wording::another;  // without an `accept`: not judged
  std::string of;                      // reference of a negligible, a substantial, … figure
  std::string reading_error;           // error of the source's figure; empty: none
  std::string band_reason;             // reason for `accept`
  bool changed = false;                // changed by --set: the source describes the unchanged run
};

// Returns whether the figure has a band to be judged by.
inline bool is_judged(const Reported& r) {
  return !r.accept.empty() || r.wording != Wording::another;
}

// Visits the keys of one [[reported]].
template <class Visitor>
void fields(Visitor& v, Reported& r) {
  v.text({.name = "key", .doc = "key of summary.json"}, r.key);
  v.text({.name = "value", .doc = "value as reported, with its unit"}, r.value);
  v.choice({.name = "class",
            .optional = true,
            .doc = "evidence that agreement provides; needed to judge"},
           r.statement_class, statement_classes);
  v.choice({.name = "wording",
            .optional = true,
            .doc = "wording of the source, which determines the band"},
           r.wording, wordings);
  v.text({.name = "of",
          .optional = true,
          .doc = "reference of a share, for example of a negligible one"},
         r.of);
  v.text({.name = "reading_error", .optional = true, .doc = "error of the reported value"},
         r.reading_error);
  v.texts({.name = "accept",
           .optional = true,
           .doc = "lowest and highest value that agree, in place of the wording's band"},
          r.accept);
  v.text({.name = "band_reason", .optional = true, .doc = "reason for `accept`"}, r.band_reason);
  v.text({.name = "source", .doc = "where the value is reported"}, r.source);
  v.text({.name = "because", .optional = true, .doc = "reason for an expected difference"},
         r.because);
}

// Adds a problem for a judged figure without a class. Experiments in older logs have none.
template <class Visitor>
void check_class(Visitor& v, const Reported& r) {
  if (!is_judged(r)) return;
  if (r.statement_class == StatementClass::none) {
    std::string words;
    for (const auto& choice : statement_classes)
      words += (words.empty() ? "\"" : ", \"") + std::string(choice.word) + '"';
    units::report_conflict(v, "class", "nothing",
                           "what agreement with " + r.key + " is worth: " + words,
                           "docs/evidence/evidence.md");
  }
  if (!r.accept.empty() && r.wording != Wording::another)
    units::report_conflict(v, "accept", "both a band and a wording, which has a band of its own",
                           "one of the two");
  if (!r.accept.empty() && r.band_reason.empty())
    units::report_conflict(v, "band_reason", "nothing", "why the band of " + r.key + " is as it is",
                           "a wording in place of accept");
}

}  // namespace sinew::config
