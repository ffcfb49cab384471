#include "sinew/report/page/fit_page.h"

namespace sinew::report {

Content content(const FitPage& fit) {
  const Channels none;
  Blob blob;
  Columns columns(none, blob);
  return {fit.title, to_json(fit, columns).text(), ""};
}

std::string page(const FitPage& fit) {
  require_page("the page");
  return fill(fit_template(), content(fit));
}

}  // namespace sinew::report
