// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/recorded/attitude_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

namespace {

// Half of the range of t_n - n h, the least distance of all times from a grid of step h.
double deviation_from(const std::vector<double>& time, double step) {
  double lowest = 0, highest = 0;  // relative to the first time
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double residual = time[n] - time.front() - static_cast<double>(n) * step;
    lowest = std::min(lowest, residual);
    highest = std::max(highest, residual);
  }
  return 0.5 * (highest - lowest);
}

// Whether a grid lies within `rounding` of all times. The deviation is convex in the step: golden sections find its
// minimum.
bool lie_on_a_grid(const std::vector<double>& time, double rounding) {
  constexpr double kGolden = 0.6180339887498949;
  const auto last = static_cast<double>(time.size() - 1);
  const double span = time.back() - time.front();
  const double limit = rounding + 1e-9 * span / last;
  double low = (span - 2 * rounding) / last, high = (span + 2 * rounding) / last;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = deviation_from(time, left), at_right = deviation_from(time, right);
  for (int i = 0; i < 60 && std::min(at_left, at_right) > limit; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = deviation_from(time, left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = deviation_from(time, right);
    }
  }
  return std::min(at_left, at_right) <= limit;
}

// Half of the last decimal that the numbers of a column have; 0 where they have more digits than a double.
double rounding_of(const TextTable& table, std::size_t column) {
  int decimals = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<int> own = significant_decimals(table.text(row, column));
    if (!own) return 0;
    decimals = std::max(decimals, *own);
  }
  return 0.5 * std::pow(10.0, -decimals);
}

// Columns of the table.
constexpr std::size_t kTimeColumn = 0, kFirstAngleColumn = 1;  // then roll, pitch, yaw
constexpr std::size_t kFirstShiftColumn = 4;                   // then surge, sway, heave
constexpr std::size_t kPitchRateColumn = 7;

// Rows of the file: angles in rad and translations in m, in the conventions of this project.
struct AttitudeTable {
  TextTable table;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  bool pitch_reversed = false;  // so that it agrees with the angular velocity of the file

  bool in_radians(std::size_t axis) const;  // roll, pitch or yaw, as the file declares
};

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

bool AttitudeTable::in_radians(std::size_t axis) const { return table.key(kFirstAngleColumn + axis).ends_with("_rad"); }

// Degrees of freedom that the table does not have are 0. `translations`: surge, sway and heave are needed, in metres.
// Throws InputError with file, line and column.
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

// Slopes at the knots of the natural cubic spline through values y at ascending times t: continuous second derivative
// gives a tridiagonal system, zero curvature at both ends.
std::vector<double> spline_slopes(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> diagonal(n), upper(n), slope(n);
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (t[i + 1] - t[i]); };
  diagonal[0] = 2;
  upper[0] = 1;
  slope[0] = 3 * chord(0);
  for (std::size_t i = 1; i < n; ++i) {
    const bool last = i + 1 == n;
    const double before = 1 / (t[i] - t[i - 1]);
    const double after = last ? 0 : 1 / (t[i + 1] - t[i]);
    const double lower = last ? 1 : before;
    const double factor = lower / diagonal[i - 1];
    diagonal[i] = (last ? 2 : 2 * (before + after)) - factor * upper[i - 1];
    upper[i] = after;
    const double right = last ? 3 * chord(i - 1) : 3 * (before * chord(i - 1) + after * chord(i));
    slope[i] = right - factor * slope[i - 1];
  }
  slope[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) slope[i] = (slope[i] - upper[i] * slope[i + 1]) / diagonal[i];
  return slope;
}

template <typename Value, typename Rate>
void set_rates(AttitudeSeries& series, Value MotionSample::*value, Rate MotionSample::*rate) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> y;
    for (const MotionSample& sample : series.samples) y.push_back((sample.*value)[axis]);
    const std::vector<double> slope = spline_slopes(series.time, y);
    for (std::size_t i = 0; i < slope.size(); ++i) (series.samples[i].*rate)[axis] = slope[i];
  }
}

// Factor between an angle in degrees and in radians.
constexpr double kDegreesPerRadian = 180 / kPi;
constexpr std::size_t kWindow = 20;  // samples before and after a jump

double rms(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i] * values[i];
  return std::sqrt(sum / static_cast<double>(end - begin));
}

bool is_57_fold(double factor, double slack) {
  const double up = std::abs(factor) / kDegreesPerRadian;
  const double down = std::abs(factor) * kDegreesPerRadian;
  return (up > 1 / slack && up < slack) || (down > 1 / slack && down < slack);
}

// Rejects values that change by a factor of 57 from one line to the next and keep the new scale.
void check_unit_change(const TextTable& table, std::size_t column, const std::vector<double>& angle) {
  for (std::size_t n = kWindow; n + kWindow <= angle.size(); ++n) {
    const double slope = angle[n - 1] - angle[n - 2];
    const double expected = angle[n - 1] + slope;
    if (expected == 0 || !is_57_fold(angle[n] / expected, 1.3)) continue;
    if (!is_57_fold(angle[n + 1] / (expected + slope), 1.6)) continue;
    // Within a window the amplitude of the motion itself may change by a small factor.
    if (!is_57_fold(rms(angle, n, n + kWindow) / rms(angle, n - kWindow, n), 8)) continue;
    table.fail(n, column,
               fmt::format("a 57-fold jump from {}, as between radians and degrees: the unit changes within the file",
                           table.text(n - 1, column)));
  }
}

// Plausible range: roll and pitch within 90 deg, heading within two turns.
void check_radians(const AttitudeTable& table) {
  constexpr std::array<double, 3> kLargest{0.5 * kPi, 0.5 * kPi, 4 * kPi};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> angle;
    for (const MotionSample& sample : table.samples) angle.push_back(sample.angles[static_cast<int>(axis)]);
    if (!table.table.has(kFirstAngleColumn + axis)) continue;
    check_unit_change(table.table, kFirstAngleColumn + axis, angle);
    for (std::size_t n = 0; n < angle.size(); ++n) {
      if (std::abs(angle[n]) <= kLargest[axis]) continue;
      const bool in_radians = table.in_radians(axis);
      table.table.fail(
          n, kFirstAngleColumn + axis,
          fmt::format("must be within {:.4g} {}{}", in_radians ? kLargest[axis] : degrees(kLargest[axis]),
                      in_radians ? "rad" : "deg",
                      in_radians ? ": these look like degrees where radians are declared, 57 times too large" : ""));
    }
  }
}

void check_times(const AttitudeTable& table) {
  table.table.check_ascending(kTimeColumn);
  std::vector<double> steps;
  for (std::size_t n = 1; n < table.time.size(); ++n) steps.push_back(table.time[n] - table.time[n - 1]);
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  constexpr double kWidestGap = 10;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (steps[n] <= kWidestGap * usual * (1 + 1e-9)) continue;
    table.table.fail(
        n + 1, kTimeColumn,
        fmt::format("a gap of {:.4g} s after {}, where the usual step is {:.4g} s", steps[n], table.time[n], usual));
  }
}

void unwrap_yaw(std::vector<MotionSample>& samples) {
  for (std::size_t n = 1; n < samples.size(); ++n) {
    double& yaw = samples[n].angles.z();
    yaw -= 2 * kPi * std::round((yaw - samples[n - 1].angles.z()) / (2 * kPi));
  }
}

// Mean of a quantity of the samples over time by the trapezoidal rule.
template <typename Quantity>
double mean_of(const std::vector<double>& time, const std::vector<MotionSample>& samples, const Quantity& quantity) {
  double sum = 0;
  for (std::size_t n = 1; n < time.size(); ++n)
    sum += 0.5 * (time[n] - time[n - 1]) * (quantity(samples[n]) + quantity(samples[n - 1]));
  return sum / (time.back() - time.front());
}

bool is_removed(MeanRule rule, double size, double largest) {
  return rule == MeanRule::kRemove || (rule == MeanRule::kAuto && size > largest);
}

// Removes the mean yaw of unwrapped samples by the rule; what was done, for users.
std::string remove_heading(AttitudeTable& table, MeanRule rule, bool translations) {
  const auto mean = [&](const auto& quantity) { return mean_of(table.time, table.samples, quantity); };
  const double along = mean([](const MotionSample&sample) { return std::cos(sample.angles.z()); }),
               across = mean([](const MotionSample&sample) { return std::sin(sample.angles.z()); });
  constexpr double kShortest = 0.5, kMentioned_deg = 1;
  if (std::hypot(along, across) < kShortest) return ", yaw turns too far for a mean heading";
  const double heading = std::atan2(across, along), heading_deg = degrees(heading) + (heading < 0 ? 360 : 0);
  const bool removes = is_removed(rule, std::abs(degrees(heading)), kLargestHeading_deg);
  if (!removes) {
    if (std::abs(degrees(heading)) < kMentioned_deg) return "";
    return fmt::format(", mean heading {:.4g} deg kept", heading_deg);
  }
  const double turns =
      std::round(mean([&](const MotionSample& sample) { return sample.angles.z() - heading; }) / (2 * kPi));
  const double c = std::cos(heading), s = std::sin(heading);
  for (MotionSample& sample : table.samples) {
    sample.angles.z() -= heading + 2 * kPi * turns;
    const double x = sample.translation.x(), y = sample.translation.y();
    sample.translation.x() = c * x + s * y;
    sample.translation.y() = c * y - s * x;
  }
  const bool has_shifts = table.table.has(kFirstShiftColumn) || table.table.has(kFirstShiftColumn + 1);
  return fmt::format(", mean heading {:.4g} deg removed{}", heading_deg,
                     translations && has_shifts ? ", surge and sway turned with it" : "");
}

// Removes the mean translations by the rule; what was done, for users.
std::string remove_position(AttitudeTable& table, MeanRule rule) {
  Vec3 mean;
  for (int axis = 0; axis < 3; ++axis)
    mean[axis] = mean_of(table.time, table.samples, [&](const MotionSample& s) { return s.translation[axis]; });
  const double distance_m = std::hypot(mean.x(), mean.y());
  const bool sideways = distance_m > 0 && is_removed(rule, distance_m, kLargestDistance_m),
             upwards = mean.z() != 0 && is_removed(rule, std::abs(mean.z()), kLargestHeave_m);
  for (MotionSample& sample : table.samples)
    sample.translation -= Vec3(sideways ? mean.x() : 0, sideways ? mean.y() : 0, upwards ? mean.z() : 0);
  std::string text;
  if (sideways) text += fmt::format(", mean position ({:.1f}, {:.1f}) m removed", mean.x(), mean.y());
  if (upwards) text += fmt::format(", mean heave {:.1f} m removed", mean.z());
  if (!sideways && distance_m > kLargestDistance_m)
    text += fmt::format(", mean position ({:.1f}, {:.1f}) m kept", mean.x(), mean.y());
  if (!upwards && std::abs(mean.z()) > kLargestHeave_m) text += fmt::format(", mean heave {:.1f} m kept", mean.z());
  return text;
}

// The degrees of freedom that the table lacks, of those that are needed.
std::string absent_degrees(const TextTable& table, bool translations) {
  constexpr std::pair<std::size_t, const char*> kOthers[] = {{kFirstAngleColumn + 2, "yaw"},
                                                             {kFirstShiftColumn, "surge"},
                                                             {kFirstShiftColumn + 1, "sway"},
                                                             {kFirstShiftColumn + 2, "heave"}};
  std::vector<const char*> absent;
  for (const auto& [column, name] : kOthers) {
    if (!table.has(column) && (translations || column < kFirstShiftColumn)) absent.push_back(name);
  }
  return absent.empty() ? "" : fmt::format(", {} not in the file: 0", fmt::join(absent, " and "));
}

struct GridReading {
  TimeGrid grid = TimeGrid::kUniform;
  double rounding = 0;  // s, half of the last decimal
};

std::string reading_of(const AttitudeTable& table, const GridReading& times) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < kFirstAngleColumn + 3; ++i) {
    if (table.table.has(i)) columns.push_back(table.table.key(i));
  }
  const double step = (table.time.back() - table.time.front()) / static_cast<double>(table.time.size() - 1);
  std::string text = fmt::format("{} rows, {}", table.time.size(), fmt::join(columns, " "));
  if (times.grid == TimeGrid::kRounded)
    text += fmt::format(", times rounded to {:g} s taken as uniform at {:.6g} s", 2 * times.rounding, step);
  if (times.grid == TimeGrid::kIrregular) text += ", times are not uniform: resampled at their smallest step";
  if (table.table.has_decimal_commas()) text += ", decimal commas";
  if (table.pitch_reversed) text += ", sign of pitch reversed to agree with its angular velocity";
  return text;
}

// Index of the last sample before time t.
std::size_t interval_of(const std::vector<double>& time, double t) {
  const auto above = std::upper_bound(time.begin(), time.end() - 1, t);
  return static_cast<std::size_t>(std::max<long>(above - time.begin() - 1, 0));
}

}  // namespace

TimeGrid make_uniform(std::vector<double>& time, double rounding) {
  constexpr double kUniform = 1e-3, kMostRounding = 0.35;  // of a step
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  double smallest = step, largest = step;
  for (std::size_t n = 1; n < time.size(); ++n) {
    smallest = std::min(smallest, time[n] - time[n - 1]);
    largest = std::max(largest, time[n] - time[n - 1]);
  }
  if (largest - smallest <= kUniform * step) return TimeGrid::kUniform;
  if (rounding > kMostRounding * step || !lie_on_a_grid(time, rounding)) return TimeGrid::kIrregular;
  for (std::size_t n = 1; n + 1 < time.size(); ++n) time[n] = time.front() + step * static_cast<double>(n);
  return TimeGrid::kRounded;
}

AttitudeSeries read_attitude_series(const std::filesystem::path& file, const SeriesRules& rules) {
  AttitudeTable table = read_attitude_table(file, rules.translations);
  check_times(table);
  check_radians(table);
  unwrap_yaw(table.samples);
  GridReading times{TimeGrid::kUniform, rounding_of(table.table, kTimeColumn)};
  times.grid = make_uniform(table.time, times.rounding);
  std::string reading = reading_of(table, times) + absent_degrees(table.table, rules.translations);
  if (rules.translations) reading += remove_position(table, rules.position);
  reading += remove_heading(table, rules.heading, rules.translations);
  AttitudeSeries series{file.string(), std::move(table.time), std::move(table.samples), std::move(reading), times.grid};
  set_rates(series, &MotionSample::angles, &MotionSample::angle_rates);
  set_rates(series, &MotionSample::translation, &MotionSample::translation_rates);
  return series;
}

Trajectory trajectory_of(const AttitudeSeries& series, double start_s, double duration_s, bool translations,
                         const Vec3& rest_position, const Vec3& rotation_centre) {
  const std::vector<double>& time = series.time;
  // Half of the tolerance of the trajectory at its ends.
  const double slack = 0.5 * Trajectory::kEndSlack * (time.back() - time.front());
  if (start_s < time.front() - slack || start_s + duration_s > time.back() + slack) {
    const bool begins_outside = start_s < time.front() - slack || start_s > time.back();
    throw InputError(fmt::format(
        "{}: lasts from {:.12g} to {:.12g} s, {:.12g} to {:.12g} s are needed{}", series.source, time.front(),
        time.back(), start_s, start_s + duration_s,
        begins_outside ? fmt::format(": motion.series_start_s, now {:.12g}, is the time of the file that is t = 0; its "
                                     "first is {:.12g}",
                                     start_s, time.front())
                       : ""));
  }
  const double span = time.back() - time.front();
  std::vector<MotionSample> samples;
  double step = span / static_cast<double>(time.size() - 1);
  if (series.grid != TimeGrid::kIrregular) {
    samples = series.samples;
  } else {
    constexpr double kMaxSamples = 1e7;
    double smallest = span;
    for (std::size_t n = 1; n < time.size(); ++n) smallest = std::min(smallest, time[n] - time[n - 1]);
    const double count = std::ceil(span / smallest - 1e-9);
    if (count > kMaxSamples) {
      throw InputError(fmt::format("{}: a smallest step of {:.3g} s in {:.6g} s: must make at most {:.0e} steps",
                                   series.source, smallest, span, kMaxSamples));
    }
    step = span / count;
    for (std::size_t n = 0; n <= static_cast<std::size_t>(count); ++n) {
      const double t = std::min(time.front() + step * static_cast<double>(n), time.back());
      const std::size_t i = interval_of(time, t);
      const Trajectory piece(time[i], time[i + 1] - time[i], {series.samples[i], series.samples[i + 1]}, Vec3::Zero(),
                             Vec3::Zero());
      samples.push_back(piece.sample(std::clamp(t, piece.start_s(), piece.end_s())));
    }
  }
  if (!translations) {
    for (MotionSample& sample : samples) sample.translation = sample.translation_rates = Vec3::Zero();
  }
  return Trajectory(time.front() - start_s, step, std::move(samples), rest_position, rotation_centre);
}

}  // namespace seaglint
