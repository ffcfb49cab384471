#include "sinew/live/study_feed.h"

#include <set>

namespace sinew::live {

namespace fs = std::filesystem;

StudyFeed::StudyFeed(const fs::path& file)
    : file_(file), seen_(stamp()), study_(tune::study_view(file)) {
  for (std::size_t i = 0; i < study_.rows.size(); ++i) {
    at_[study_.rows[i].number] = i;
    changes_.push_back(study_.rows[i].number);
  }
}

// Taken before the file is read: what is written while it is read is seen the next time.
StudyFeed::Stamp StudyFeed::stamp() const {
  Stamp out{};
  std::size_t i = 0;
  for (const fs::path& file : {file_, fs::path(file_.string() + "-wal")}) {
    std::error_code none;
    out[i++] = fs::last_write_time(file, none).time_since_epoch().count();
    out[i++] = static_cast<long long>(fs::file_size(file, none));
  }
  return out;
}

void StudyFeed::look() {
  const Stamp now = stamp();
  if (now == seen_) return;
  tune::StudyView next = tune::study_view(file_);
  std::map<std::size_t, std::size_t> at;
  for (std::size_t i = 0; i < next.rows.size(); ++i) {
    const tune::StudyRow& row = next.rows[i];
    at[row.number] = i;
    const auto known = at_.find(row.number);
    if (known == at_.end() || !(study_.rows[known->second] == row)) changes_.push_back(row.number);
  }
  at_ = std::move(at);
  study_ = std::move(next);
  seen_ = now;
}

std::vector<tune::StudyRow> StudyFeed::since(std::size_t known) const {
  std::vector<tune::StudyRow> out;
  std::set<std::size_t> told;
  for (std::size_t i = known; i < changes_.size(); ++i) {
    const auto found = at_.find(changes_[i]);
    if (found != at_.end() && told.insert(changes_[i]).second)
      out.push_back(study_.rows[found->second]);
  }
  return out;
}

}  // namespace sinew::live
