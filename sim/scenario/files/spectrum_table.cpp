// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

double SpectrumTable::energy() const {
  double sum = 0;
  for (std::size_t i = 1; i < omega.size(); ++i) sum += 0.5 * (density[i - 1] + density[i]) * (omega[i] - omega[i - 1]);
  return sum;
}

double SpectrumTable::peak_omega() const {
  return omega[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin())];
}

namespace {

// A word of a file as a number that is finite and at least `lowest`.
double number_of(const TextSource& source, std::string_view word, const char* what, double lowest) {
  const std::optional<double> value = parse_written_number(word);
  if (!value || !std::isfinite(*value) || *value < lowest) {
    source.fail(word, fmt::format("{}: value {}: must be a finite number of at least {:g}{}", what, in_quotes(word),
                                  lowest, lookalike_note(word)));
  }
  return *value;
}

// A spectrum over frequencies in Hz, each with the word that states it.
class HertzSpectrum {
 public:
  explicit HertzSpectrum(const TextSource& source) : source_(source) {}

  // Density in m^2/Hz.
  void add(double frequency_hz, double density, std::string_view word) {
    const double omega = 2 * kPi * frequency_hz;
    if (!spectrum_.omega.empty() && !(omega > spectrum_.omega.back()))
      source_.fail(word, fmt::format("frequency {:g} Hz: must be greater than the one before", frequency_hz));
    spectrum_.omega.push_back(omega);
    spectrum_.density.push_back(density / (2 * kPi));
  }

  SpectrumTable take(std::string reading) {
    if (spectrum_.omega.size() < 2)
      throw InputError(fmt::format("{}: {} frequencies: must be at least 2", source_.name(), spectrum_.omega.size()));
    if (!(spectrum_.energy() > 0)) throw InputError(source_.name() + ": all densities are 0");
    spectrum_.reading = std::move(reading);
    return std::move(spectrum_);
  }

 private:
  const TextSource& source_;
  SpectrumTable spectrum_;
};

// Digits of a time, filled up with zeros to YYYYMMDDhhmmss.
std::string time_digits(std::string_view text) {
  std::string digits;
  for (const char c : text) {
    if (c >= '0' && c <= '9') digits += c;
  }
  constexpr std::size_t kSeconds = 14;
  if (digits.size() < kSeconds) digits.resize(kSeconds, '0');
  return digits.substr(0, kSeconds);
}

std::string shown_time(std::string_view digits) {
  return fmt::format("{}-{}-{} {}:{}", digits.substr(0, 4), digits.substr(4, 2), digits.substr(6, 2),
                     digits.substr(8, 2), digits.substr(10, 2));
}

// The place of the spectrum that `time` chooses among those of a file; 0 of one. Throws InputError for a choice that
// is missing, and for one that the file does not have.
std::size_t chosen(const TextSource& source, const std::vector<std::string>& times, const std::string& time) {
  if (times.empty()) throw InputError(fmt::format("{}: contains no spectrum", source.name()));
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {} spectra, {} to {}: {}", source.name(), times.size(), shown_time(times.front()),
                                 shown_time(times.back()), what));
  };
  if (time.empty()) {
    if (times.size() > 1) refuse("sea.table_time must choose one");
    return 0;
  }
  const std::string digits = time_digits(time);
  const auto found = std::find(times.begin(), times.end(), digits);
  if (found == times.end()) refuse(fmt::format("none of sea.table_time {}", in_quotes(time)));
  if (std::find(found + 1, times.end(), digits) != times.end())
    refuse(fmt::format("several of sea.table_time {}", in_quotes(time)));
  return static_cast<std::size_t>(found - times.begin());
}

// The words of NDBC's line of names: year, month, day, hour, perhaps minute, then frequencies or Sep_Freq.
std::optional<std::vector<std::string_view>> ndbc_names(const TextSource& source) {
  std::string_view rest = source.text();
  std::vector<std::string_view> names;
  while (!rest.empty() && names.empty()) names = words_of(next_line(rest));
  if (names.size() < 5) return std::nullopt;
  if (names[0].starts_with('#')) names[0].remove_prefix(1);
  const bool is_time =
      (names[0] == "YY" || names[0] == "YYYY") && names[1] == "MM" && names[2] == "DD" && names[3] == "hh";
  return is_time ? std::optional(names) : std::nullopt;
}

constexpr double kMissing = 999;  // of NDBC

SpectrumTable read_ndbc(const TextSource& source, const std::vector<std::string_view>& names, const std::string& time) {
  const std::size_t words_of_time = names[4] == "mm" ? 5 : 4;
  if (names.size() <= words_of_time) source.fail(names.back(), "no frequencies behind the time");
  const bool in_brackets = names[words_of_time] == "Sep_Freq";
  std::vector<std::vector<std::string_view>> rows;
  std::vector<std::string> times;
  std::string_view rest = source.text().substr(static_cast<std::size_t>(names.back().data() - source.text().data()));
  for (next_line(rest); !rest.empty();) {
    const std::string_view line = next_line(rest);
    std::vector<std::string_view> row = words_of(line);
    if (row.empty() || is_comment(line)) continue;
    if (row.size() < words_of_time + 1 || (!in_brackets && row.size() != names.size())) {
      source.fail(row.front(), fmt::format("{} words where the names are {}", row.size(), names.size()));
    }
    std::string digits;
    for (std::size_t i = 0; i < words_of_time; ++i) {
      const std::optional<std::uint64_t> part = parse_natural(row[i]);
      if (!part || *part > 9999)
        source.fail(row[i], fmt::format("value {}: must be a part of a time", in_quotes(row[i])));
      digits += i > 0 ? fmt::format("{:02}", *part) : fmt::format("{:04}", *part < 100 ? 1900 + *part : *part);
    }
    times.push_back(time_digits(digits));
    rows.push_back(std::move(row));
  }
  const std::size_t n = chosen(source, times, time);
  const std::vector<std::string_view>& row = rows[n];
  HertzSpectrum spectrum(source);
  const auto density_of = [&](std::string_view word) {
    const double density = number_of(source, word, "spectral density", 0);
    if (density >= kMissing) source.fail(word, "spectral density: missing in this spectrum");
    return density;
  };
  if (!in_brackets) {
    for (std::size_t i = words_of_time; i < names.size(); ++i)
      spectrum.add(number_of(source, names[i], "frequency", 0), density_of(row[i]), row[i]);
  } else {
    for (std::size_t i = words_of_time + 1; i + 1 < row.size(); i += 2) {
      std::string_view frequency = row[i + 1];
      if (!frequency.starts_with('(') || !frequency.ends_with(')'))
        source.fail(frequency, fmt::format("{}: must be a frequency in brackets", in_quotes(frequency)));
      frequency = frequency.substr(1, frequency.size() - 2);
      spectrum.add(number_of(source, frequency, "frequency", 0), density_of(row[i]), row[i]);
    }
    if ((row.size() - words_of_time) % 2 == 0) source.fail(row.back(), "a density without a frequency");
  }
  return spectrum.take(fmt::format("NDBC, Hz and m^2/Hz, of {}", shown_time(times[n])));
}

// Lines of a spectral file of SWAN, without comments ($).
class SwanLines {
 public:
  explicit SwanLines(const TextSource& source) : source_(source), rest_(source.text()) {}

  bool at_end() {
    skip_comments();
    return rest_.empty();
  }
  // The words of the next line: at least one.
  std::vector<std::string_view> words(const char* what) {
    if (at_end()) source_.fail(rest_, fmt::format("ends where {} should follow", what));
    return words_of(next_line(rest_));
  }
  std::string_view keyword(const char* what) { return words(what).front(); }
  double number(const char* what, double lowest) { return number_of(source_, keyword(what), what, lowest); }
  std::size_t count(const char* what) {
    const std::string_view word = keyword(what);
    const std::optional<std::uint64_t> count = parse_natural(word);
    constexpr std::uint64_t kMost = 100'000;
    if (!count || *count < 1 || *count > kMost)
      source_.fail(word,
                   fmt::format("{}: value {}: must be a whole number within 1 and {}", what, in_quotes(word), kMost));
    return static_cast<std::size_t>(*count);
  }
  // `rows` lines of `columns` numbers each.
  std::vector<std::string_view> table(std::size_t rows, std::size_t columns, const char* what) {
    std::vector<std::string_view> cells;
    for (std::size_t row = 0; row < rows; ++row) {
      const std::vector<std::string_view> line = words(what);
      if (line.size() != columns)
        source_.fail(line.front(), fmt::format("{}: {} numbers: must be {}", what, line.size(), columns));
      cells.insert(cells.end(), line.begin(), line.end());
    }
    return cells;
  }
  // Whether the next line begins with a word, which is then read.
  bool take(std::string_view word) {
    if (at_end() || !words_of(rest_.substr(0, rest_.find('\n'))).front().starts_with(word)) return false;
    next_line(rest_);
    return true;
  }
  const TextSource& source() const { return source_; }

 private:
  void skip_comments() {
    while (!rest_.empty()) {
      const std::string_view line = trimmed(rest_.substr(0, rest_.find('\n')));
      if (!line.empty() && !line.starts_with('$') && !words_of(line).empty()) return;
      next_line(rest_);
    }
  }

  const TextSource& source_;
  std::string_view rest_;
};

// The head of a file of SWAN.
struct SwanHead {
  bool has_times = false;
  std::vector<double> frequencies_hz;
  std::size_t directions = 0;  // 0: a 1-D spectrum
  double direction_step_deg = 1;
  std::size_t quantities = 1, density = 0;  // columns of a 1-D table, and the place of the density
  double in_square_metres = 1;              // of the unit of the density
  double exception = -99;
};

void read_directions(SwanLines& lines, SwanHead& head) {
  head.directions = lines.count("number of directions");
  std::vector<double> directions;
  for (std::size_t i = 0; i < head.directions; ++i) directions.push_back(lines.number("direction", -720));
  if (directions.size() < 2) lines.source().fail(lines.source().text(), "a single direction has no width");
  head.direction_step_deg = std::abs(directions[1] - directions[0]);
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const double step = std::abs(std::remainder(directions[i] - directions[i - 1], 360));
    if (!(std::abs(step - head.direction_step_deg) < 1e-2 * head.direction_step_deg))
      throw InputError(lines.source().name() + ": its directions must have one step");
  }
}

void read_quantities(SwanLines& lines, SwanHead& head) {
  head.quantities = lines.count("number of quantities");
  bool found = false;
  for (std::size_t i = 0; i < head.quantities; ++i) {
    const std::string_view name = lines.keyword("a quantity"), unit = lines.keyword("its unit");
    const double exception = lines.number("exception value", -1e300);
    if (found || !(name == "VaDens" || name == "EnDens")) continue;
    found = true;
    head.density = i;
    head.exception = exception;
    head.in_square_metres = unit.starts_with("J/") ? 1 / (kSeaWaterDensity * kGravity) : 1;
    const std::string_view wanted = head.directions > 0 ? "m2/Hz/degr" : "m2/Hz";
    if (unit != wanted && unit.substr(std::min<std::size_t>(2, unit.size())) != wanted)
      lines.source().fail(unit, fmt::format("unit {}: must be {} or J/{}", in_quotes(unit), wanted, wanted));
  }
  if (!found) throw InputError(lines.source().name() + ": no quantity VaDens or EnDens");
}

SwanHead read_swan_head(SwanLines& lines) {
  SwanHead head;
  lines.words("SWAN");
  if (lines.take("TIME")) {
    head.has_times = true;
    lines.words("time coding option");
  }
  if (lines.take("LOCATIONS") || lines.take("LONLAT")) {
    const std::size_t locations = lines.count("number of locations");
    for (std::size_t i = 0; i < locations; ++i) lines.words("a location");
    if (locations > 1) throw InputError(fmt::format("{}: {} locations: must be 1", lines.source().name(), locations));
  }
  if (!lines.take("AFREQ") && !lines.take("RFREQ"))
    lines.source().fail(lines.keyword("AFREQ"), "must be AFREQ, the frequencies");
  const std::size_t frequencies = lines.count("number of frequencies");
  for (std::size_t i = 0; i < frequencies; ++i) head.frequencies_hz.push_back(lines.number("frequency", 0));
  if (lines.take("NDIR") || lines.take("CDIR")) read_directions(lines, head);
  if (!lines.take("QUANT")) lines.source().fail(lines.keyword("QUANT"), "must be QUANT, the quantities");
  read_quantities(lines, head);
  return head;
}

// One spectrum of a file of SWAN; empty: no data, or none but zeros.
struct SwanCells {
  double factor = 1;
  std::vector<std::string_view> cells;
};

SwanCells read_swan_cells(SwanLines& lines, const SwanHead& head) {
  if (lines.take("NODATA") || lines.take("ZERO")) return {};
  if (head.directions == 0) {
    if (!lines.take("LOCATION")) lines.source().fail(lines.keyword("LOCATION"), "must be LOCATION, a spectrum");
    if (lines.take("NODATA") || lines.take("ZERO")) return {};
    return {1, lines.table(head.frequencies_hz.size(), head.quantities, "a spectrum")};
  }
  if (!lines.take("FACTOR")) lines.source().fail(lines.keyword("FACTOR"), "must be FACTOR, a spectrum");
  const double factor = lines.number("factor", 0);
  return {factor, lines.table(head.frequencies_hz.size(), head.directions, "a spectrum")};
}

SpectrumTable read_swan(const TextSource& source, const std::string& time) {
  SwanLines lines(source);
  const SwanHead head = read_swan_head(lines);
  std::vector<std::string> times;
  std::vector<SwanCells> spectra;
  while (!lines.at_end() && (head.has_times || spectra.empty())) {
    times.push_back(head.has_times ? time_digits(lines.keyword("a time")) : std::string(14, '0'));
    spectra.push_back(read_swan_cells(lines, head));
  }
  if (!head.has_times && !time.empty())
    throw InputError(fmt::format("{}: has no times: sea.table_time is not allowed here", source.name()));
  const std::size_t n = chosen(source, times, time);
  const SwanCells& chosen_cells = spectra[n];
  if (chosen_cells.cells.empty()) throw InputError(fmt::format("{}: no data in this spectrum", source.name()));
  const std::size_t columns = chosen_cells.cells.size() / head.frequencies_hz.size();
  HertzSpectrum spectrum(source);
  for (std::size_t i = 0; i < head.frequencies_hz.size(); ++i) {
    const auto row = std::span(chosen_cells.cells).subspan(i * columns, columns);
    const auto density_of = [&](std::string_view word) {
      const double density = number_of(source, word, "variance density", -1e300);
      if (density == head.exception) source.fail(word, "variance density: the exception value, no data");
      return number_of(source, word, "variance density", 0);
    };
    double density = 0;
    if (head.directions == 0) {
      density = density_of(row[head.density]);
    } else {
      for (const std::string_view word : row) density += density_of(word);
      density *= chosen_cells.factor * head.direction_step_deg;
    }
    spectrum.add(head.frequencies_hz[i], density * head.in_square_metres, row.front());
  }
  return spectrum.take(
      fmt::format("SWAN, Hz and {}{}{}", head.in_square_metres == 1 ? "m^2/Hz" : "J/m^2/Hz over rho g",
                  head.directions > 0 ? fmt::format(", {} directions integrated", head.directions) : "",
                  head.has_times ? ", of " + shown_time(times[n]) : ""));
}

// Whether a key of a column is of a frequency in rad/s; others are in Hz.
bool is_angular(const std::string& key) { return key.ends_with("rad_s") || key == "omega" || key == "w"; }

SpectrumTable spectrum_of(const TextTable& table) {
  constexpr std::size_t kFrequency = 0, kDensity = 1;
  table.check_ascending(kFrequency);
  // Densities per Hz are those per rad/s times 2 pi; S without a unit is over the unit of its frequency.
  const std::string &frequency = table.key(kFrequency), &density = table.key(kDensity);
  const double to_omega = is_angular(frequency) ? 1 : 2 * kPi;
  const bool per_hertz = density.ends_with("m2_hz") || (density == "s" && !is_angular(frequency));
  const double to_density = per_hertz ? 1 / (2 * kPi) : 1;
  SpectrumTable spectrum;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    spectrum.omega.push_back(table.number(row, kFrequency, 0) * to_omega);
    spectrum.density.push_back(table.number(row, kDensity, 0) * to_density);
  }
  if (!(spectrum.energy() > 0)) throw InputError(table.source().name() + ": all densities are 0");
  spectrum.reading = fmt::format("{} in {}, {} in {}", frequency, is_angular(frequency) ? "rad/s" : "Hz", density,
                                 per_hertz ? "m^2/Hz" : "m^2 s/rad");
  return spectrum;
}

std::vector<TableColumn> columns() {
  std::vector<std::string> densities{"density_m2_s", "density_m2_s_rad", "density_m2_hz"};
  for (const char* name : {"s", "s_f", "spectral_density", "energy_density", "variance_density", "spectrum", "psd",
                           "spectral_wave_density", "swden", "vadens"}) {
    for (const char* unit : {"m2_hz", "m2_s_rad", "m2_rad_s"}) densities.push_back(fmt::format("{}_{}", name, unit));
  }
  densities.push_back("s");
  return {TableColumn::one_of({"omega_rad_s", "frequency_hz", "frequency_rad_s", "freq_hz", "freq_rad_s", "f_hz",
                               "w_rad_s", "f", "freq", "omega", "w"}),
          TableColumn(densities)};
}

// The rows of a CSV file of MHKiT, whose second column has the name of a spectrum with its parameters and whose first
// has that of an index: none, or that of a frequency. Nullopt for any other file.
std::optional<TextTable> mhkit_table(const TextSource& source) {
  std::string_view rest = source.text();
  while (!rest.empty() && trimmed(rest.substr(0, rest.find('\n'))).empty()) next_line(rest);
  const TextRow names = next_row(rest, ',');
  if (!names.open_quote.empty() || names.cells.size() != 2) return std::nullopt;
  const std::string index = column_key(names.cells[0]), spectrum = column_key(names.cells[1]);
  const bool is_index = index.empty() || index == "f" || index == "freq" || index == "frequency" || index == "index" ||
                        index == "frequency_hz";
  const bool is_spectrum =
      std::ranges::any_of(std::initializer_list<const char*>{"jonswap_", "pierson_moskowitz", "bretschneider_"},
                          [&](const char* name) { return spectrum.starts_with(name); });
  if (!is_index || !is_spectrum) return std::nullopt;
  return TextTable::below(source, rest, {"frequency_hz", "density_m2_hz"}, ',');
}

}  // namespace

SpectrumTable read_spectrum_table(const TextSource& source, const std::string& time) {
  std::string_view rest = source.text();
  while (!rest.empty() && trimmed(rest.substr(0, rest.find('\n'))).empty()) next_line(rest);
  if (rest.starts_with("SWAN ")) return read_swan(source, time);
  if (const auto names = ndbc_names(source)) return read_ndbc(source, *names, time);
  if (!time.empty())
    throw InputError(fmt::format("{}: has no times: sea.table_time is not allowed here", source.name()));
  if (const std::optional<TextTable> table = mhkit_table(source); table && table->rows() > 1) {
    SpectrumTable spectrum = spectrum_of(*table);
    spectrum.reading = "MHKiT, Hz and m^2/Hz";
    return spectrum;
  }
  return spectrum_of(TextTable(source, columns()));
}

}  // namespace seaglint
