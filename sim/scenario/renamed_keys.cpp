// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/renamed_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/text/number.h"

namespace seaglint {
namespace {

double negated(double x) { return 0 - x; }

constexpr RenamedKey kKeys[] = {
    {"radar.budget", "link_budget"},
    {"radar.link_budget.temperature_k", "reference_temperature_k"},
    {"radar.platform.compensated", "motion_compensated"},
    {"targets.*.with", "companions"},
    {"targets.*.motion.preroll_s", "spin_up_s"},
    {"targets.*.motion.roll_radius_m", "roll_gyradius_m"},
    {"targets.*.motion.pitch_radius_m", "pitch_gyradius_m"},
    {"targets.*.motion.yaw_radius_m", "yaw_gyradius_m"},
    {"targets.*.motion.rao_length_m", "wamit_ulen_m"},
    {"targets.*.motion.yaw_rate_deg_s", "yaw_rate_std_deg_s"},
    {"targets.*.motion.centre_above_water_m", "origin_above_waterline_m"},
    {"targets.*.solver.max_turn_deg", "max_aspect_change_deg"},
    {"targets.*.solver.radar_range_m", "wavefront_range_m"},
    {"clutter.noise_to_clutter_db", "cnr_db", ", which has the opposite sign", negated},
    {"clutter.texture_time_s", "texture_correlation_time_s"},
    {"learning.network_share", "network_fraction"},
};

constexpr RenamedValue kValues[] = {
    {"sea.significant_wave_height_m", "of_table", "from_table"},
    {"sea_reflection.paths", "direct", "direct_only"},
    {"sea_reflection.paths", "multipath", "multipath_only"},
    {"clutter.doppler", "given", "prescribed"},
    {"clutter.doppler", "sea", "sea_state"},
    {"clutter.doppler", "wave_field", "wave_resolved"},
    {"clutter.noise_level", "to_clutter", "cnr"},
};

// Whether a key path is that of a table, where * is any one name.
bool matches(std::string_view path, std::string_view pattern) {
  for (;;) {
    const std::size_t end = path.find('.'), pattern_end = pattern.find('.');
    const std::string_view name = pattern.substr(0, pattern_end);
    if (name != "*" && name != path.substr(0, end)) return false;
    if (end == std::string_view::npos || pattern_end == std::string_view::npos) return end == pattern_end;
    path.remove_prefix(end + 1);
    pattern.remove_prefix(pattern_end + 1);
  }
}

}  // namespace

std::span<const RenamedKey> renamed_keys() { return kKeys; }
std::span<const RenamedValue> renamed_values() { return kValues; }

std::optional<std::string> renamed_key(std::string_view path, std::string_view value) {
  const auto found = std::ranges::find_if(kKeys, [&](const RenamedKey& key) { return matches(path, key.path); });
  if (found == std::end(kKeys)) return std::nullopt;
  std::string text = fmt::format("renamed to {}{}", found->now, found->note);
  const std::optional<double> number = found->convert != nullptr ? parse_number(value) : std::nullopt;
  if (number) text += fmt::format(": write {}: {:.6g}", found->now, found->convert(*number));
  return text;
}

std::optional<std::string_view> renamed_value(std::string_view path, std::string_view value) {
  const auto found = std::ranges::find_if(
      kValues, [&](const RenamedValue& old) { return matches(path, old.path) && value == old.value; });
  if (found == std::end(kValues)) return std::nullopt;
  return found->now;
}

}  // namespace seaglint
