// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/rao_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "sim/core/text/words.h"
#include "sim/motion/ship/ship_response.h"

namespace seaglint {

namespace {

// Words of a file with their line numbers.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : file_(file.string()), text_(read_file(file)), rest_(text_) {}

  bool at_end() const { return rest_.find_first_not_of(" \t\r\n") == std::string_view::npos; }
  std::string place() const { return fmt::format("{}:{}", file_, line_); }
  const std::string& file() const { return file_; }

  std::string_view line() {
    ++line_;
    return next_line(rest_);
  }

  // The numbers of the next line that is not empty: exactly `count`, all finite.
  std::vector<double> numbers(std::size_t count, const char* what) {
    std::string_view text;
    do {
      if (at_end()) throw InputError(fmt::format("{}: ends where {} should follow", place(), what));
      text = line();
    } while (text.find_first_not_of(" \t\r") == std::string_view::npos);
    std::vector<double> values;
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
      const std::optional<double> value = parse_number(word);
      if (!value) {
        throw InputError(fmt::format("{}: {}: value '{}': must be a finite number", place(), what, word));
      }
      values.push_back(*value);
    }
    if (values.size() != count) {
      throw InputError(fmt::format("{}: {}: {} numbers: must be {}", place(), what, values.size(), count));
    }
    return values;
  }

 private:
  std::string file_;
  std::string text_;
  std::string_view rest_;
  int line_ = 0;
};

using Heading = std::vector<MotionRao>;  // by frequency

// Response of a port-starboard symmetric ship to the wave from the opposite side.
MotionRao mirrored(const MotionRao& r) { return {r.surge, -r.sway, r.heave, -r.roll, r.pitch, -r.yaw}; }

double wrapped(double angle) {
  const double wrapped_angle = angle - 2 * kPi * std::ceil(angle / (2 * kPi) - 0.5);
  return wrapped_angle <= -kPi + 1e-9 ? wrapped_angle + 2 * kPi : wrapped_angle;
}

RaoTable table_of(std::string source, const std::map<double, Heading>& headings, std::vector<double> omega,
                  const Vec3& reference, double speed) {
  std::vector<double> mu;
  std::vector<MotionRao> responses;
  for (const auto& [direction, values] : headings) {
    mu.push_back(direction);
    responses.insert(responses.end(), values.begin(), values.end());
  }
  return RaoTable(std::move(source), std::move(mu), std::move(omega), std::move(responses), reference, speed);
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
    const double across = wrapped(-mu);
    if (headings.contains(across) || std::abs(std::abs(mu) - kPi) < 1e-6 || std::abs(mu) < 1e-6) continue;
    Heading& image = other[across];
    for (const MotionRao& value : values) image.push_back(mirrored(value));
  }
  headings.merge(other);
}

void check_ascending(const std::vector<double>& omega, double value, const std::string& place) {
  if (value > 0 && (omega.empty() || value > omega.back())) return;
  throw InputError(fmt::format("{}: frequency {} rad/s: must be greater than {} of the one before", place, value,
                               omega.empty() ? 0.0 : omega.back()));
}

}  // namespace

// Layout: five lines of text, one of the program, density and gravity, L B T, LCG and VCG, counts of speeds, headings,
// frequencies and degrees of freedom; for each speed a line (speed, sinkage, trim, x aft of amidships and z above the
// keel of the reference point), for each heading its angle, for each frequency its value and a line per degree of
// freedom. Axes: heading 0 is a head sea, x aft, y to starboard, z up, e^{+iwt}: mu = heading + 180 deg; surge, sway,
// roll and pitch change sign, heave and yaw do not.
RaoTable read_veres_rao(const std::filesystem::path& file, double speed) {
  Words words(file);
  const std::string_view title = words.line();
  if (title.find("MOTION TRANSFER FUNCTIONS") == std::string_view::npos ||
      title.find("VERES") == std::string_view::npos) {
    throw InputError(
        fmt::format("{}: no motion transfer functions of VERES: the first line is '{}'", words.place(), title));
  }
  for (int i = 0; i < 5; ++i) words.line();
  words.numbers(2, "density and gravity");
  const double draught = words.numbers(3, "length, breadth and draught")[2];
  words.numbers(2, "centre of gravity");
  const std::vector<double> counts = words.numbers(4, "counts");
  if (counts[3] != 6) throw InputError(fmt::format("{}: {} degrees of freedom: must be 6", words.place(), counts[3]));
  for (const double count : counts) {
    if (!(count >= 1 && count <= 10000 && count == std::floor(count))) {
      throw InputError(fmt::format("{}: count {}: must be a whole number within 1 and 10000", words.place(), count));
    }
  }

  std::vector<double> speeds;
  std::optional<RaoTable> nearest;
  for (int v = 0; v < static_cast<int>(counts[0]); ++v) {
    const std::vector<double> state = words.numbers(5, "speed and reference point");
    speeds.push_back(state[0]);
    std::map<double, Heading> headings;
    std::vector<double> omega;
    for (int h = 0; h < static_cast<int>(counts[1]); ++h) {
      const double mu = wrapped(radians(words.numbers(1, "heading")[0] + 180));
      Heading values;
      for (int n = 0; n < static_cast<int>(counts[2]); ++n) {
        const double frequency = words.numbers(1, "frequency")[0];
        if (h == 0) {
          check_ascending(omega, frequency, words.place());
          omega.push_back(frequency);
        } else if (frequency != omega[static_cast<std::size_t>(n)]) {
          throw InputError(fmt::format("{}: frequency {}: must be {} as at the first heading", words.place(), frequency,
                                       omega[static_cast<std::size_t>(n)]));
        }
        std::array<Complex, 6> x;
        for (std::size_t d = 0; d < 6; ++d) {
          const std::vector<double> row = words.numbers(3, "degree of freedom");
          if (row[0] != static_cast<double>(d + 1)) {
            throw InputError(fmt::format("{}: degree of freedom {}: must be {}", words.place(), row[0], d + 1));
          }
          x[d] = {row[1], row[2]};
        }
        values.push_back({-x[0], -x[1], x[2], -x[3], -x[4], x[5]});
      }
      headings[mu] = values;
    }
    add_mirrored_headings(headings);
    if (!nearest || std::abs(state[0] - speed) < std::abs(nearest->speed() - speed)) {
      nearest = table_of(words.file(), headings, omega, {-state[3], 0, state[4] - draught}, state[0]);
    }
  }
  // Half a knot: the encounter frequency that the responses belong to.
  constexpr double kSpeedSlack = 0.26;
  if (std::abs(nearest->speed() - speed) > kSpeedSlack) {
    throw InputError(fmt::format("{}: no responses at a speed of {:.4g} m/s: it contains {:.4g} m/s", words.file(),
                                 speed, fmt::join(speeds, ", ")));
  }
  return *nearest;
}

// Rows `PER BETA I MOD PHA RE IM`: period in s, direction of propagation and phase in degrees, e^{+iwt}; mode I is over
// A / ULEN^n with n = 0 for translations, 1 for rotations. PER < 0 stands for zero frequency, 0 for infinite.
RaoTable read_wamit_rao(const std::filesystem::path& file, double unit_length, const Vec3& reference) {
  Words words(file);
  std::map<double, std::map<double, std::array<std::optional<Complex>, 6>>> rows;  // [mu][omega]
  while (!words.at_end()) {
    const std::vector<double> row = words.numbers(7, "PER BETA I MOD PHA RE IM");
    if (row[0] <= 0) continue;
    const double mode = row[2];
    if (!(mode >= 1 && mode <= 6 && mode == std::floor(mode))) {
      throw InputError(fmt::format("{}: mode {}: must be 1 to 6", words.place(), mode));
    }
    const Complex value(row[5], row[6]);
    if (std::abs(std::abs(value) - row[3]) > 1e-3 * row[3] + 1e-12) {
      throw InputError(fmt::format("{}: modulus {}: its real and imaginary part give {:.6g}", words.place(), row[3],
                                   std::abs(value)));
    }
    auto& cell = rows[wrapped(radians(row[1]))][2 * kPi / row[0]][static_cast<std::size_t>(mode) - 1];
    if (cell) {
      throw InputError(
          fmt::format("{}: period {} s, heading {} deg, mode {}: duplicate", words.place(), row[0], row[1], mode));
    }
    cell = mode > 3 ? value / unit_length : value;
  }
  if (rows.empty()) throw InputError(fmt::format("{}: contains no responses", words.file()));

  std::vector<double> omega;
  for (const auto& [frequency, modes] : rows.begin()->second) omega.push_back(frequency);
  std::map<double, Heading> headings;
  for (const auto& [mu, by_omega] : rows) {
    std::size_t n = 0;
    for (const auto& [frequency, modes] : by_omega) {
      if (n >= omega.size() || frequency != omega[n++]) {
        throw InputError(fmt::format("{}: heading {:.4g} deg has other periods than {:.4g} deg", words.file(),
                                     degrees(mu), degrees(rows.begin()->first)));
      }
      const auto at = [&](std::size_t mode) {
        if (!modes[mode]) {
          throw InputError(fmt::format("{}: period {:.6g} s, heading {:.4g} deg: mode {} is missing", words.file(),
                                       2 * kPi / frequency, degrees(mu), mode + 1));
        }
        return *modes[mode];
      };
      headings[mu].push_back({at(0), at(1), at(2), at(3), at(4), at(5)});
    }
    if (n != omega.size()) {
      throw InputError(fmt::format("{}: heading {:.4g} deg has {} periods where {:.4g} deg has {}", words.file(),
                                   degrees(mu), n, degrees(rows.begin()->first), omega.size()));
    }
  }
  add_mirrored_headings(headings);
  return table_of(words.file(), headings, omega, reference, 0);
}

}  // namespace seaglint
