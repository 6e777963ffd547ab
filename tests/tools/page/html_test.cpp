// SPDX-License-Identifier: BSD-3-Clause
// Templates, and figures as JSON for the script of a page.
#include "tools/page/html.h"
#include "tests/refusal.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace seaglint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PageTemplate, PutsValuesInTheirPlaces) {
  const PageValues values{{"a", "<1>"}, {"empty", ""}, {"b", "{{a}}"}};
  EXPECT_EQ(filled("{{a}} {{{a}}}{{#a}} yes {{b}}{{/a}}{{^a}} no{{/a}}{{#empty}} {{a}}{{/empty}}{{^empty}}.{{/empty}}",
                   values),
            "&lt;1&gt; <1> yes {{a}}.");
}

TEST(PageTemplate, RefusesWhatDoesNotFit) {
  const PageValues values{{"a", "1"}};
  for (const char* page : {"{{a}}{{b}}", "", "{{#a}}", "{{a", "{{#a}}{{/b}}", "{{{a}}"})
    EXPECT_THROW(filled(page, values), std::logic_error) << page;
}

TEST(PlotJson, HasTheNumbersOfTheFigureAndNullWhereItHasNone) {
  LinePlot plot;
  plot.title = "</script><b>";
  plot.x = {"range (m)", AxisRange{1, 2}, true};
  plot.series = {{"a", {1, 2}, {0.123456789, std::numeric_limits<double>::quiet_NaN()}, {{0, 1}, {2, 3}}}};
  const std::string text = plot_json(plot);
  EXPECT_THAT(text, Not(HasSubstr("<")));
  const auto json = nlohmann::json::parse(text);
  const auto& panel = json.at("panels").at(0);
  EXPECT_EQ(panel.at("title"), "</script><b>");
  EXPECT_EQ(panel.at("x").at("label"), "range (m)");
  EXPECT_TRUE(panel.at("x").at("log").get<bool>());
  EXPECT_EQ(panel.at("x").at("range"), nlohmann::json::parse("[1, 2]"));
  EXPECT_EQ(panel.at("series").at(0).at("y"), nlohmann::json::parse("[0.123457, null]"));
  EXPECT_EQ(panel.at("series").at(0).at("high"), nlohmann::json::parse("[1, 3]"));
}

TEST(PlotJson, ThePageHasScriptsOnlyWhereItHasSomethingToDraw) {
  EXPECT_THAT(html_page("t", "<p>text</p>"), Not(HasSubstr("<script")));
  const std::string page = html_page("t", "<figure><script type=\"application/json\">{}</script></figure>");
  EXPECT_HAS(page, "id=\"plotly\"");
  EXPECT_THAT(page, Not(HasSubstr("https://cdn")));
}

// zlib's stream of "aaa...": its head (RFC 1950: CMF 0x78, best compression 0xda), then Base64.
TEST(PlotJson, PacksByZlib) { EXPECT_EQ(packed(std::vector<std::uint8_t>(3, 'a')).substr(0, 3), "eNp"); }

TEST(PlotJson, KeepsAsManyBinaryDigitsAsAsked) {
  // 1 + 2^-13 has 14 significant binary digits: with 12 it is 1.
  EXPECT_EQ(packed_floats(std::vector{1 + std::ldexp(1.0, -13)}, 12), packed_floats(std::vector{1.0}));
  EXPECT_NE(packed_floats(std::vector{1 + std::ldexp(1.0, -13)}, 14), packed_floats(std::vector{1.0}));
}

}  // namespace
}  // namespace seaglint
