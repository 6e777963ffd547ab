// SPDX-License-Identifier: BSD-3-Clause
// The result of a benchmark in the report of another run has the figures of its file.
#include "tools/report/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace seaglint {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

ordered_json entry(double accuracy, double low, double high) {
  const ordered_json figures{{"accuracy", accuracy}, {"interval", {low, high}}};
  ordered_json all = figures;
  all["by"] = {{"0.1", figures}, {"2", {{"accuracy", 0.25}, {"interval", {nullptr, nullptr}}}}};
  return all;
}

ordered_json benchmark() {
  ordered_json json{{"benchmark", "a<b"}, {"small", true}, {"maps", 120}, {"seas", 30}, {"division", "split by sea"}};
  json["baselines"]["handmade"] = entry(0.9312, 0.82, 1);
  json["floor"]["hop code"] = entry(0.5, 0.4, 0.6);
  json["floor"]["hop code"]["leaks"] = false;
  json["floor"]["total power"] = entry(0.75, 0.7, 0.8);
  json["floor"]["total power"]["leaks"] = true;
  for (const ordered_json& held : {ordered_json(true), ordered_json(false), ordered_json(nullptr)})
    json["claims"].push_back({{"claim", "x > y"}, {"held", held}, {"why", "1 and 2 %"}});
  return json;
}

TEST(BenchmarkSection, HasTheFiguresOfItsFile) {
  const std::string html = benchmark_section(benchmark(), "twin/report.html");
  EXPECT_THAT(html, HasSubstr("Benchmark <b>a&lt;b</b> at its small size"));
  EXPECT_THAT(html, HasSubstr("120 maps in 30 seas; split by sea."));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">Hs 0.1 m</th><th scope=\"col\">Hs 2 m</th>"));
  EXPECT_THAT(html, HasSubstr("<td>handmade</td><td>93.1 (82–100)</td><td>93.1</td><td>25.0</td>"));
  EXPECT_THAT(html, HasSubstr("<td>hop code</td><td>50.0 (40–60)</td>"));
  EXPECT_THAT(html, HasSubstr("<td>total power *</td><td>75.0 (70–80)</td>"));
  for (const char* verdict : {"held", "not held", "undecided"})
    EXPECT_THAT(html, HasSubstr(std::string("<td>x &gt; y</td><td>") + verdict + "</td><td>1 and 2 %</td>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"twin/report.html\">"));
  EXPECT_THAT(benchmark_section(benchmark(), ""), Not(HasSubstr("<a ")));
}

TEST(BenchmarkSection, OfADamagedFileIsAnException) {
  for (const char* member : {"benchmark", "small", "maps", "seas", "division", "baselines", "floor", "claims"}) {
    ordered_json damaged = benchmark();
    damaged.erase(member);
    EXPECT_THROW(benchmark_section(damaged, ""), nlohmann::json::exception) << member;
  }
}

}  // namespace
}  // namespace seaglint
