// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/long_waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr Complex kJ{0, 1};
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

}  // namespace seaglint
