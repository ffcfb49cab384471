// The page contains the texts of its figures and claims, escaped.
#include "sinew/report/figures/gallery.h"
#include "sinew/json/json.h"

#include <gmock/gmock.h>

namespace sinew::report::gallery_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Gallery gallery() {
  Curve line{.label = "40 psi", .xs = {1, 2}, .ys = {3, 4}, .source = "[22]"};
  Curve stand = line;
  stand.label = "of our stand";
  stand.kind = Curve::Kind::synthetic;
  stand.source = "weights.toml";
  Figure figure{.name = "2-6",
                .title = "Force",
                .caption = "Force over length.",
                .plots = {{.x = {"length", "in"}, .y = {"force", "lbf"}, .curves = {line, stand}}},
                .missing = {{"the measured one", "lost"}}};
  const Claim agrees = judge(StatementClass::put_in, {.where = "2.2",
                                                      .says = "zero there",
                                                      .reported = "0",
                                                      .quantity = "least force",
                                                      .computed = 0,
                                                      .unit = "lbf",
                                                      .accept = analysis::another(0, 1),
                                                      .why = "a line's width",
                                                      .because = {}});
  Claim differs = agrees;
  differs.verdict = Agreement::differs;
  return {.title = "Figures",
          .lead = "A lead.",
          .prefix = "Figure ",
          .exhibits = {{figure, {agrees, differs, not_applicable("2.3", "larger", "", "no size")}}},
          .pictures = {"svg", "png"},
          .scripts = true};
}

TEST(Gallery, JsonHasCurvesFilesAndVerdicts) {
  const Json index = Json::parse(index_json(gallery()));
  EXPECT_EQ(index["format"], "sinew.figures/1");
  EXPECT_EQ(index["verdicts"]["agrees"], 1);
  EXPECT_EQ(index["classes"]["put in"]["agrees"], 1);
  EXPECT_EQ(index["classes"]["put in"]["differs"], 1);
  EXPECT_EQ(index["classes"]["predicted"]["agrees"], 0);
  EXPECT_EQ(index["verdicts"]["differs"], 1);
  EXPECT_EQ(index["verdicts"]["not applicable"], 1);
  const Json& figure = index["figures"][0];
  EXPECT_EQ(figure["svg"], "2-6.svg");
  EXPECT_EQ(figure["png"], "2-6.png");
  EXPECT_EQ(figure["script"], "2-6.gp");
  ASSERT_EQ(figure["curves"].size(), 3u);
  EXPECT_EQ(figure["curves"][0]["y"], "40 psi [lbf]");
  EXPECT_EQ(figure["curves"][0]["file"], "2-6.csv");
  EXPECT_EQ(figure["curves"][1]["kind"], "synthetic");
  EXPECT_EQ(figure["curves"][2]["kind"], "unavailable");
  EXPECT_EQ(figure["claims"][0]["ours"], "0 lbf");
  EXPECT_EQ(figure["claims"][0]["class"], "put in");
  EXPECT_EQ(figure["claims"][0]["wording"], "another band");
  EXPECT_FALSE(figure["claims"][2].contains("class"));
  EXPECT_EQ(figure["claims"][2]["verdict"], "not applicable");
  EXPECT_EQ(index_json(gallery()), index_json(gallery()));
}

TEST(Gallery, PageHasPictureClaimsAndLinks) {
  const std::string page = index_html(gallery());
  for (const char* text :
       {"id=\"2-6\"", "src=\"2-6.svg\"", "href=\"2-6.png\"", "href=\"2-6.csv\"", "zero there",
        "class=\"verdict agrees\">agrees<", "class=\"verdict differs\">differs<",
        "class=\"verdict open\">not applicable<", "<b>synthetic</b> of our stand", "weights.toml",
        "<b>not drawn</b> the measured one", "class=\"class\">put in<",
        "<caption>3 statements about 1 figures</caption>",
        "data-is=\"agrees,differs,open,put_in,computed,synthetic,"
        "unavailable\"",
        "Figure 2-6"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("http")));  // nothing is fetched
}

TEST(Gallery, WithoutPicturesTheDataAreThere) {
  Gallery g = gallery();
  g.pictures.clear();
  const std::string page = index_html(g);
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr("href=\"2-6.csv\""));
  EXPECT_FALSE(Json::parse(index_json(g))["figures"][0].contains("svg"));
}

TEST(Gallery, NoPdfIsShownAsAnImage) {
  Gallery g = gallery();
  g.pictures = {"pdf"};
  EXPECT_THAT(index_html(g), AllOf(Not(HasSubstr("<img")), HasSubstr("href=\"2-6.pdf\"")));
  g.pictures = {"pdf", "svg"};
  EXPECT_THAT(index_html(g), AllOf(HasSubstr("src=\"2-6.svg\""), HasSubstr("href=\"2-6.pdf\"")));
}

TEST(Gallery, FiguresWithoutTextAreSideBySide) {
  Gallery g = gallery();
  EXPECT_THAT(index_html(g), AllOf(HasSubstr("<main>"), HasSubstr("id=\"choice\"")));
  g.exhibits[0].claims.clear();
  EXPECT_THAT(index_html(g),
              AllOf(HasSubstr("<main class=\"sheet\">"), Not(HasSubstr("id=\"choice\"")),
                    Not(HasSubstr("class=\"tally\""))));
  EXPECT_FALSE(Json::parse(index_json(g)).contains("verdicts"));
}

TEST(Gallery, TextStaysText) {
  Gallery g = gallery();
  const std::string evil = "</title><script>\"'&";
  g.title = g.lead = g.prefix = evil;
  Exhibit& e = g.exhibits[0];
  e.figure.title = e.figure.caption = evil;
  e.figure.plots[0].curves[0].label = e.figure.plots[0].curves[0].source = evil;
  e.figure.missing[0] = {evil, evil};
  e.claims = {not_applicable(evil, evil, evil, evil)};
  const std::string page = index_html(g);
  EXPECT_THAT(page, Not(HasSubstr(evil)));
  EXPECT_THAT(page, HasSubstr("&lt;/title&gt;&lt;script&gt;&quot;'&amp;"));
  EXPECT_EQ(Json::parse(index_json(g))["title"], evil);
}

}  // namespace
}  // namespace sinew::report::gallery_test
