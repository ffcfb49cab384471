#include "cli/table_options.h"

namespace sinew::cli {

namespace {

// Adds the options that describe its columns.
void add_column_options(CLI::App& sub, TableOptions& options) {
  sub.add_option("--map", options.maps,
                 "NAME=COLUMN: the file's name for a column of the method, force=F_N, or for a "
                 "channel, /joint/elbow/angle=Winkel; may be repeated")
      ->allow_extra_args(false)
      ->group(table_heading);
  sub.add_option("--unit", options.units,
                 "COLUMN=UNIT: of its numbers, where its header has no unit; may be repeated")
      ->allow_extra_args(false)
      ->group(table_heading);
  sub.add_option("--where", options.where,
                 "COLUMN=VALUE,...: only rows whose column has one of these values; may be "
                 "repeated")
      ->allow_extra_args(false)
      ->group(table_heading);
  sub.add_option("--value", options.values,
                 "[PART:]NAME=VALUE: of a column or channel that a file does not have, \"length=80 "
                 "mm\"; with PART only for files with PART in their name, \"p2:pressure=2 bar "
                 "gauge\"; may be repeated")
      ->allow_extra_args(false)
      ->group(table_heading);
  sub.add_option("--offset", options.offsets,
                 "NAME=VALUE: added to a column, \"length=200 mm\"; NAME is the method's, for "
                 "import the file's; may be repeated")
      ->allow_extra_args(false)
      ->group(table_heading);
  sub.add_option("--columns", options.columns,
                 "\"force [N],time [s]\": the header of a file that has no header")
      ->group(table_heading);
}

// Adds those that most files make unnecessary.
void add_dialect_options(CLI::App& sub, recording::TableSettings& settings) {
  sub.add_option("--encoding", settings.encoding, "of a file whose letters do not show it")
      ->check(one_of({"utf-8", "utf-16le", "utf-16be", "latin1"}))
      ->group(table_heading);
  sub.add_option("--decimal", settings.decimal,
                 "the decimal mark, where the numbers do not show it")
      ->check(one_of({".", ","}))
      ->group(table_heading);
  sub.add_option("--thousands", settings.thousands, "the mark between groups of three digits")
      ->check(one_of({".", ",", " ", "'"}))
      ->group(table_heading);
  sub.add_option("--dates", settings.dates,
                 "what comes first in 11/03/2026, or excel for days since 1900")
      ->check(one_of({"day first", "month first", "excel"}))
      ->group(table_heading);
}

// Its rows and their times.
void add_row_options(CLI::App& sub, TableOptions& options) {
  sub.add_option("--rate", options.rate,
                 "of the rows, \"100 Hz\" or \"10 ms\", in place of a column of times")
      ->group(table_heading);
  sub.add_option("--part", options.settings.part,
                 "of several recordings in a file, one after the other, the first is 1")
      ->transform(between(1, 1000000))
      ->group(table_heading);
  sub.add_flag("--spread-times", options.settings.spread_times,
               "spread rows that share a time evenly up to the next time")
      ->group(table_heading);
  sub.add_flag("--drop-incomplete", options.settings.drop_incomplete,
               "leave out rows with cells that are empty or no numbers, and count them")
      ->group(table_heading);
}

}  // namespace

void add_table_options(CLI::App& sub, TableOptions& options) {
  add_column_options(sub, options);
  add_row_options(sub, options);
  add_dialect_options(sub, options.settings);
}

}  // namespace sinew::cli
