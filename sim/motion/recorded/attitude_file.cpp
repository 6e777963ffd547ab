// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/recorded/attitude_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/table.h"
#include "sim/core/text/words.h"

namespace seaglint {

std::string AttitudeTable::place(std::size_t row) const { return fmt::format("{}:{}", file, lines[row]); }

namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// The first non-comment line that contains `part`, with its 1-based number; nullopt without one.
struct FoundLine {
  std::string_view text;
  int number;
};
std::optional<FoundLine> line_with(std::string_view text, std::string_view part) {
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    std::string_view rest = line;
    if (has(line, part) && !next_word(rest).starts_with('#')) return FoundLine{line, number};
  }
  return std::nullopt;
}

// Names of time, roll, pitch, yaw, surge, sway, heave; the last three only where the file has them.
AttitudeTable from_columns(const std::string& text, const std::string& file, std::vector<std::string> names,
                           bool shifts, bool in_degrees, TableLayout layout, int names_line) {
  if (!shifts) names.resize(4);
  const Table table = parse_table(text, file, names, layout, names_line);
  AttitudeTable result;
  result.file = file;
  result.in_degrees = in_degrees;
  const double unit = in_degrees ? radians(1) : 1;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    result.lines.push_back(table.line(row));
    result.time.push_back(table.at(row, 0));
    MotionSample& sample = result.samples.emplace_back();
    sample.angles = unit * Vec3(table.at(row, 1), table.at(row, 2), table.at(row, 3));
    if (shifts) sample.translation = Vec3(table.at(row, 4), table.at(row, 5), table.at(row, 6));
  }
  return result;
}

AttitudeTable read_own(const std::string& text, const std::string& file) {
  const auto found = line_with(text, "time_s");
  const std::string_view names = found ? found->text : std::string_view();
  const bool in_degrees = !(has(names, "roll_rad") || has(names, "pitch_rad") || has(names, "yaw_rad"));
  const char* unit = in_degrees ? "deg" : "rad";
  const auto angle = [&](const char* name) { return fmt::format("{}_{}", name, unit); };
  return from_columns(text, file,
                      {"time_s", angle("roll"), angle("pitch"), angle("yaw"), "surge_m", "sway_m", "heave_m"},
                      has(names, "surge_m") || has(names, "sway_m") || has(names, "heave_m"), in_degrees, {}, 0);
}

// The sign of pitch is chosen so that its rate correlates positively with the angular velocity about y.
AttitudeTable read_floating_info(const std::string& text, const std::string& file, const FoundLine& names) {
  const TableLayout layout{';', 0};
  AttitudeTable table = from_columns(
      text, file, {"time [s]", "roll [deg]", "pitch [deg]", "yaw [deg]", "surge [m]", "sway [m]", "heave [m]"},
      has(names.text, "surge [m]"), true, layout, names.number);
  if (!has(names.text, "fomega.y [rad/s]")) return table;
  const Table rate = parse_table(text, file, {"fomega.y [rad/s]"}, layout, names.number);
  double agreement = 0;
  for (std::size_t n = 1; n < rate.rows(); ++n) {
    const double difference = table.samples[n].angles.y() - table.samples[n - 1].angles.y();
    agreement += difference * 0.5 * (rate.at(n, 0) + rate.at(n - 1, 0));
  }
  if (agreement < 0) {
    for (MotionSample& sample : table.samples) sample.angles.y() = -sample.angles.y();
  }
  return table;
}

AttitudeTable read_openfast(const std::string& text, const std::string& file, const FoundLine& names) {
  // The next line holds the units, in parentheses below the names.
  std::string_view rest = text;
  for (int i = 0; i < names.number; ++i) next_line(rest);
  std::string_view units = next_line(rest), line = names.text;
  bool in_degrees = true;
  for (std::string_view name = next_word(line); !name.empty(); name = next_word(line)) {
    const std::string_view unit = next_word(units);
    if (name != "PtfmRoll" && name != "PtfmPitch" && name != "PtfmYaw") continue;
    if (unit != "(deg)" && unit != "(rad)") {
      throw InputError(
          fmt::format("{}:{}: unit '{}' of {}: must be (deg) or (rad)", file, names.number + 1, unit, name));
    }
    in_degrees = unit == "(deg)";
  }
  return from_columns(text, file, {"Time", "PtfmRoll", "PtfmPitch", "PtfmYaw", "PtfmSurge", "PtfmSway", "PtfmHeave"},
                      has(names.text, "PtfmSurge"), in_degrees, {' ', 1}, names.number);
}

}  // namespace

AttitudeTable read_attitude_table(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  if (const auto names = line_with(text, "roll [deg]")) return read_floating_info(text, file.string(), *names);
  if (const auto names = line_with(text, "PtfmRoll")) return read_openfast(text, file.string(), *names);
  return read_own(text, file.string());
}

}  // namespace seaglint
