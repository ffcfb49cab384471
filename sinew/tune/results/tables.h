// tune/results/tables.h - the tables of a study's file, as docs/reference/study-file.md has them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/tune/results/asked.h"
#include "sinew/tune/results/database.h"

namespace sinew::tune {

// Returns false for a database without tables. Throws config::Error for one of another program, and
// for tables of a format that this version does not know.
bool has_study(Database& database, const std::filesystem::path& file);

// Makes all of them at once, with what is asked for. The view `run` has a column of numbers or of
// words for each cell, called as its heading; one that would be there twice has a number behind it.
void make_tables(Database& database, const Asked& asked);

// Writes the checksum of all but the rows into the table `study`, after a change.
void write_checksum(Database& database);

// Returns what the file says was asked for. Throws log::Error for a damaged one.
Asked study_of(Database& database, const std::filesystem::path& file);

// A list of texts as JSON; text need not be UTF-8. texts_of() throws log::Error for what is none.
std::string json_of(const std::vector<std::string>& texts);
std::vector<std::string> texts_of(const std::string& json, const std::filesystem::path& file);

}  // namespace sinew::tune
