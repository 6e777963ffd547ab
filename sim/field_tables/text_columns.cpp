// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/text_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/column_key.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/text_table.h"
#include "sim/field_tables/rows/first_rows.h"

namespace seaglint {
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
    const double unit_hz = key.ends_with("_thz")   ? 1e12
                           : key.ends_with("_ghz") ? 1e9
                           : key.ends_with("_mhz") ? 1e6
                           : key.ends_with("_khz") ? 1e3
                                                   : 1;
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
  RcsCut cut;
  cut.element = only_element(source.name(), settings);
  cut.transmitter = settings.transmitter;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    FieldValue value{rows.positive(row, 0),
                     rows.number(row, 1),
                     rows.number(row, 2),
                     std::max(rows.level(row, 3), kMinLevel_dbsm),
                     {},
                     rows.line(row)};
    fold_direction(value.theta_deg, value.phi_deg);
    cut.values.push_back(value);
  }
  table.cuts.push_back(std::move(cut));
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
