#include "sinew/report/page/design_page.h"

#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"

namespace sinew::report {

std::string page(const DesignPage& design) {
  require_page("the page");
  const Channels none;
  Blob blob;
  Columns columns(none, blob);
  Json out = {
      {"format", "sinew.design_page/1"}, {"title", design.title}, {"version", design.version}};
  out["atmosphere"] = design.atmosphere;
  out["values"] = design.values;
  out["tables"] = design.tables;
  out["charts"] = charts_json(design.plots, columns);
  out["refused"] = design.refused;
  out["notes"] = design.notes;
  out["warnings"] = design.warnings;
  out["unseen"] = design.unseen;
  return fill(design_template(), {design.title, out.text(), ""});
}

}  // namespace sinew::report
