// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_text.h"

namespace seaglint {
namespace {

constexpr const char* kKindKey = "transmitter";
constexpr const char* kMonostaticWord = "monostatic";
constexpr const char* kAzimuthKey = "transmitter_azimuth_deg";
constexpr const char* kElevationKey = "transmitter_elevation_deg";

double angle_deg(const std::map<std::string, std::string>& keys, const char* name) {
  const auto place = keys.find(name);
  if (place == keys.end()) throw InputError(fmt::format("the key {} is missing", name));
  const std::optional<double> value = parse_number(place->second);
  if (!value) throw InputError(fmt::format("{}={}: must be a number", name, place->second));
  return *value;
}

// The transmitter that a line of a table states; empty if its first word is no key of the transmitter. Throws
// InputError naming a key that is missing, unknown or has an invalid value.
std::optional<DeclaredTransmitter> transmitter_in(std::string_view line) {
  if (!line.starts_with("# ")) return std::nullopt;
  std::map<std::string, std::string> keys;
  for (const std::string_view word : words_of(line.substr(2))) {
    const std::size_t equals = word.find('=');
    const std::string name(word.substr(0, equals));
    if (equals == std::string_view::npos || (name != kKindKey && name != kAzimuthKey && name != kElevationKey)) {
      if (keys.empty()) return std::nullopt;
      throw InputError(fmt::format("{}: no key of the transmitter", in_quotes(word)));
    }
    if (!keys.emplace(name, word.substr(equals + 1)).second)
      throw InputError(fmt::format("the key {} appears twice", name));
  }
  if (keys.empty()) return std::nullopt;
  const auto kind = keys.find(kKindKey);
  if (kind == keys.end()) {
    const double azimuth_deg = angle_deg(keys, kAzimuthKey);
    DeclaredTransmitter transmitter{false, 90 - angle_deg(keys, kElevationKey), azimuth_deg};
    fold_direction(transmitter.theta_deg, transmitter.phi_deg);
    return transmitter;
  }
  if (kind->second != kMonostaticWord || keys.size() > 1)
    throw InputError(fmt::format("{}: must be {}={} or {}=A {}=B", line.substr(2), kKindKey, kMonostaticWord,
                                 kAzimuthKey, kElevationKey));
  return DeclaredTransmitter{};
}

// Transmitter that a comment of the table states; empty if none does.
std::optional<DeclaredTransmitter> stated_transmitter(const TextSource& source) {
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
    try {
      if (const auto transmitter = transmitter_in(line)) return transmitter;
    } catch (const InputError& error) {
      source.fail(line, error.what());
    }
  }
  return std::nullopt;
}

// Throws InputError for a table whose head was written by `seaglint rcs`, but states no transmitter.
void require_transmitter(const std::optional<DeclaredTransmitter>& transmitter, const TextSource& source) {
  if (transmitter || !source.text().starts_with("# seaglint ")) return;
  throw InputError(
      fmt::format("{}: its head does not state the transmitter: add the line '{}', or '{}' with its angles, or make "
                  "the table again",
                  source.name(), transmitter_line({}), transmitter_line(FixedTransmitter{})));
}

// Columns of the request: frequency, azimuth, elevation, then three for each element.
constexpr std::size_t kAngles = 3;

std::vector<TableColumn> columns_of_all() {
  std::vector<TableColumn> columns{"frequency_hz", "azimuth_deg", "elevation_deg"};
  for (const char* element : kPolarisationNames) {
    for (const char* part : {"_re", "_im", "_dbsm"})
      columns.emplace_back(std::vector{std::string(element) + part}, false);
  }
  return columns;
}

struct ElementColumns {
  std::size_t re, im, level;
  explicit ElementColumns(Polarisation element)
      : re(kAngles + 3 * static_cast<std::size_t>(element)), im(re + 1), level(re + 2) {}
};

}  // namespace

std::string transmitter_line(const std::optional<FixedTransmitter>& transmitter) {
  if (!transmitter) return fmt::format("# {}={}", kKindKey, kMonostaticWord);
  return fmt::format("# {}={:.9g} {}={:.9g}", kAzimuthKey, transmitter->azimuth_deg, kElevationKey,
                     transmitter->elevation_deg);
}

bool is_own_table(const TextSource& source) {
  const bool has_head = source.text().starts_with("# seaglint ");
  return any_first_row(source, [&](const FirstRow& row) {
    const bool azimuth = row.has("azimuth_deg"), elevation = row.has("elevation_deg");
    const bool phases = std::any_of(row.keys.begin(), row.keys.end(),
                                    [](const std::string& key) { return key.find("phase") != std::string::npos; });
    return row.has("frequency_hz") && (has_head ? azimuth || elevation : azimuth && elevation && !phases);
  });
}

void read_own_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  table.notes.emplace_back("e^{+jwt}, h and v of CONVENTIONS.md");
  std::optional<DeclaredTransmitter> transmitter = stated_transmitter(source);
  require_transmitter(transmitter, source);
  if (!transmitter) transmitter = settings.transmitter;
  const TextTable rows(source, columns_of_all(), 0);
  std::vector<Polarisation> elements = settings.elements;
  const auto is_complex = [&](Polarisation element) {
    const ElementColumns columns(element);
    return rows.has(columns.re) && rows.has(columns.im);
  };
  if (elements.empty()) {
    for (const Polarisation element : {Polarisation::kHh, Polarisation::kHv, Polarisation::kVh, Polarisation::kVv}) {
      if (is_complex(element) || rows.has(ElementColumns(element).level)) elements.push_back(element);
    }
    if (elements.empty()) throw InputError(fmt::format("{}: no column of amplitudes or levels", source.name()));
  }
  for (const Polarisation element : elements) {
    const ElementColumns columns(element);
    const bool complex = is_complex(element);
    if (!complex && !rows.has(columns.level)) {
      const char* name = kPolarisationNames[static_cast<int>(element)];
      throw InputError(fmt::format("{0}: neither columns {1}_re and {1}_im nor {1}_dbsm", source.name(), name));
    }
    RcsCut& cut = cut_for(table, quantity_of(element, false), transmitter);
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      FieldValue value{rows.positive(row, 0), 90 - rows.number(row, 2), rows.number(row, 1), 0, {}, rows.line(row)};
      fold_direction(value.theta_deg, value.phi_deg);
      if (complex) value.amplitude_m = Complex(rows.number(row, columns.re), rows.number(row, columns.im));
      value.level_dbsm = complex ? std::max(dbsm(*value.amplitude_m), kMinLevel_dbsm)
                                 : std::max(rows.level(row, columns.level), kMinLevel_dbsm);
      cut.values.push_back(value);
    }
  }
}

namespace {

using Names = std::span<const char* const>;

// Names of the quantities without units, as column_key() spells them.
constexpr const char* kAzimuth[] = {"azimuth", "az",       "azimuth_angle", "aspect", "aspect_angle",
                                    "angle",   "rotation", "turntable",     "phi"};
constexpr const char* kElevation[] = {"elevation", "el", "elevation_angle"};
constexpr const char* kTheta[] = {"theta"};
constexpr const char* kFrequency[] = {"frequency", "freq", "f"};
constexpr const char* kAngleUnits[] = {"deg", "rad"};
constexpr const char* kFrequencyUnits[] = {"hz", "khz", "mhz", "ghz", "thz"};
constexpr const char* kLevelUnits[] = {"dbsm", "dbm2", "db_m2", "dbsqm", "m2", "cm2", "mm2"};
// Words beside the element, before or behind it.
constexpr const char* kLevelWords[] = {"rcs", "sigma", "level", "amplitude", "amp", "magnitude", "mag", "power", "pol"};
constexpr const char* kPhaseWords[] = {"phase", "phase_angle", "ang", "arg", "rcs_phase", "pol_phase"};

std::string with_unit(const std::string& name, const char* unit) { return name.empty() ? unit : name + "_" + unit; }

// Every name with every unit.
std::vector<std::string> keys_of(const std::vector<std::string>& names, Names units) {
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    for (const char* unit : units) keys.push_back(with_unit(name, unit));
  }
  return keys;
}

std::vector<std::string> texts(Names names) { return {names.begin(), names.end()}; }

// Names of a quantity of an element, `hh`, `rcs_hh`, `hh_rcs`; of no element, `""`, `rcs`.
std::vector<std::string> names_of(const std::string& element, Names words) {
  std::vector<std::string> names{element};
  for (const std::string word : words) {
    names.push_back(element.empty() ? word : word + "_" + element);
    if (!element.empty()) names.push_back(element + "_" + word);
  }
  return names;
}

// Columns of the request: azimuth, elevation, theta, frequency, then level and phase of each element and of none.
constexpr std::size_t kAzimuthColumn = 0, kElevationColumn = 1, kThetaColumn = 2, kFrequencyColumn = 3, kFirst = 4;
constexpr std::array<const char*, 5> kElements{"hh", "hv", "vh", "vv", ""};
constexpr std::size_t kNoElement = 4;
constexpr std::size_t level_column(std::size_t element) { return kFirst + 2 * element; }
constexpr std::size_t phase_column(std::size_t element) { return level_column(element) + 1; }

std::vector<TableColumn> named_columns() {
  std::vector<TableColumn> columns{TableColumn(keys_of(texts(kAzimuth), kAngleUnits)),
                                   TableColumn(keys_of(texts(kElevation), kAngleUnits), false),
                                   TableColumn(keys_of(texts(kTheta), kAngleUnits), false),
                                   TableColumn(keys_of(texts(kFrequency), kFrequencyUnits), false)};
  for (const std::string element : kElements) {
    std::vector<std::string> phases = names_of(element, kPhaseWords);
    if (element.empty()) phases.erase(phases.begin());  // an angle
    columns.emplace_back(keys_of(names_of(element, kLevelWords), kLevelUnits), false);
    columns.emplace_back(keys_of(phases, kAngleUnits), false);
  }
  return columns;
}

bool has_part(const std::string& key, const std::string& part) {
  return ("_" + key + "_").find("_" + part + "_") != std::string::npos;
}

bool begins_with_one_of(const std::string& key, Names names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string name) { return key == name || key.starts_with(name + "_"); });
}

// Throws InputError for a column of a quantity that was not read, because its unit is missing or another one.
void require_units(const TextTable& rows) {
  const auto check = [&](const std::string& name, bool is_quantity, std::size_t column, const std::string& units) {
    if (is_quantity && !rows.has(column))
      throw InputError(fmt::format("{}: column {}: its unit must be {}", rows.source().name(), in_quotes(name), units));
  };
  for (const std::string& name : rows.names()) {
    const std::string key = column_key(name);
    check(name, begins_with_one_of(key, kElevation), kElevationColumn, "deg or rad");
    check(name, begins_with_one_of(key, kTheta), kThetaColumn, "deg or rad");
    check(name, begins_with_one_of(key, kFrequency), kFrequencyColumn, "Hz, kHz, MHz or GHz");
    for (std::size_t element = 0; element < kNoElement; ++element) {
      if (!has_part(key, kElements[element])) continue;
      const bool is_phase = has_part(key, "phase");
      check(name, is_phase, phase_column(element), "deg or rad");
      check(name, !is_phase, level_column(element), "dBsm or m^2");
    }
  }
}

// Throws InputError unless exactly one element is wanted.
Polarisation only_element(const std::string& file, const FieldTableSettings& settings) {
  if (settings.elements.size() == 1) return settings.elements[0];
  throw InputError(
      fmt::format("{}: its name does not say the polarisation: give --reference-polarisation hh, hv, vh or vv", file));
}

double degrees_of(const TextTable& rows, std::size_t row, std::size_t column) {
  const double angle = rows.number(row, column);
  return rows.key(column).ends_with("_rad") ? degrees(angle) : angle;
}

double level_of(const TextTable& rows, std::size_t row, std::size_t column) {
  const std::string& key = rows.key(column);
  const auto is = [&](const char* unit) { return key == unit || key.ends_with(std::string("_") + unit); };
  if (is("m2") && !is("db_m2")) return dbsm_of_area(rows.number(row, column, 0));
  if (is("cm2")) return dbsm_of_area(1e-4 * rows.number(row, column, 0));
  if (is("mm2")) return dbsm_of_area(1e-6 * rows.number(row, column, 0));
  return std::max(rows.level(row, column), kMinLevel_dbsm);
}

// Reads the rows of a table with named columns.
class NamedTable {
 public:
  NamedTable(const TextSource& source, const FieldTableSettings& settings)
      : rows_(source, named_columns(), 0), settings_(settings) {
    require_units(rows_);
    if (!rows_.has(kFrequencyColumn) && !settings.frequency_hz) {
      throw InputError(fmt::format(
          "{}: no column of the frequency, nor does its name say it: give --reference-frequency-ghz", source.name()));
    }
    for (std::size_t element = 0; element < kNoElement; ++element) {
      if (rows_.has(level_column(element))) elements_.push_back(element);
    }
    if (!elements_.empty()) {
      choose_wanted();
    } else if (rows_.has(level_column(kNoElement))) {
      only_element(source.name(), settings);
      elements_ = {kNoElement};
    } else {
      throw InputError(
          fmt::format("{}: no column of levels: must be named dBsm, or HH, HV, VH, VV with the unit dBsm "
                      "or m^2",
                      source.name()));
    }
  }

  // By azimuth, not by theta and phi.
  bool is_by_azimuth() const { return !rows_.key(kAzimuthColumn).starts_with("phi") || !rows_.has(kThetaColumn); }
  bool has_elevations() const { return rows_.has(kElevationColumn) || rows_.has(kThetaColumn); }

  std::vector<RcsCut> cuts() const {
    std::vector<RcsCut> cuts;
    for (const std::size_t element : elements_) {
      RcsCut& cut = cuts.emplace_back();
      cut.element = element == kNoElement ? settings_.elements[0] : static_cast<Polarisation>(element);
      cut.transmitter = settings_.transmitter;
      if (!cut.transmitter && is_by_azimuth()) cut.transmitter.emplace();
      for (std::size_t row = 0; row < rows_.rows(); ++row) cut.values.push_back(value(row, element));
    }
    return cuts;
  }

 private:
  void choose_wanted() {
    if (settings_.elements.empty()) return;
    std::erase_if(elements_, [&](std::size_t element) {
      return std::find(settings_.elements.begin(), settings_.elements.end(), static_cast<Polarisation>(element)) ==
             settings_.elements.end();
    });
    if (elements_.empty()) {
      throw InputError(fmt::format("{}: no column of {}", rows_.source().name(),
                                   kPolarisationNames[static_cast<int>(settings_.elements[0])]));
    }
  }

  FieldValue value(std::size_t row, std::size_t element) const {
    FieldValue value{frequency_hz(row), theta_deg(row), degrees_of(rows_, row, kAzimuthColumn), 0, {}, rows_.line(row)};
    value.level_dbsm = level_of(rows_, row, level_column(element));
    fold_direction(value.theta_deg, value.phi_deg);
    if (rows_.has(phase_column(element))) {
      value.amplitude_m =
          std::polar(amplitude_of_dbsm(value.level_dbsm), radians(degrees_of(rows_, row, phase_column(element))));
    }
    return value;
  }
  double frequency_hz(std::size_t row) const {
    if (!rows_.has(kFrequencyColumn)) return *settings_.frequency_hz;
    const std::string& key = rows_.key(kFrequencyColumn);
    const double unit_hz = frequency_unit_hz(std::string_view(key).substr(key.rfind('_') + 1)).value_or(1);
    return rows_.positive(row, kFrequencyColumn) * unit_hz;
  }
  double theta_deg(std::size_t row) const {
    if (rows_.has(kThetaColumn)) return degrees_of(rows_, row, kThetaColumn);
    if (rows_.has(kElevationColumn)) return 90 - degrees_of(rows_, row, kElevationColumn);
    return 90 - settings_.elevation_deg.value_or(0);
  }

  TextTable rows_;
  const FieldTableSettings& settings_;
  std::vector<std::size_t> elements_;  // of kElements
};

bool is_azimuth(const std::string& key, bool with_unit) {
  return std::any_of(std::begin(kAzimuth), std::end(kAzimuth), [&](const std::string name) {
    return key == name + "_deg" || key == name + "_rad" || (key == name && !with_unit);
  });
}

bool is_level(const std::string& key, bool with_unit) {
  if (with_unit)
    return std::any_of(std::begin(kLevelUnits), std::end(kLevelUnits),
                       [&](const std::string unit) { return key == unit || key.ends_with("_" + unit); });
  return std::any_of(kElements.begin(), kElements.end() - 1,
                     [&](const char* element) { return has_part(key, element); }) ||
         has_part(key, "rcs");
}

// Names of columns with their units.
bool is_names(const FirstRow& row) {
  const auto any = [&](auto is) {
    return std::any_of(row.keys.begin(), row.keys.end(), [&](const std::string& key) { return is(key, true); });
  };
  return (row.has("theta_deg") && row.has("phi_deg")) || (any(is_azimuth) && any(is_level));
}

// Names, some of them without a unit, of as many columns as a row of numbers has: other lines are sentences.
bool is_names_above_numbers(const FirstRow& row, const std::vector<FirstRow>& rows) {
  const auto any = [&](auto is) {
    return std::any_of(row.keys.begin(), row.keys.end(), [&](const std::string& key) { return is(key, false); });
  };
  const auto is_row_of_it = [&](const FirstRow& other) {
    return other.cells.size() == row.cells.size() && parse_written_number(other.cells[0]).has_value();
  };
  return any(is_azimuth) &&
         (any(is_level) ||
          std::any_of(row.keys.begin(), row.keys.end(), [](const std::string& key) { return is_level(key, true); })) &&
         std::any_of(rows.begin(), rows.end(), is_row_of_it);
}

}  // namespace

bool is_four_columns(const TextSource& source) {
  return any_first_row(source, [](const FirstRow& row) {
    return row.cells.size() >= 3 && row.cells.size() <= 5 && parse_number(row.cells[0]).has_value();
  });
}

bool has_four_columns(const TextSource& source) {
  return any_first_row(source, [](const FirstRow& row) {
    return row.cells.size() == 4 && std::all_of(row.cells.begin(), row.cells.end(), [](std::string_view cell) {
             return parse_written_number(cell).has_value();
           });
  });
}

bool is_named_table(const TextSource& source) {
  const std::vector<FirstRow> rows = first_rows(source), comments = first_rows(source, true);
  return std::any_of(rows.begin(), rows.end(),
                     [&](const FirstRow& row) { return is_names(row) || is_names_above_numbers(row, rows); }) ||
         std::any_of(comments.begin(), comments.end(), is_names);
}

void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  const TextTable rows = TextTable::without_names(source, {"frequency_hz", "theta_deg", "phi_deg", "dbsm"});
  RcsCut& cut = cut_for(table, quantity_of(only_element(source.name(), settings), false), settings.transmitter);
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    cut.values.push_back(level_value(rows.positive(row, 0), rows.number(row, 1), rows.number(row, 2),
                                     std::max(rows.level(row, 3), kMinLevel_dbsm), rows.line(row)));
  }
}

void read_named_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  const NamedTable named(source, settings);
  table.cuts = named.cuts();
  if (named.is_by_azimuth()) {
    table.notes.emplace_back("h and v of CONVENTIONS.md, received and transmitted");
    if (!settings.transmitter) table.notes.emplace_back("monostatic, as no --incidence is given");
  }
  if (!named.has_elevations()) {
    table.notes.push_back(settings.elevation_deg
                              ? fmt::format("elevation {:g} deg as given", *settings.elevation_deg)
                              : std::string("elevation 0 deg, as the file states none and no --reference-elevation-deg "
                                            "is given"));
  }
}

}  // namespace seaglint
