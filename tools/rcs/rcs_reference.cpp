// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "tools/rcs/transmitter_keys.h"

namespace seaglint {
namespace {

constexpr double kMinLevel_dbsm = -1000;  // of an exact zero

Complex amplitude_of(double level_dbsm, double phase_rad) {
  return std::polar(std::sqrt(std::pow(10.0, level_dbsm / 10) / (4 * kPi)), phase_rad);
}

// Maps a direction to theta 0..180, phi 0..360; true if theta was below 0 or above 180, on the other half of the great
// circle.
bool fold(double& theta_deg, double& phi_deg) {
  theta_deg = std::remainder(theta_deg, 360);
  const bool negative = theta_deg < 0;
  if (negative) {
    theta_deg = -theta_deg;
    phi_deg += 180;
  }
  phi_deg = std::fmod(phi_deg, 360);
  if (phi_deg < 0) phi_deg += 360;
  return negative;
}

// Reads a text by lines and counts them.
class Lines {
 public:
  Lines(const std::string& text, std::string file) : stream_(text), file_(std::move(file)) {}

  bool next(std::string& line) {
    if (!std::getline(stream_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    ++number_;
    return true;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", file_, number_, why));
  }
  const std::string& file() const { return file_; }

 private:
  std::istringstream stream_;
  std::string file_;
  std::size_t number_ = 0;
};

std::vector<std::string> split_at(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, separator);) cells.push_back(cell);
  return cells;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string squeezed(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += c;
  }
  return out;
}

double number_in(const Lines& lines, const std::string& cell) {
  const std::optional<double> value = parse_number(cell);
  if (!value) lines.fail(fmt::format("'{}': must be a number", cell));
  return *value;
}

// Parses a level in dB; the logarithm of an exact zero becomes kMinLevel_dbsm.
double level_in(const Lines& lines, const std::string& cell) {
  return cell == "-inf" || cell == "-Inf" || cell == "-INF" ? kMinLevel_dbsm : number_in(lines, cell);
}

bool is_blank(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos; }

bool transmits_v(Polarisation element) { return element == Polarisation::kHv || element == Polarisation::kVv; }
bool receives_v(Polarisation element) { return element == Polarisation::kVh || element == Polarisation::kVv; }

// Frequency in Hz, theta, phi, dBsm.
void read_four_columns(Lines& lines, RcsReference& reference) {
  for (std::string line; lines.next(line);) {
    if (is_blank(line) || line.front() == '#') continue;
    const std::vector<std::string> words = words_of(line);
    if (words.size() != 4)
      lines.fail(fmt::format("{} columns: must be 4 (frequency_hz theta_deg phi_deg dBsm)", words.size()));
    ReferenceSample sample{number_in(lines, words[0]),
                           number_in(lines, words[1]),
                           number_in(lines, words[2]),
                           level_in(lines, words[3]),
                           {}};
    if (sample.frequency_hz <= 0) lines.fail(fmt::format("frequency {} Hz: must be > 0", words[0]));
    fold(sample.theta_deg, sample.phi_deg);
    reference.samples.push_back(sample);
  }
}

// Transmitter that a head line of a `seaglint rcs` table states; empty if it states none.
std::optional<DeclaredTransmitter> stated_transmitter(const Lines& lines, const std::string& line) {
  try {
    const std::optional<TransmitterKeys> keys = read_transmitter_line(line);
    if (!keys) return std::nullopt;
    if (!keys->fixed) return DeclaredTransmitter{};
    DeclaredTransmitter transmitter{false, 90 - keys->fixed->elevation_deg, keys->fixed->azimuth_deg};
    fold(transmitter.theta_deg, transmitter.phi_deg);
    return transmitter;
  } catch (const InputError& error) {
    lines.fail(error.what());
  }
}

// Throws InputError for a table whose head was written by `seaglint rcs`, but states no transmitter.
void require_transmitter(const RcsReference& reference, const std::string& text, const std::string& file) {
  if (reference.transmitter || !text.starts_with("# seaglint ")) return;
  throw InputError(
      fmt::format("{}: its head does not state the transmitter: add the line '{}', or '{}' with its angles, or make "
                  "the table again",
                  file, transmitter_line({}), transmitter_line(FixedTransmitter{})));
}

// The table of `seaglint rcs`.
void read_own_table(Lines& lines, RcsReference& reference) {
  const std::string element = kPolarisationNames[static_cast<int>(reference.element)];
  std::vector<std::string> names;
  int frequency = -1, azimuth = -1, elevation = -1, re = -1, im = -1, level = -1;
  for (std::string line; lines.next(line);) {
    if (!reference.transmitter) reference.transmitter = stated_transmitter(lines, line);
    if (is_blank(line) || line.front() == '#') continue;
    if (names.empty()) {
      names = split_at(line, ',');
      const auto column = [&](const std::string& name) {
        const auto place = std::find(names.begin(), names.end(), name);
        return place == names.end() ? -1 : static_cast<int>(place - names.begin());
      };
      frequency = column("frequency_hz"), azimuth = column("azimuth_deg"), elevation = column("elevation_deg");
      re = column(element + "_re"), im = column(element + "_im"), level = column(element + "_dbsm");
      if (frequency < 0 || azimuth < 0 || elevation < 0)
        lines.fail("no columns frequency_hz, azimuth_deg, elevation_deg");
      if ((re < 0 || im < 0) && level < 0)
        lines.fail(fmt::format("neither columns {0}_re and {0}_im nor {0}_dbsm", element));
      continue;
    }
    const std::vector<std::string> cells = split_at(line, ',');
    if (cells.size() != names.size())
      lines.fail(fmt::format("{} columns: the header has {}", cells.size(), names.size()));
    const auto at = [&](int column) { return number_in(lines, cells[static_cast<std::size_t>(column)]); };
    ReferenceSample sample;
    sample.frequency_hz = at(frequency);
    sample.theta_deg = 90 - at(elevation);
    sample.phi_deg = at(azimuth);
    fold(sample.theta_deg, sample.phi_deg);
    if (re >= 0 && im >= 0) {
      sample.amplitude_m = Complex(at(re), at(im));
      sample.level_dbsm = dbsm(*sample.amplitude_m);
    } else {
      sample.level_dbsm = level_in(lines, cells[static_cast<std::size_t>(level)]);
    }
    reference.samples.push_back(sample);
  }
}

struct CstColumn {
  std::string name, unit;  // without spaces
};

// `Theta [deg.] Phi [deg.] Abs(RCS )[dB(m^2)] ...`: names and units contain padding, so that only brackets separate
// them.
std::vector<CstColumn> cst_columns(const Lines& lines, const std::string& header) {
  std::vector<CstColumn> columns;
  for (std::size_t at = 0;;) {
    const std::size_t open = header.find('[', at);
    if (open == std::string::npos) return columns;
    const std::size_t close = header.find(']', open);
    if (close == std::string::npos) lines.fail("a unit's bracket is not closed");
    columns.push_back({squeezed(header.substr(at, open - at)), squeezed(header.substr(open + 1, close - open - 1))});
    at = close + 1;
  }
}

// Level in dBsm of a value in the column's unit.
class CstUnit {
 public:
  CstUnit(const Lines& lines, const CstColumn& column, double wavelength_m) {
    std::string unit = column.unit;
    decibel_ = unit.starts_with("dB");
    if (unit == "dB") {
      lines.fail(fmt::format("column {} [dB] is relative to its own maximum: export absolute values, m^2 or dB(m^2)",
                             column.name));
    }
    if (unit == "dBsm") unit = "dB(m^2)";
    if (decibel_) unit = unit.size() > 4 && unit[2] == '(' ? unit.substr(3, unit.size() - 4) : unit.substr(2);
    if (unit == "m^2") {
      offset_db_ = 0;
    } else if (unit == "mm^2") {
      offset_db_ = -60;
    } else if (unit == "cm^2") {
      offset_db_ = -40;
    } else if (unit == "lambda^2") {
      offset_db_ = 20 * std::log10(wavelength_m);
    } else {
      lines.fail(fmt::format("column {} [{}]: the unit must be m^2, cm^2, mm^2, lambda^2, or dB() of one of them",
                             column.name, column.unit));
    }
  }
  double level(const Lines& lines, double value) const {
    if (decibel_) return value + offset_db_;
    if (value < 0) lines.fail(fmt::format("{}: an area must be >= 0", value));
    return std::max(10 * std::log10(std::max(value, 1e-300)) + offset_db_, kMinLevel_dbsm);
  }

 private:
  bool decibel_ = false;
  double offset_db_ = 0;
};

void read_cst_table(Lines& lines, RcsReference& reference) {
  std::string line;
  lines.next(line);
  const std::vector<CstColumn> columns = cst_columns(lines, line);
  if (!reference.settings.frequency_hz)
    lines.fail("a CST table does not say its frequency: give --reference-frequency-ghz");
  const double frequency_hz = *reference.settings.frequency_hz;
  const auto column = [&](const std::string& name) {
    const auto place = std::find_if(columns.begin(), columns.end(), [&](const CstColumn& c) { return c.name == name; });
    return place == columns.end() ? -1 : static_cast<int>(place - columns.begin());
  };
  const std::string component = receives_v(reference.element) ? "Theta" : "Phi";
  const int theta = column("Theta"), phi = column("Phi"), magnitude = column("Abs(" + component + ")"),
            phase = column("Phase(" + component + ")");
  for (const int needed : {theta, phi}) {
    if (needed < 0) lines.fail("no columns Theta[deg.] and Phi[deg.]");
    const std::string& unit = columns[static_cast<std::size_t>(needed)].unit;
    if (!unit.starts_with("deg")) lines.fail(fmt::format("angles in [{}]: must be degrees", unit));
  }
  if (magnitude < 0)
    lines.fail(fmt::format("no column Abs({}), which {} needs", component,
                           kPolarisationNames[static_cast<int>(reference.element)]));
  const CstUnit unit(lines, columns[static_cast<std::size_t>(magnitude)], kSpeedOfLight / frequency_hz);
  if (phase >= 0 && !columns[static_cast<std::size_t>(phase)].unit.starts_with("deg"))
    lines.fail("phases must be in degrees");

  while (lines.next(line)) {
    if (is_blank(line) || line.find_first_not_of("-= \t") == std::string::npos) continue;
    std::replace(line.begin(), line.end(), ',', '.');  // decimal commas of localised systems
    const std::vector<std::string> words = words_of(line);
    if (words.size() != columns.size())
      lines.fail(fmt::format("{} columns: the header has {}", words.size(), columns.size()));
    const auto at = [&](int c) { return number_in(lines, words[static_cast<std::size_t>(c)]); };
    ReferenceSample sample;
    sample.frequency_hz = frequency_hz;
    sample.theta_deg = at(theta);
    sample.phi_deg = at(phi);
    const bool folded = fold(sample.theta_deg, sample.phi_deg);
    sample.level_dbsm = unit.level(lines, level_in(lines, words[static_cast<std::size_t>(magnitude)]));
    if (phase >= 0) {
      const bool cross = transmits_v(reference.element) != receives_v(reference.element);
      sample.amplitude_m =
          amplitude_of(sample.level_dbsm, radians(at(phase))) * (folded ? -1.0 : 1.0) * (cross ? -1.0 : 1.0);
    }
    reference.samples.push_back(sample);
  }
}

enum class Format { kFourColumns, kOwnTable, kCstTable };

Format format_of(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (is_blank(line) || line == "\r" || line.front() == '#') continue;
    if (line.starts_with("// CST Farfield Source"))
      throw InputError(
          fmt::format("{}: a CST farfield source (.ffs) is not read: export the RCS as an ASCII table", file));
    if (line.find("Theta") != std::string::npos && line.find('[') != std::string::npos) return Format::kCstTable;
    if (line.starts_with("frequency_hz,")) return Format::kOwnTable;
    const std::vector<std::string> words = words_of(line);
    if (words.size() == 4 &&
        std::all_of(words.begin(), words.end() - 1, [](const std::string& w) { return parse_number(w).has_value(); }))
      return Format::kFourColumns;
    break;
  }
  throw InputError(
      fmt::format("{}: not a cut of the radar cross section: neither four columns (frequency_hz theta_deg phi_deg "
                  "dBsm), nor a table of seaglint "
                  "rcs, nor a CST farfield table",
                  file));
}

Polarisation polarisation_of(const std::string& name, const ReferenceSettings& settings) {
  if (settings.element) return *settings.element;
  if (name.find(".H.") != std::string::npos) return Polarisation::kHh;
  if (name.find(".V.") != std::string::npos) return Polarisation::kVv;
  throw InputError(fmt::format("{}: its name does not say the polarisation: give --reference-polarisation", name));
}

// Throws InputError if a frequency is given that differs from the file's.
void require_own_frequency(const RcsReference& reference, const std::string& file) {
  if (!reference.settings.frequency_hz) return;
  constexpr double kTolerance = 1e-6;
  for (const ReferenceSample& sample : reference.samples) {
    if (std::abs(sample.frequency_hz - *reference.settings.frequency_hz) <= kTolerance * sample.frequency_hz) continue;
    throw InputError(fmt::format("{}: declares {:g} GHz: remove --reference-frequency-ghz {:g}", file,
                                 sample.frequency_hz * 1e-9, *reference.settings.frequency_hz * 1e-9));
  }
}

}  // namespace

RcsReference read_reference(const std::filesystem::path& file, const ReferenceSettings& settings) {
  RcsReference reference;
  const std::string text = read_file(file);
  const Format format = format_of(text, file.string());
  reference.name = file.filename().string();
  reference.settings = settings;
  reference.element = polarisation_of(reference.name, settings);
  Lines lines(text, file.string());
  switch (format) {
    case Format::kFourColumns: read_four_columns(lines, reference); break;
    case Format::kOwnTable:
      read_own_table(lines, reference);
      require_transmitter(reference, text, file.string());
      break;
    case Format::kCstTable: read_cst_table(lines, reference); break;
  }
  if (reference.samples.empty()) throw InputError(fmt::format("{}: contains no values", file.string()));
  require_own_frequency(reference, file.string());
  return reference;
}

}  // namespace seaglint
