// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/rao_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr double kHeaveSlack = 0.1;                      // of 1, at the lowest frequency
constexpr double kWrongHeave = 0.2, kWrongRotation = 2;  // differences and factors that are refused
constexpr double kRestless = 0.1;                        // heave of a body that moves at all
constexpr double kAlong = 0.3420201433256687;            // cos(70 deg)

double wavenumber(double omega) { return omega * omega / kGravity; }

// A response, over its limit, as a function of the table's values, frequency and heading.
using Ratio = std::function<Complex(const MotionRao&, double omega, double mu)>;

// Tolerances of a limit: change by the extrapolation, of the two frequencies, and between headings, each relative.
struct Reach {
  double extrapolated, next, headings;
};

struct LowestFrequencies {
  double first = 0, second = 0;  // rad/s; second = 0: there is only one
};

LowestFrequencies lowest_of(const RaoTable& table) {
  constexpr double kApart = 1.02;  // closer ones extrapolate the digits of the table
  LowestFrequencies lowest{table.omegas().front()};
  const auto next = std::find_if(table.omegas().begin(), table.omegas().end(),
                                 [&](double omega) { return omega >= kApart * lowest.first; });
  if (next != table.omegas().end()) lowest.second = *next;
  return lowest;
}

// The mean of a ratio over the headings that `selects`, extrapolated to zero frequency; nullopt where it is not
// reached.
std::optional<Complex> limit_of(const RaoTable& table, const std::function<bool(double mu)>& selects,
                                const Ratio& ratio, const Reach& reach) {
  const auto [first, second] = lowest_of(table);
  if (second == 0) return std::nullopt;
  const double part = first * first / (second * second - first * first);
  std::vector<Complex> limits;
  Complex mean = 0;
  for (const double mu : table.headings()) {
    if (!selects(mu)) continue;
    const Complex at_first = ratio(table.at(first, wavenumber(first), mu), first, mu);
    const Complex at_second = ratio(table.at(second, wavenumber(second), mu), second, mu);
    const Complex limit = at_first - part * (at_second - at_first);
    if (std::abs(limit - at_first) > reach.extrapolated * std::abs(limit)) return std::nullopt;
    if (std::abs(at_second - at_first) > reach.next * std::abs(at_first)) return std::nullopt;
    limits.push_back(limit);
    mean += limit;
  }
  if (limits.empty()) return std::nullopt;
  mean /= static_cast<double>(limits.size());
  const bool alike = std::ranges::all_of(
      limits, [&](Complex limit) { return std::abs(limit - mean) <= reach.headings * std::abs(mean); });
  return alike ? std::optional(mean) : std::nullopt;
}

bool is_along(double mu) { return std::abs(std::cos(mu)) >= kAlong; }
bool is_across(double mu) { return std::abs(std::sin(mu)) >= kAlong; }
bool is_any(double) { return true; }

constexpr Reach kReachOfHeave{.extrapolated = 0.1, .next = 0.15, .headings = 0.1};
constexpr Reach kReachOfRotation{.extrapolated = 0.2, .next = 0.15, .headings = 0.25};

// All heaves at a frequency, by heading.
std::vector<Complex> heaves_at(const RaoTable& table, double omega) {
  std::vector<Complex> heaves;
  for (const double mu : table.headings()) heaves.push_back(table.at(omega, wavenumber(omega), mu).heave);
  return heaves;
}

bool follow(const std::vector<Complex>& heaves) {
  return std::ranges::all_of(heaves, [](Complex heave) { return std::abs(heave - 1.0) <= kHeaveSlack; });
}

double largest_of(const std::vector<Complex>& heaves) {
  double largest = 0;
  for (const Complex heave : heaves) largest = std::max(largest, std::abs(heave));
  return largest;
}

// Pitch over the direction, without the wavenumber: 1 for a table per slope of the waves.
std::optional<Complex> pitch_per_slope(const RaoTable& table) {
  return limit_of(
      table, is_along, [](const MotionRao& r, double, double mu) { return r.pitch / (kJ * std::cos(mu)); },
      kReachOfHeave);
}

std::string heave_fault(Complex heave, double period_s, const MotionSpec& spec) {
  const double size = std::abs(heave), phase_deg = size > 0 ? std::round(degrees(std::arg(heave))) + 0.0 : 0;
  std::string text = fmt::format(
      "heave in waves of {:.4g} s is {:.2g} at {:g} deg, where a body follows them (1 at 0 deg): ", period_s, size,
      phase_deg);
  constexpr double kNearly = 0.05, kRhoG = kSeaWaterDensity * kGravity;
  if (std::abs(2 * size - 1) < 2 * kNearly && std::abs(phase_deg) < 10) {
    text += fmt::format("responses over the height of the waves? motion.rao_scale: {:.4g}", 2 * spec.rao_scale);
  } else if (std::abs(size * kRhoG / spec.rao_scale - 1) < kNearly) {
    text += fmt::format(
        "responses over rho g, as HAMS writes them? motion.rao_scale: rho g of the run ({:.5g} in sea water), "
        "motion.rao_phase_deg: {:g}",
        kRhoG, std::remainder(spec.rao_phase_deg - phase_deg, 360));
  } else {
    text += fmt::format("motion.rao_scale (now {:g}) and motion.rao_phase_deg (now {:g}) are not the file's",
                        spec.rao_scale, spec.rao_phase_deg);
  }
  return text;
}

std::string rotation_fault(const char* name, Complex ratio, double period_s, const MotionSpec& spec, bool wamit) {
  const double times = std::abs(ratio);
  std::string text = fmt::format("{} in waves of {:.4g} s is {:.3g} times their slope, where a body follows it: ", name,
                                 period_s, times);
  constexpr double kNearly = 0.1;
  if (spec.rao_rotations == RaoRotations::kRadians && std::abs(times / degrees(1) - 1) < kNearly)
    text += "rotations in degrees? motion.rao_rotations: degrees; or ";
  if (wamit && spec.rao_rotations != RaoRotations::kSlope) {
    return text + fmt::format("motion.wamit_ulen_m (now {:g}) is not the file's: {:.3g} makes it 1", spec.wamit_ulen_m,
                              spec.wamit_ulen_m * times);
  }
  return text + "motion.rao_rotations is not the file's";
}

}  // namespace

LongWaveLimits long_wave_limits(const RaoTable& table) {
  const double lowest = table.omegas().front();
  LongWaveLimits limits{2 * kPi / lowest, {}, {}, {}};
  limits.heave = limit_of(
      table, is_any, [](const MotionRao& r, double, double) { return r.heave; }, kReachOfHeave);
  const std::vector<Complex> heaves = heaves_at(table, lowest);
  if (follow(heaves)) {
    Complex mean = 0;
    for (const Complex heave : heaves) mean += heave / static_cast<double>(heaves.size());
    limits.heave = mean;
  }
  limits.pitch = limit_of(
      table, is_along,
      [](const MotionRao& r, double omega, double mu) { return r.pitch / (kJ * wavenumber(omega) * std::cos(mu)); },
      kReachOfRotation);
  limits.roll = limit_of(
      table, is_across,
      [](const MotionRao& r, double omega, double mu) { return r.roll / (-kJ * wavenumber(omega) * std::sin(mu)); },
      kReachOfRotation);
  return limits;
}

LongWaves long_waves_of(const RaoTable& table) {
  const double omega = table.omegas().front(), k = wavenumber(omega);
  int agree = 0, disagree = 0;
  for (const double mu : table.headings()) {
    const double along = std::cos(mu);
    if (!is_along(mu)) continue;
    const MotionRao r = table.at(omega, k, mu);
    if (std::abs(r.heave - 1.0) > kHeaveSlack) return LongWaves::kTooShort;
    const Complex slope = r.pitch / along;
    if (std::abs(slope.imag()) < std::cos(radians(20)) * std::abs(slope) || slope == 0.0) return LongWaves::kTooShort;
    ++(slope.imag() > 0 ? agree : disagree);
  }
  if (agree > 0 && disagree == 0) return LongWaves::kAgree;
  return disagree > 0 && agree == 0 ? LongWaves::kDisagree : LongWaves::kTooShort;
}

std::string long_wave_fault(const RaoTable& table, const MotionSpec& spec, double side_m, bool wamit) {
  const double lowest = table.omegas().front(), highest = table.omegas().back();
  const LongWaveLimits limits = long_wave_limits(table);
  // Heave tends to 1 towards the wrong end of the table.
  if (wamit && lowest < highest && follow(heaves_at(table, highest)) && largest_of(heaves_at(table, lowest)) < 0.5) {
    return fmt::format("heave tends to 1 in its shortest waves: motion.wamit_first_column (now {}) is not the file's",
                       spec.wamit_first_column == WamitFirstColumn::kPeriod ? "period" : "omega");
  }
  if (limits.heave && std::abs(*limits.heave - 1.0) > kWrongHeave)
    return heave_fault(*limits.heave, limits.period_s, spec);
  double largest = 0;
  for (const double omega : table.omegas()) largest = std::max(largest, largest_of(heaves_at(table, omega)));
  const double wavelength_m = 2 * kPi / wavenumber(lowest);
  if (largest < kRestless && wavelength_m > 2 * side_m) {
    return fmt::format(
        "heave is at most {:.3g} in waves of up to {:.4g} m: such a body does not move: motion.rao_scale (now {:g}) is "
        "not the file's",
        largest, wavelength_m, spec.rao_scale);
  }
  if (!limits.heave) return {};
  if (const auto slope = pitch_per_slope(table); slope && spec.rao_rotations == RaoRotations::kRadians) {
    for (const double unit : {1.0, degrees(1)}) {
      if (std::abs(std::abs(*slope) / unit - 1) < 0.25) {
        return fmt::format(
            "pitch in waves of {:.4g} s is {:.3g} times their amplitude over the unit of length, however "
            "long they are: rotations over the slope of the waves? motion.rao_rotations: {}",
            limits.period_s, std::abs(*slope), unit == 1 ? "slope" : "slope_degrees");
      }
    }
  }
  const auto is_wrong = [](const std::optional<Complex>& ratio) {
    return ratio && !(std::abs(*ratio) <= kWrongRotation && std::abs(*ratio) >= 1 / kWrongRotation);
  };
  if (is_wrong(limits.pitch)) return rotation_fault("pitch", *limits.pitch, limits.period_s, spec, wamit);
  if (is_wrong(limits.roll)) return rotation_fault("roll", *limits.roll, limits.period_s, spec, wamit);
  return {};
}

namespace {

// Lines of numbers, in an order that the format gives.
class NumberLines {
 public:
  explicit NumberLines(const std::filesystem::path& file) : source_(TextSource::read(file)), rest_(source_.text()) {}

  const std::string& file() const { return source_.name(); }

  std::string_view line() { return line_ = next_line(rest_); }

  // The numbers of the next line that is not empty: exactly `count`, all finite.
  std::vector<double> numbers(std::size_t count, const char* what) {
    skip_empty_lines();
    if (rest_.empty()) source_.fail(rest_, fmt::format("ends where {} should follow", what));
    std::vector<double> values;
    for (const std::string_view word : words_of(line())) {
      const std::optional<double> value = parse_written_number(word);
      if (!value || !std::isfinite(*value))
        source_.fail(word, fmt::format("{}: value {}: must be a finite number", what, in_quotes(word)));
      values.push_back(*value);
    }
    if (values.size() != count) fail(fmt::format("{}: {} numbers: must be {}", what, values.size(), count));
    return values;
  }

  void require_end() {
    skip_empty_lines();
    if (!rest_.empty())
      source_.fail(trimmed(rest_), fmt::format("{} behind the last block", in_quotes(trimmed(line()))));
  }

  // Throws InputError at the line that was read last.
  [[noreturn]] void fail(const std::string& what) const { source_.fail(trimmed(line_), what); }

 private:
  void skip_empty_lines() {
    while (!rest_.empty() && trimmed(rest_.substr(0, rest_.find('\n'))).empty()) next_line(rest_);
  }

  TextSource source_;
  std::string_view rest_, line_;
};

using Heading = std::vector<MotionRao>;  // by frequency

// Response of a port-starboard symmetric ship to the wave from the opposite side.
MotionRao mirrored(const MotionRao& r) { return {r.surge, -r.sway, r.heave, -r.roll, r.pitch, -r.yaw}; }

// The direction in (-180, 180]; both ends of a circle, 0 and 360 or -180 and 180, are one direction.
double wrapped_deg(double angle_deg) {
  const double angle = std::remainder(angle_deg, 360);
  return angle <= -180 + 1e-7 ? angle + 360 : angle;
}

// Equal to the digits that programs print; what both ends of the circle may differ by.
bool are_equal(Complex a, Complex b) { return std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b)) + 1e-6; }

// A response in rad/m and m/m of one in the units of the keys rao_ of a MotionSpec, to a wave of frequency omega.
MotionRao in_metres(const MotionRao& r, double omega, const MotionSpec& units) {
  const RaoRotations rotations = units.rao_rotations;
  Complex factor = units.rao_scale, turning = factor;
  if (units.rao_phase_deg != 0) turning = factor = std::polar(units.rao_scale, radians(units.rao_phase_deg));
  if (rotations == RaoRotations::kDegrees || rotations == RaoRotations::kSlopeDegrees) turning *= radians(1);
  if (rotations == RaoRotations::kSlope || rotations == RaoRotations::kSlopeDegrees)
    turning *= omega * omega / kGravity;
  return scaled(r, factor, turning);
}

RaoTable table_of(std::string source, const std::map<double, Heading>& headings, std::vector<double> omega,
                  const Vec3& reference, double speed, const MotionSpec& units) {
  const bool are_metres =
      units.rao_scale == 1 && units.rao_phase_deg == 0 && units.rao_rotations == RaoRotations::kRadians;
  std::vector<double> mu;
  std::vector<MotionRao> responses;
  for (const auto& [direction, values] : headings) {
    mu.push_back(direction);
    for (std::size_t n = 0; n < values.size(); ++n)
      responses.push_back(are_metres ? values[n] : in_metres(values[n], omega[n], units));
  }
  return RaoTable(std::move(source), std::move(mu), std::move(omega), std::move(responses), reference, speed);
}

// Throws InputError for a table whose long waves contradict its units.
void check_long_waves(const RaoTable& table, const MotionSpec& spec, double side_m, bool wamit) {
  if (!spec.rao_follows_long_waves) return;
  const std::string fault = long_wave_fault(table, spec, side_m, wamit);
  if (fault.empty()) return;
  throw InputError(
      fmt::format("{}: {}; motion.rao_follows_long_waves: false accepts a restrained body", table.source(), fault));
}

bool one_sided(const std::map<double, Heading>& headings) {
  constexpr double kSlack = 1e-6;
  const auto inside = [](double mu) { return std::abs(mu) < kSlack || std::abs(mu) > kPi - kSlack; };
  bool port = false, starboard = false;
  for (const auto& [mu, values] : headings) {
    if (inside(mu)) continue;
    (mu > 0 ? port : starboard) = true;
  }
  return port != starboard;
}

void add_mirrored_headings(std::map<double, Heading>& headings) {
  if (!one_sided(headings)) return;
  std::map<double, Heading> other;
  for (const auto& [mu, values] : headings) {
    const double across = radians(wrapped_deg(degrees(-mu)));
    if (headings.contains(across) || std::abs(std::abs(mu) - kPi) < 1e-6 || std::abs(mu) < 1e-6) continue;
    Heading& image = other[across];
    for (const MotionRao& value : values) image.push_back(mirrored(value));
  }
  headings.merge(other);
}

bool are_equal(const Heading& a, const Heading& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const MotionRao& p, const MotionRao& q) {
    return are_equal(p.surge, q.surge) && are_equal(p.sway, q.sway) && are_equal(p.heave, q.heave) &&
           are_equal(p.roll, q.roll) && are_equal(p.pitch, q.pitch) && are_equal(p.yaw, q.yaw);
  });
}

// One speed of a file of VERES.
struct VeresBlock {
  double speed = 0;
  Vec3 reference = Vec3::Zero();
  std::vector<double> omega;
  std::map<double, Heading> headings;  // by mu, rad
};

// The frequency of the next line, rad/s: above the one before and, from the second heading on, that of the first.
void read_frequency(NumberLines& lines, VeresBlock& block, bool first_heading, std::size_t n) {
  const double frequency = lines.numbers(1, "frequency")[0];
  if (!first_heading) {
    if (frequency == block.omega[n]) return;
    lines.fail(fmt::format("frequency {}: must be {} as at the first heading", frequency, block.omega[n]));
  }
  const double before = block.omega.empty() ? 0 : block.omega.back();
  if (!(frequency > before))
    lines.fail(fmt::format("frequency {} rad/s: must be greater than {}{}", frequency, before,
                           block.omega.empty() ? "" : " of the one before"));
  block.omega.push_back(frequency);
}

MotionRao read_veres_response(NumberLines& lines) {
  std::array<Complex, 6> x;
  for (std::size_t d = 0; d < 6; ++d) {
    const std::vector<double> row = lines.numbers(3, "degree of freedom");
    if (row[0] != static_cast<double>(d + 1))
      lines.fail(fmt::format("degree of freedom {}: must be {}", row[0], d + 1));
    x[d] = {row[1], row[2]};
  }
  return {-x[0], -x[1], x[2], -x[3], -x[4], x[5]};
}

VeresBlock read_veres_block(NumberLines& lines, int headings, int frequencies, double draught) {
  const std::vector<double> state = lines.numbers(5, "speed and reference point");
  VeresBlock block{state[0], {-state[3], 0, state[4] - draught}, {}, {}};
  std::map<double, double> given;  // headings of the file by mu
  for (int h = 0; h < headings; ++h) {
    const double heading_deg = lines.numbers(1, "heading")[0];
    const double mu = radians(wrapped_deg(heading_deg + 180));
    const auto before = given.find(mu);
    if (before != given.end() && before->second == heading_deg)
      lines.fail(fmt::format("heading {} deg appears twice", heading_deg));
    Heading values;
    for (int n = 0; n < frequencies; ++n) {
      read_frequency(lines, block, h == 0, static_cast<std::size_t>(n));
      values.push_back(read_veres_response(lines));
    }
    const auto [known, is_new] = block.headings.try_emplace(mu, values);
    if (!is_new && !are_equal(known->second, values))
      lines.fail(fmt::format("headings {} and {} deg are one direction with different responses", before->second,
                             heading_deg));
    given[mu] = heading_deg;
  }
  return block;
}

}  // namespace

// Layout: five lines of text, one of the program, density and gravity, L B T, LCG and VCG, counts of speeds, headings,
// frequencies and degrees of freedom; for each speed a line (speed, sinkage, trim, x aft of amidships and z above the
// keel of the reference point), for each heading its angle, for each frequency its value and a line per degree of
// freedom. Axes: heading 0 is a head sea, x aft, y to starboard, z up, e^{+iwt}: mu = heading + 180 deg; surge, sway,
// roll and pitch change sign, heave and yaw do not.
RaoTable read_veres_rao(const std::filesystem::path& file, double speed, const MotionSpec& units, double side_m) {
  NumberLines lines(file);
  const std::string_view title = lines.line();
  if (title.find("MOTION TRANSFER FUNCTIONS") == std::string_view::npos ||
      title.find("VERES") == std::string_view::npos) {
    lines.fail(fmt::format("no motion transfer functions of VERES: the first line is {}", in_quotes(title)));
  }
  for (int i = 0; i < 5; ++i) lines.line();
  lines.numbers(2, "density and gravity");
  const double draught = lines.numbers(3, "length, breadth and draught")[2];
  lines.numbers(2, "centre of gravity");
  const std::vector<double> counts = lines.numbers(4, "counts");
  if (counts[3] != 6) lines.fail(fmt::format("{} degrees of freedom: must be 6", counts[3]));
  for (const double count : counts) {
    if (!(count >= 1 && count <= 10000 && count == std::floor(count)))
      lines.fail(fmt::format("count {}: must be a whole number within 1 and 10000", count));
  }

  std::vector<double> speeds;
  std::optional<RaoTable> nearest;
  for (int v = 0; v < static_cast<int>(counts[0]); ++v) {
    VeresBlock block = read_veres_block(lines, static_cast<int>(counts[1]), static_cast<int>(counts[2]), draught);
    if (std::find(speeds.begin(), speeds.end(), block.speed) != speeds.end())
      lines.fail(fmt::format("speed {} m/s appears twice", block.speed));
    speeds.push_back(block.speed);
    add_mirrored_headings(block.headings);
    if (!nearest || std::abs(block.speed - speed) < std::abs(nearest->speed() - speed))
      nearest = table_of(lines.file(), block.headings, block.omega, block.reference, block.speed, units);
  }
  lines.require_end();
  // Half a knot: the encounter frequency that the responses belong to.
  constexpr double kSpeedSlack = 0.26;
  if (std::abs(nearest->speed() - speed) > kSpeedSlack) {
    throw InputError(fmt::format("{}: no responses at a speed of {:.4g} m/s: it contains {:.4g} m/s", lines.file(),
                                 speed, fmt::join(speeds, ", ")));
  }
  check_long_waves(*nearest, units, side_m, false);
  return *nearest;
}

namespace {

// Columns of WAMIT's .4.
enum : std::size_t { kPeriod, kBeta, kMode, kModulus, kPhase, kRe, kIm };

// What the first column is: frequencies where a line of names says so, else as `given`. Throws InputError for a line of
// names that declares another quantity.
WamitFirstColumn first_column_of(const TextSource& source, WamitFirstColumn given) {
  for (std::string_view rest = source.text(); !rest.empty();) {
    for (const std::string_view word : words_of(next_line(rest))) {
      if (parse_written_number(word)) return given;
      const std::string key = column_key(word);
      if (key == "omega" || key == "omega_rad_s") return WamitFirstColumn::kOmega;
      for (const char* other : {"freq", "frequency", "kl", "nul", "nu", "wavenumber"}) {
        if (key == other)
          source.fail(word, fmt::format("column {}: the first column must be the period or the frequency in rad/s "
                                        "(IPERIO = 1 or 2)",
                                        in_quotes(word)));
      }
    }
  }
  return given;
}

// The first mode of the body that the table is read for, and the number of bodies of its modes. Throws InputError for
// modes that are none, a table of several bodies without wamit_body, and one without that body.
struct WamitModes {
  int first = 1;
  int bodies = 1;
};
WamitModes modes_of(const TextTable& table, const MotionSpec& spec) {
  constexpr int kModes = 6, kMostBodies = 100;
  int highest = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double mode = table.number(row, kMode);
    if (!(mode >= 1 && mode <= kModes * kMostBodies && mode == std::floor(mode)) ||
        (spec.wamit_body == 0 && mode > kModes)) {
      table.fail(row, kMode,
                 "must be a mode, 1 to 6; motion.wamit_body chooses a body of a run of several, body 2 with modes 7 to "
                 "12");
    }
    highest = std::max(highest, static_cast<int>(mode));
  }
  const WamitModes modes{kModes * (std::max(spec.wamit_body, 1) - 1) + 1, (highest + kModes - 1) / kModes};
  if (table.rows() > 0 && modes.first > highest) {
    throw InputError(fmt::format("{}: no modes {} to {} of motion.wamit_body {}: its modes are those of {} bodies",
                                 table.source().name(), modes.first, modes.first + kModes - 1, spec.wamit_body,
                                 modes.bodies));
  }
  return modes;
}

// The response of a row. Throws InputError where modulus and phase are not those of the complex value.
Complex wamit_value(const TextTable& table, std::size_t row) {
  const Complex value(table.number(row, kRe), table.number(row, kIm));
  const double modulus = table.number(row, kModulus, 0), phase = table.number(row, kPhase);
  if (std::abs(std::abs(value) - modulus) > 1e-3 * modulus + 1e-12) {
    table.fail(row, kModulus,
               fmt::format("must be the modulus of the real and imaginary part, {:.6g}", std::abs(value)));
  }
  // Half a degree and the digits of small values.
  if (std::abs(std::polar(modulus, radians(phase)) - value) > 1e-2 * modulus + 1e-6)
    table.fail(row, kPhase,
               fmt::format("must be in degrees: real and imaginary part give {:.6g}", degrees(std::arg(value))));
  return value;
}

struct WamitCell {
  Complex value = 0;
  double beta_deg = 0;  // as the file gives it
};

}  // namespace

// Rows `PER BETA I MOD PHA RE IM`: period in s or frequency in rad/s, heading and phase in degrees, of WAMIT the
// direction of propagation and e^{+iwt}; mode I is over A / ULEN^n with n = 0 for translations, 1 for rotations; modes
// 7 to 12 are those of the second body of a run, and so on. PER < 0 stands for zero frequency, 0 for infinite; as a
// frequency 0 for zero, < 0 for infinite. The wave's phase is that at the origin of the run: a body whose origin is at
// XBODY has e^{+jk.x} of it.
RaoTable read_wamit_rao(const std::filesystem::path& file, const MotionSpec& spec, const Vec3& reference,
                        double side_m) {
  const double turn_deg = spec.wamit_heading == HeadingConvention::kFrom ? 180 : 0;
  const bool conjugate = spec.wamit_time_factor == TimeFactor::kMinus;
  const TextSource source = TextSource::read(file);
  const WamitFirstColumn first_column = first_column_of(source, spec.wamit_first_column);
  const TextTable table = TextTable::without_names(source, {"PER", "BETA", "I", "MOD", "PHA", "RE", "IM"});
  const WamitModes modes_read = modes_of(table, spec);
  std::map<double, std::map<double, std::array<std::optional<WamitCell>, 6>>> rows;  // [mu][omega]
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double period = table.number(row, kPeriod), beta_deg = table.number(row, kBeta);
    const int mode = static_cast<int>(table.number(row, kMode)) - modes_read.first;  // 0 to 5 of the body
    const Complex value = wamit_value(table, row);
    const WamitCell read{conjugate ? std::conj(value) : value, beta_deg};
    if (period <= 0 || mode < 0 || mode > 5) continue;
    const double omega = first_column == WamitFirstColumn::kOmega ? period : 2 * kPi / period;
    auto& cell = rows[radians(wrapped_deg(beta_deg + turn_deg))][omega][static_cast<std::size_t>(mode)];
    if (cell && cell->beta_deg == beta_deg) {
      table.fail(row, kMode,
                 fmt::format("{} {}, heading {} deg, mode {}: duplicate",
                             first_column == WamitFirstColumn::kOmega ? "frequency" : "period",
                             table.text(row, kPeriod), beta_deg, table.text(row, kMode)));
    }
    if (cell && !are_equal(cell->value, read.value)) {
      table.fail(row, kRe,
                 fmt::format("headings {} and {} deg are one direction, where the former has {:.6g}{:+.6g}i",
                             cell->beta_deg, beta_deg, cell->value.real(), cell->value.imag()));
    }
    if (!cell) cell = read;
  }
  if (rows.empty()) throw InputError(fmt::format("{}: contains no responses", source.name()));

  std::vector<double> omega;
  for (const auto& [frequency, modes] : rows.begin()->second) omega.push_back(frequency);
  std::map<double, Heading> headings;
  for (const auto& [heading, by_omega] : rows) {
    const double mu = heading;
    std::size_t n = 0;
    for (const auto& at_frequency : by_omega) {
      const double frequency = at_frequency.first;
      const auto& modes = at_frequency.second;
      if (n >= omega.size() || frequency != omega[n++]) {
        throw InputError(fmt::format("{}: heading {:.4g} deg has other periods than {:.4g} deg", source.name(),
                                     degrees(mu), degrees(rows.begin()->first)));
      }
      const auto& [x, y, z] = spec.wamit_xbody_m;
      const double k = frequency * frequency / kGravity;
      const Complex at_body =
          x == 0 && y == 0 ? Complex(1) : std::polar(1.0, k * (std::cos(mu) * x + std::sin(mu) * y));
      const auto at = [&](std::size_t mode) {
        if (!modes[mode]) {
          throw InputError(fmt::format("{}: period {:.6g} s, heading {:.4g} deg: mode {} is missing", source.name(),
                                       2 * kPi / frequency, degrees(mu), static_cast<int>(mode) + modes_read.first));
        }
        const Complex value = modes[mode]->value * at_body;
        return mode < 3 ? value : value / spec.wamit_ulen_m;
      };
      headings[mu].push_back({at(0), at(1), at(2), at(3), at(4), at(5)});
    }
    if (n != omega.size()) {
      throw InputError(fmt::format("{}: heading {:.4g} deg has {} periods where {:.4g} deg has {}", source.name(),
                                   degrees(mu), n, degrees(rows.begin()->first), omega.size()));
    }
  }
  add_mirrored_headings(headings);
  RaoTable responses = table_of(source.name(), headings, omega, reference, 0, spec);
  if (long_waves_of(responses) == LongWaves::kDisagree) {
    throw InputError(fmt::format(
        "{}: pitch in waves of {:.4g} s has the opposite sign of the waves' slope: motion.wamit_heading (now {}) or "
        "motion.wamit_time_factor (now {}) is not the file's",
        source.name(), 2 * kPi / omega.front(), turn_deg > 0 ? "from" : "towards", conjugate ? "minus" : "plus"));
  }
  check_long_waves(responses, spec, side_m, true);
  return responses;
}

}  // namespace seaglint
