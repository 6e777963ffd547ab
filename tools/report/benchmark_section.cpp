// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/benchmark_section.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tools/page/html.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

// "93.1"; a dash for null.
std::string percent(const ordered_json& fraction) {
  return fraction.is_null() ? "–" : fmt::format("{:.1f}", 100 * fraction.get<double>());
}

std::string with_interval(const ordered_json& entry) {
  const ordered_json& interval = entry.at("interval");
  if (interval.at(0).is_null()) return percent(entry.at("accuracy"));
  return fmt::format("{} ({:.0f}–{:.0f})", percent(entry.at("accuracy")), 100 * interval.at(0).get<double>(),
                     100 * interval.at(1).get<double>());
}

// A row per entry of `member`: in total and by wave height.
std::string accuracies(const ordered_json& benchmark, const char* member, const char* title) {
  std::vector<std::vector<std::string>> rows{{title, "all"}};
  for (const auto& [height, entry] : benchmark.at("baselines").at("handmade").at("by").items())
    rows.front().push_back("Hs " + escape_html(height) + " m");
  for (const auto& [name, entry] : benchmark.at(member).items()) {
    const bool leaks = entry.contains("leaks") && entry.at("leaks").get<bool>();
    rows.push_back({escape_html(name) + (leaks ? " *" : ""), with_interval(entry)});
    for (const auto& of_height : entry.at("by")) rows.back().push_back(percent(of_height.at("accuracy")));
  }
  return html_table(rows);
}

std::string claims(const ordered_json& benchmark) {
  std::vector<std::vector<std::string>> rows{{"claim of the paper", "", "figures"}};
  for (const ordered_json& claim : benchmark.at("claims")) {
    const ordered_json& held = claim.at("held");
    rows.push_back({escape_html(claim.at("claim").get<std::string>()),
                    held.is_null()     ? "undecided"
                    : held.get<bool>() ? "held"
                                       : "not held",
                    escape_html(claim.at("why").get<std::string>())});
  }
  return html_table(rows, false);
}

}  // namespace

std::string benchmark_section(const ordered_json& benchmark, const std::string& report) {
  const std::string name = escape_html(benchmark.at("benchmark").get<std::string>());
  std::string html = fmt::format(
      "<p>Benchmark <b>{}</b>{}: {} maps in {} seas; {}. Accuracy in %, in brackets the 95 % interval. Each "
      "quantity without motion is classified by itself; their intervals are for all of them at once, * marks those "
      "that differ from chance.{}</p>\n",
      name, benchmark.at("small").get<bool>() ? " at its small size, whose figures say little" : "",
      benchmark.at("maps").get<std::uint64_t>(), benchmark.at("seas").get<std::uint64_t>(),
      escape_html(benchmark.at("division").get<std::string>()),
      report.empty() ? "" : fmt::format(" <a href=\"{}\">Its own report</a>.", escape_html(report)));
  return html + accuracies(benchmark, "baselines", "features") + accuracies(benchmark, "floor", "without motion") +
         claims(benchmark);
}

}  // namespace seaglint
