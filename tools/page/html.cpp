// SPDX-License-Identifier: BSD-3-Clause
#include "tools/page/html.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

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

namespace {

class TemplateReader {
 public:
  TemplateReader(std::string_view page, const PageValues& values) : page_(page), values_(values) {}

  std::string all() {
    std::string text = up_to_end_of("");
    for (const auto& [name, value] : values_)
      SEAGLINT_CHECK(used_.contains(name), fmt::format("the template has no placeholder {}", name));
    return text;
  }

 private:
  std::string up_to_end_of(std::string_view section) {
    std::string text;
    for (;;) {
      const std::size_t open = page_.find("{{", at_);
      text += page_.substr(at_, open - at_);
      if (open == std::string_view::npos) {
        SEAGLINT_CHECK(section.empty(), fmt::format("section {} does not end", section));
        return text;
      }
      const std::size_t braces = page_.substr(open).starts_with("{{{") ? 3 : 2;
      const std::size_t close = page_.find(braces == 3 ? "}}}" : "}}", open);
      SEAGLINT_CHECK(close != std::string_view::npos, "a placeholder does not end");
      std::string_view name = page_.substr(open + braces, close - open - braces);
      at_ = close + braces;
      const char kind = name.empty() ? ' ' : name.front();
      if (kind == '#' || kind == '^' || kind == '/') name.remove_prefix(1);
      if (kind == '/') {
        SEAGLINT_CHECK(name == section, fmt::format("section {} ends as {}", section, name));
        return text;
      }
      const auto found = values_.find(name);
      SEAGLINT_CHECK(found != values_.end(), fmt::format("placeholder {} has no value", name));
      used_.insert(found->first);
      const std::string& value = found->second;
      if (kind == '#' || kind == '^') {
        const std::string inner = up_to_end_of(name);
        if (value.empty() == (kind == '^')) text += inner;
      } else {
        text += braces == 3 ? value : escape_html(value);
      }
    }
  }

  std::string_view page_;
  const PageValues& values_;
  std::size_t at_ = 0;
  std::set<std::string> used_;
};

}  // namespace

std::string filled(std::string_view page, const PageValues& values) { return TemplateReader(page, values).all(); }

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

namespace {

std::string embedded(std::string_view bytes, const char* kind, std::string_view alternative) {
  return fmt::format("<img src=\"data:{};base64,{}\" alt=\"{}\">", kind, base64(bytes), escape_html(alternative));
}

}  // namespace

std::string html_figure(const std::filesystem::path& file, std::string_view caption, std::string_view alternative,
                        std::string_view plot) {
  const char* kind = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
  return fmt::format("<figure{}>{}{}<figcaption>{}</figcaption></figure>\n", plot.empty() ? "" : " class=\"plot\"",
                     embedded(read_file(file), kind, alternative),
                     plot.empty() ? "" : fmt::format("<script type=\"application/json\">{}</script>", plot), caption);
}

std::string html_picture(std::string_view png, std::string_view caption, std::string_view alternative) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", embedded(png, "image/png", alternative),
                     caption);
}

std::string html_page(std::string_view title, std::string_view body, std::string_view script) {
  const bool draws = body.find("<script type=\"application/json\"") != std::string_view::npos;
  return filled(page_template(), {{"title", std::string(title)},
                                  {"style", std::string(page_style())},
                                  {"body", std::string(body)},
                                  {"plotly", draws ? std::string(plotly_gzip()) : ""},
                                  {"page_script", std::string(page_script())},
                                  {"script", std::string(script)}});
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '<' || static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string json_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

std::string json_numbers(std::span<const double> values, int digits) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(json_number(value, digits));
  return fmt::format("[{}]", fmt::join(texts, ","));
}

namespace {

std::string axis_of(const FigureAxis& axis) {
  return fmt::format(
      R"({{"label":{},"log":{}{}}})", json_string(axis.label), axis.logarithmic,
      axis.range ? fmt::format(R"(,"range":[{},{}])", json_number(axis.range->first), json_number(axis.range->second))
                 : "");
}

std::string series_of(const Series& series) {
  constexpr const char* kStyles[] = {"lines", "points", "linespoints", "band"};
  std::string bounds;
  for (const std::size_t side : {0u, 1u}) {
    if (series.interval.empty()) break;
    std::vector<double> values;
    for (const auto& interval : series.interval) values.push_back(interval[side]);
    bounds += fmt::format(R"(,"{}":{})", side == 0 ? "low" : "high", json_numbers(values));
  }
  const std::string drawn = series.colour.empty()
                                ? std::string()
                                : fmt::format(R"(,"colour":{},"width":{:g})", json_string(series.colour), series.width);
  return fmt::format(R"({{"name":{},"style":"{}","x":{},"y":{}{}{}}})", json_string(series.name),
                     kStyles[static_cast<int>(series.style)], json_numbers(series.x), json_numbers(series.y), bounds,
                     drawn);
}

}  // namespace

std::string plot_json(std::span<const LinePlot> plots, int columns) {
  std::vector<std::string> panels;
  for (const LinePlot& plot : plots) {
    std::vector<std::string> series;
    for (const Series& one : plot.series) series.push_back(series_of(one));
    std::vector<std::string> marks;
    for (const LinePlot::Mark& mark : plot.marks)
      marks.push_back(
          fmt::format(R"([{},{},{}])", json_number(mark.x, 6), json_number(mark.y, 6), json_string(mark.name)));
    panels.push_back(fmt::format(R"({{"title":{},"x":{},"y":{},"equal":{},{}"series":[{}]}})", json_string(plot.title),
                                 axis_of(plot.x), axis_of(plot.y), plot.equal_axes,
                                 marks.empty() ? "" : fmt::format(R"("marks":[{}],)", fmt::join(marks, ",")),
                                 fmt::join(series, ",")));
  }
  return fmt::format(R"({{"columns":{},"panels":[{}]}})", columns, fmt::join(panels, ","));
}

std::string plot_json(const LinePlot& plot) { return plot_json(std::span(&plot, 1), 1); }

std::string packed(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, bytes.data(), bytes.size(), 9) != Z_OK)
    throw WorkError(fmt::format("no memory to compress {} bytes", bytes.size()));
  out.resize(size);
  return base64(out);
}

std::string packed_floats(std::span<const double> values, int digits) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  const std::uint32_t dropped = 24 - static_cast<std::uint32_t>(digits);
  for (const double value : values) {
    const auto single = static_cast<float>(value);
    auto bits = std::bit_cast<std::uint32_t>(single);
    // Rounds half up in magnitude; infinities and NaN have no digits to drop.
    if (dropped > 0 && std::isfinite(single)) bits = (bits + (1u << (dropped - 1))) >> dropped << dropped;
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> 8 * i));
  }
  return packed(bytes);
}

}  // namespace seaglint
