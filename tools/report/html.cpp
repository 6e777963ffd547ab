// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html.h"

#include <fmt/format.h>

#include "sim/core/process/file.h"

namespace seaglint {

namespace {

constexpr const char* kStyle = R"(
:root { --ink: #1c2733; --soft: #5b6875; --line: #dde3e9; --tint: #f4f7f9; --accent: #0b5c8a; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 0 24px 64px; }
header { border-bottom: 3px solid var(--accent); margin-bottom: 8px; padding: 36px 0 18px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 6px; }
h2 { font-size: 21px; margin: 44px 0 10px; padding-top: 12px; border-top: 1px solid var(--line); }
h3 { font-size: 16px; margin: 24px 0 6px; }
p, ul { max-width: 84ch; }
.lead { color: var(--soft); margin: 0; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 14px; padding: 8px 0; }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(165px, 1fr)); gap: 12px; margin: 20px 0; }
.tile { background: var(--tint); border: 1px solid var(--line); border-radius: 6px; padding: 12px 14px; }
.tile b { display: block; font-size: 25px; line-height: 1.2; color: var(--accent); }
.tile span { font-size: 13px; color: var(--soft); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14.5px; margin: 10px 0 18px; }
th, td { padding: 6px 14px; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
th { background: var(--tint); border-bottom: 2px solid #c3ccd5; font-weight: 600; }
table.numbers td:not(:first-child), table.numbers th:not(:first-child) { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td small { color: var(--soft); white-space: nowrap; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 18px; }
#targets .pair { grid-template-columns: 2.2fr 1fr; align-items: end; }
@media (max-width: 800px) { .pair, #targets .pair { grid-template-columns: 1fr; } }
figure { margin: 8px 0 16px; }
figure img { width: 100%; height: auto; border: 1px solid var(--line); border-radius: 4px; background: #fff; }
figcaption { font-size: 14px; color: var(--soft); margin-top: 5px; }
.note { background: #fff8e6; border-left: 4px solid #e0a800; padding: 8px 14px; max-width: 84ch; }
pre { background: var(--tint); border: 1px solid var(--line); border-radius: 6px; padding: 14px; overflow-x: auto; font-size: 13px; line-height: 1.4; }
summary { cursor: pointer; color: var(--accent); }
footer { margin-top: 48px; border-top: 1px solid var(--line); padding-top: 12px; color: var(--soft); font-size: 13.5px; }
@media print { nav { display: none; } h2 { break-after: avoid; } figure { break-inside: avoid; } }
)";

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u; };
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    out += kDigits[group >> 18];
    out += kDigits[group >> 12 & 63];
    out += i + 1 < bytes.size() ? kDigits[group >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? kDigits[group & 63] : '=';
  }
  return out;
}

std::string html_table(const std::vector<std::vector<std::string>>& rows, bool numbers) {
  std::string out = fmt::format("<div class=\"scroll\"><table{}>\n", numbers ? " class=\"numbers\"" : "");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += i == 0 ? "<thead><tr>" : "<tr>";
    for (const std::string& cell : rows[i])
      out += (i == 0 ? "<th scope=\"col\">" + cell + "</th>" : "<td>" + cell + "</td>");
    out += i == 0 ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string html_figure(const std::filesystem::path& file, std::string_view caption, std::string_view alternative) {
  const char* kind = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
  return fmt::format("<figure><img src=\"data:{};base64,{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", kind,
                     base64(read_file(file)), escape_html(alternative), caption);
}

std::string html_page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n</html>\n",
      escape_html(title), kStyle, body);
}

}  // namespace seaglint
