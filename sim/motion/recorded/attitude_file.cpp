// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/recorded/attitude_file.h"

#include <fmt/format.h>

#include <string_view>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr std::size_t kPitchRateColumn = 7;

// Columns by the names of this project and DualSPHysics (roll), and of OpenFAST (PtfmRoll).
std::vector<TableColumn> columns() {
  std::vector<TableColumn> all{"time_s"};
  for (const char* angle : {"roll", "pitch", "yaw"}) {
    std::vector<std::string> keys;
    for (const char* name : {"{}_deg", "{}_rad", "ptfm{}_deg", "ptfm{}_rad"})
      keys.push_back(fmt::format(fmt::runtime(name), angle));
    all.emplace_back(keys, std::string_view(angle) != "yaw");
  }
  for (const char* shift : {"surge", "sway", "heave"}) {
    std::vector<std::string> keys{fmt::format("{}_m", shift), fmt::format("ptfm{}_m", shift)};
    all.emplace_back(keys, false);
  }
  all.emplace_back(std::vector<std::string>{"fomega_y_rad_s"}, false);
  return all;
}

// The sign of pitch, which changed between versions of DualSPHysics, is chosen so that its rate correlates positively
// with the angular velocity about y. True if it is reversed.
bool align_pitch(const TextTable& table, std::vector<MotionSample>& samples) {
  if (!table.has(kPitchRateColumn)) return false;
  double agreement = 0;
  for (std::size_t n = 1; n < table.rows(); ++n) {
    const double difference = samples[n].angles.y() - samples[n - 1].angles.y();
    agreement += difference * 0.5 * (table.number(n, kPitchRateColumn) + table.number(n - 1, kPitchRateColumn));
  }
  if (!(agreement < 0)) return false;
  for (MotionSample& sample : samples) sample.angles.y() = -sample.angles.y();
  return true;
}

}  // namespace

bool AttitudeTable::in_radians(std::size_t axis) const { return table.key(kFirstAngleColumn + axis).ends_with("_rad"); }

AttitudeTable read_attitude_table(const std::filesystem::path& file, bool translations) {
  AttitudeTable result{TextTable(TextSource::read(file), columns()), {}, {}};
  const TextTable& table = result.table;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    table.require_unit(kFirstAngleColumn + axis);
    if (translations) table.require_unit(kFirstShiftColumn + axis);
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    result.time.push_back(table.number(row, kTimeColumn));
    MotionSample& sample = result.samples.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t turn = kFirstAngleColumn + axis, shift = kFirstShiftColumn + axis;
      if (table.has(turn)) {
        const double angle = table.number(row, turn);
        sample.angles[static_cast<int>(axis)] = result.in_radians(axis) ? angle : radians(angle);
      }
      if (table.has(shift)) sample.translation[static_cast<int>(axis)] = table.number(row, shift);
    }
  }
  result.pitch_reversed = align_pitch(table, result.samples);
  return result;
}

}  // namespace seaglint
