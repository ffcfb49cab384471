#include "sinew/report/page/fit_page.h"

#include <nlohmann/json.hpp>

#include "sinew/report/page/content.h"
#include "sinew/report/page/page_template.h"

namespace sinew::report {

Content content(const FitPage& fit) {
  using Json = nlohmann::ordered_json;
  const Channels none;
  Blob blob;
  Columns columns(none, blob);
  Json out = {{"format", "sinew.fit/1"}, {"title", fit.title}, {"version", fit.version}};
  out["data"] = fit.data;
  out["atmosphere"] = fit.atmosphere;
  out["parts"] = Json::array();
  for (const FitPart& part : fit.parts)
    out["parts"].push_back({{"report", Json::parse(part.report)},
                            {"charts", Json::parse(to_json(part.charts, columns))}});
  out["parameters"] = Json::parse(to_json(fit.values));
  return {fit.title, out.dump(-1, ' ', false, Json::error_handler_t::replace), ""};
}

std::string page(const FitPage& fit) {
  require_page("the page");
  return fill(fit_template(), content(fit));
}

}  // namespace sinew::report
