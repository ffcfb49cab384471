#include "cli/alignment.h"

namespace sinew::cli {

report::AlignWish Alignment::wish() const {
  report::AlignWish wish;
  for (const auto by : {report::Align::sequence, report::Align::event, report::Align::correlation})
    if (to_text(by) == align) wish.by = by;
  // An event or channels that are named are wished for.
  if (!event.empty()) wish.by = report::Align::event;
  if (!align_by.empty() && wish.by == report::Align::start) wish.by = report::Align::correlation;
  wish.event = event;
  wish.channels = align_by;
  wish.fit_clock = clock == "fit";
  wish.most_shift = most_shift;
  return wish;
}

std::string Alignment::given() const {
  if (align != "start") return "align";
  if (!event.empty()) return "event";
  if (!align_by.empty()) return "align_by";
  if (clock != "none") return "clock";
  return most_shift < std::numeric_limits<double>::infinity() ? "within" : "";
}

void add_alignment(CLI::App& sub, Alignment& alignment) {
  sub.add_option("--align", alignment.align,
                 "how the times of runs are aligned with those of the first one: start, sequence, "
                 "event, correlation")
      ->check(one_of({"start", "sequence", "event", "correlation"}));
  sub.add_option("--event", alignment.event,
                 "of --align event: '/joint/elbow/angle > 10 deg'; else the surest first motion");
  sub.add_option("--align-by", alignment.align_by, "channels that are correlated; else chosen")
      ->expected(1, CLI::detail::expected_max_vector_size);
  sub.add_option("--clock", alignment.clock,
                 "fit: the rate of a run's clock is found and taken out; none")
      ->check(one_of({"none", "fit"}));
  sub.add_option("--within", alignment.most_shift, "largest shift that is looked for, in s");
}

}  // namespace sinew::cli
