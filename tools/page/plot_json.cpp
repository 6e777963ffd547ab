// SPDX-License-Identifier: BSD-3-Clause
#include "tools/page/plot_json.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "tools/page/html.h"

namespace seaglint {
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
