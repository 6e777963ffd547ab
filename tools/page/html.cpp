// SPDX-License-Identifier: BSD-3-Clause
#include "tools/page/html.h"

#include <fmt/format.h>
#include <zlib.h>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

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

std::string html_figure(const std::filesystem::path& file, std::string_view caption, std::string_view alternative,
                        std::string_view plot) {
  const char* kind = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
  return fmt::format("<figure{}><img src=\"data:{};base64,{}\" alt=\"{}\">{}<figcaption>{}</figcaption></figure>\n",
                     plot.empty() ? "" : " class=\"plot\"", kind, base64(read_file(file)), escape_html(alternative),
                     plot.empty() ? "" : fmt::format("<script type=\"application/json\">{}</script>", plot), caption);
}

std::string script_json(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string html_page(std::string_view title, std::string_view body, std::string_view script) {
  std::string scripts;
  if (body.find("<script type=\"application/json\"") != std::string_view::npos) {
    scripts = fmt::format(
        "<script type=\"text/plain\" id=\"plotly\">{}</script>\n<script>\n{}</script>\n<script>\n{}</script>\n",
        plotly_gzip(), page_script(), script);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n{}</body>\n</"
      "html>\n",
      escape_html(title), page_style(), body, scripts);
}

namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json::parse(fmt::format("{:.6g}", value)) : ordered_json(nullptr);
}

template <class Values>
ordered_json numbers(const Values& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

ordered_json axis_of(const FigureAxis& axis) {
  ordered_json json{{"label", axis.label}, {"log", axis.logarithmic}};
  if (axis.range) json["range"] = {number(axis.range->first), number(axis.range->second)};
  return json;
}

ordered_json series_of(const Series& series) {
  constexpr const char* kStyles[] = {"lines", "points", "linespoints", "band"};
  ordered_json json{{"name", series.name}, {"style", kStyles[static_cast<int>(series.style)]}};
  json["x"] = numbers(series.x);
  json["y"] = numbers(series.y);
  if (series.interval.empty()) return json;
  std::vector<double> low, high;
  for (const auto& [l, h] : series.interval) {
    low.push_back(l);
    high.push_back(h);
  }
  json["low"] = numbers(low);
  json["high"] = numbers(high);
  return json;
}

}  // namespace

std::string plot_json(std::span<const LinePlot> plots, int columns) {
  ordered_json json{{"columns", columns}, {"panels", ordered_json::array()}};
  for (const LinePlot& plot : plots) {
    ordered_json panel{{"title", plot.title}, {"x", axis_of(plot.x)}, {"y", axis_of(plot.y)}};
    panel["equal"] = plot.equal_axes;
    panel["series"] = ordered_json::array();
    for (const Series& series : plot.series) panel["series"].push_back(series_of(series));
    json["panels"].push_back(std::move(panel));
  }
  return script_json(json.dump());
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
