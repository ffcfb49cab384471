#include "sinew/live/live_view.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "sinew/json/json.h"
#include "sinew/report/page/page.h"
#include "sinew/run/simulation/run.h"
#include "sinew/signals/tick.h"

namespace sinew::live {

Feed::Feed(std::vector<signals::Topic> topics, std::size_t ring)
    : ring_(ring), row_(topics.size()) {
  for (std::size_t i = 0; i < topics.size(); ++i) {
    is_edge_.push_back(signals::is_of_valve(topics[i].name));
    (is_edge_.back() ? edge_topics_ : row_topics_).push_back(i);
    const std::size_t fields = topics[i].fields.size();
    table_.series.push_back({std::move(topics[i]), signals::Times(pages_),
                             std::vector<signals::Column>(fields, signals::Column(pages_))});
  }
}

void Feed::push(std::size_t topic, std::int64_t time_ns, std::span<const double> values) noexcept {
  log::Sample sample{time_ns, static_cast<std::uint16_t>(topic), {}};
  std::copy_n(values.begin(), std::min(values.size(), sample.values.size()), sample.values.begin());
  if (!ring_.put(sample)) left_out_.fetch_add(1, std::memory_order_relaxed);
}

std::vector<signals::Topic> Feed::topics() const {
  std::vector<signals::Topic> out;
  for (const signals::Series& s : table_.series) out.push_back(s.topic);
  return out;
}

void Feed::collect() {
  ring_.take_all([this](const log::Sample& sample) { take(sample); });
}

void Feed::take(const log::Sample& sample) {
  if (sample.topic >= is_edge_.size()) return;
  if (is_edge_[sample.topic]) {
    signals::Series& s = table_.series[sample.topic];
    s.time_ns.push_back(sample.time_ns);
    s.columns[0].push_back(sample.values[0]);
    return;
  }
  if (sample.time_ns != row_time_ns_) {  // an incomplete row is dropped
    row_time_ns_ = sample.time_ns;
    filled_ = 0;
  }
  row_[sample.topic] = sample;
  if (++filled_ == row_topics_.size()) keep_row();
}

void Feed::keep_row() {
  for (const std::size_t i : row_topics_) {
    signals::Series& s = table_.series[i];
    s.time_ns.push_back(row_time_ns_);
    for (std::size_t c = 0; c < s.columns.size(); ++c) s.columns[c].push_back(row_[i].values[c]);
  }
  ++rows_;
}

signals::Table Feed::since(Position& position) const {
  position.edges.resize(edge_topics_.size(), 0);
  signals::Table out;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < table_.series.size(); ++i) {
    const signals::Series& s = table_.series[i];
    std::size_t& from = is_edge_[i] ? position.edges[edge++] : position.rows;
    const auto first = static_cast<std::ptrdiff_t>(from);
    signals::Series part{s.topic, {s.time_ns.begin() + first, s.time_ns.end(), pages_}, {}};
    for (const signals::Column& column : s.columns)
      part.columns.emplace_back(column.begin() + first, column.end(), pages_);
    if (is_edge_[i]) from = s.time_ns.size();
    out.series.push_back(std::move(part));
  }
  position.rows = rows_;
  return out;
}

namespace {

using What = gait::Setting::What;

constexpr double whole_turn = 2 * std::numbers::pi;  // [rad]

// The name of a kind of setting on the page, and the range of its slider if the plan has only
// zeros: about the largest value of the thesis.
struct Shown {
  std::string_view name;
  double usual;
};
const Shown& shown(What what) {
  static constexpr Shown of_kind[] = {{"desired angle", whole_turn},  // [rad]
                                      {"desired stiffness", 4},       // [N m/rad]
                                      {"angle gain", 0.01},           // [1/count]
                                      {"stiffness gain", 0.05},       // [1/(N m/rad)]
                                      {"velocity gain", 5e-4}};       // [s/count]
  return of_kind[static_cast<std::size_t>(what)];
}

const gait::Profile& profile_of(const gait::JointPhase& phase, What what) {
  if (what == What::angle_gain) return phase.gains.angle;
  if (what == What::stiffness_gain) return phase.gains.stiffness;
  return what == What::velocity_gain ? phase.gains.velocity : phase.stiffness;
}

double from_start(const gait::JointPlan& joint, What what) {
  if (what == What::angle_gain) return joint.gains.angle;
  if (what == What::stiffness_gain) return joint.gains.stiffness;
  return what == What::velocity_gain ? joint.gains.velocity : joint.stiffness;
}

bool has_foot_path(const gait::Plan& plan) {
  return std::ranges::any_of(plan.phases, [](const gait::Phase& p) { return p.has_path(); });
}

double end_of(const experiment::Experiment& e) {
  return static_cast<double>(experiment::last_tick(e)) * signals::tick_seconds;
}

}  // namespace

double largest(const gait::Plan& plan, const gait::Setting& s) {
  if (s.what == What::angle) return whole_turn / 3;
  double out = from_start(plan.joints[s.joint], s.what);
  for (const gait::Phase& phase : plan.phases)
    if (s.joint < phase.joints.size())
      for (const double v : profile_of(phase.joints[s.joint], s.what)) out = std::max(out, v);
  return out;
}

LiveView::LiveView(const experiment::Experiment& e, const config::Node& resolved,
                   run::Steering& steering, Feed& feed, const std::atomic<std::int64_t>& tick,
                   std::atomic<bool>* stop, const std::string& units)
    : experiment_(e),
      steering_(steering),
      feed_(feed),
      tick_(tick),
      stop_(stop),
      settings_(gait::settings(e.plan)),
      page_(feed.topics(), {.resolved = resolved,
                            .name = e.name,
                            .duration = end_of(e),
                            .foot_path = has_foot_path(e.plan),
                            .units = units}),
      set_(settings_.size()) {}

std::string LiveView::controls() const {
  Json out = Json::array();
  for (const gait::Setting& s : settings_) {
    const double most = largest(experiment_.plan, s);
    out.push_back({{"key", s.key},
                   {"joint", experiment_.plan.joints[s.joint].name},
                   {"what", shown(s.what).name},
                   {"unit", s.unit},
                   {"most", most > 0 ? 3 * most : shown(s.what).usual}});
  }
  return Json{{"controls", std::move(out)}}.text();
}

std::string LiveView::page(std::string_view server) const {
  report::Content content = page_.content(controls());
  content.connect = "; connect-src ws://" + std::string(server);
  return report::fill(report::page_template(), content);
}

std::string LiveView::state() const {
  Json values = Json::array(), overridden = Json::array();
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    values.push_back(steering_.value(i));
    overridden.push_back(steering_.overridden(i));
  }
  return Json{
      {"time", static_cast<double>(tick_.load(std::memory_order_relaxed)) * signals::tick_seconds},
      {"machine", stop_ != nullptr},
      {"stopping", stop_ != nullptr && stop_->load(std::memory_order_relaxed)},
      {"paused", steering_.paused()},
      {"pace", steering_.pace()},
      {"values", std::move(values)},
      {"overridden", std::move(overridden)},
      {"refused", steering_.refused()},
      {"left_out", feed_.left_out()}}
      .text();
}

std::string LiveView::frame(Position& position) {
  feed_.collect();
  if (feed_.rows() == 0) return "";
  std::string out = "{\"state\":" + state();
  if (feed_.rows() > position.samples.rows)
    out += ",\"piece\":" + page_.piece(feed_.since(position.samples));
  if (changes_.size() > position.changes) {
    const auto from = changes_.begin() + static_cast<std::ptrdiff_t>(position.changes);
    out += ",\"changes\":" + report::to_json(std::vector(from, changes_.end())).text();
    position.changes = changes_.size();
  }
  return out + "}";
}

void LiveView::record_changes() {
  const double time =
      static_cast<double>(tick_.load(std::memory_order_relaxed)) * signals::tick_seconds;
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    std::optional<double> now;
    if (steering_.overridden(i)) now = steering_.value(i);
    if (now == set_[i]) continue;
    set_[i] = now;
    changes_.push_back({.time = time,
                        .key = settings_[i].key,
                        .release = !now,
                        .value = now.value_or(0),
                        .unit = std::string(settings_[i].unit)});
  }
}

// Returns the reason why a request is refused, or "": a machine has its own clock and cannot be
// paused, a simulation cannot be stopped.
std::string LiveView::refusal(Request::Kind kind) const {
  using enum Request::Kind;
  const bool of_time = kind == pause || kind == resume || kind == pace;
  if (stop_ != nullptr && of_time)
    return "found pause or pace; expected stop: the machine keeps its own time";
  if (stop_ == nullptr && kind == stop) return "found stop; expected pause: no machine moves";
  return "";
}

std::string LiveView::handle(std::string_view text) {
  using Kind = Request::Kind;
  const auto error = [](std::string_view what) { return Json{{"error", what}}.text(); };
  Request r;
  try {
    r = read_request(text, settings_);
  } catch (const std::invalid_argument& wrong) {
    return error(wrong.what());
  }
  if (const std::string why = refusal(r.kind); !why.empty()) return error(why);
  bool taken = true;
  switch (r.kind) {
    case Kind::stop:
      stop_->store(true, std::memory_order_relaxed);
      break;
    case Kind::pause:
    case Kind::resume:
      steering_.pause(r.kind == Kind::pause);
      break;
    case Kind::pace:
      steering_.pace(r.value);
      break;
    case Kind::set:
      taken = steering_.change(r.setting, r.value);
      break;
    case Kind::release:
      taken = steering_.release(r.setting);
      break;
    case Kind::release_all:
      for (std::size_t i = 0; i < settings_.size(); ++i)
        if (steering_.overridden(i)) taken = steering_.release(i) && taken;
      break;
  }
  return taken ? ""
               : error("found more changes than fit into a period; try again when it continues");
}

}  // namespace sinew::live
