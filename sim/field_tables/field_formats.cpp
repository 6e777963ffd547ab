// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/process/error.h"
#include "sim/field_tables/export_text.h"

namespace seaglint {
namespace {

struct Reader {
  const char* name;
  const char* missing;  // from a file that is not of this format
  bool (*is_format)(const TextSource& source);
  void (*read)(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);
};

constexpr std::array<Reader, 8> kReaders{{
    {"a CST farfield source", "no first line '// CST Farfield Source File'", is_cst_source, read_cst_source},
    {"a FEKO far field", "no first line '##File Type: Far field'", is_feko_table, read_feko_table},
    {"a CST farfield table", "no line of names 'Theta [deg.] Phi [deg.] Abs(Theta)[...] ...'", is_cst_table,
     read_cst_table},
    {"CST curves", "no line of names '\"Frequency / GHz\" ...' above a rule", is_cst_curves, read_cst_curves},
    {"an HFSS table", "no columns IWavePhi, IWaveTheta and MonostaticRCS, nor BistaticRCS", is_hfss_table,
     read_hfss_table},
    {"a table of seaglint rcs", "no columns frequency_hz and azimuth_deg", is_own_table, read_own_table},
    {"a table of named columns", "no names of columns of an azimuth, or of theta_deg and phi_deg, with levels",
     is_named_table, read_named_table},
    {"four columns", "no rows of frequency_hz theta_deg phi_deg dBsm", is_four_columns, read_four_columns},
}};

constexpr const char* kPyaedt = "an export of PyAEDT";

const Reader* find_reader(const TextSource& source) {
  const auto reader =
      std::find_if(kReaders.begin(), kReaders.end(), [&](const Reader& known) { return known.is_format(source); });
  return reader == kReaders.end() ? nullptr : &*reader;
}

const Reader& reader_of(const TextSource& source) {
  if (const Reader* reader = find_reader(source)) return *reader;
  std::string reasons = fmt::format("\n  not {}: no HDF5 and no JSON with monostatic_file", kPyaedt);
  for (const Reader& reader : kReaders) reasons += fmt::format("\n  not {}: {}", reader.name, reader.missing);
  throw InputError(fmt::format("{}: not a table of the radar cross section:{}", source.name(), reasons));
}

// Reads the file with the reader of its content; reader's name and facts of the file's name go into the table.
void read_recognised(const std::filesystem::path& file, const FieldTableSettings& settings, FieldTable& table) {
  const auto with = [&](const char* reader, const auto& read) {
    table.reader = reader;
    const FieldTableSettings all = completed(settings, facts_of_name(table.name), table.notes);
    try {
      read(all);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} (read as {})", error.what(), reader));
    }
  };
  const auto read_pair = [&](const FieldTableSettings& all) { read_pyaedt_file(file, all, table); };
  if (is_hdf5_file(file)) return with(kPyaedt, read_pair);
  const TextSource source = TextSource::read(file);
  if (is_pyaedt_json(source.text())) return with(kPyaedt, read_pair);
  const Reader& reader = reader_of(source);
  with(reader.name, [&](const FieldTableSettings& all) { reader.read(source, all, table); });
  if (!source.text().ends_with('\n')) table.notes.emplace_back("the last line has no end: is the file complete?");
}

// Throws InputError if a frequency is given that differs from the file's.
void require_own_frequency(const RcsCut& cut, const FieldTableSettings& given, const std::string& file) {
  constexpr double kTolerance = 1e-6;
  for (const FieldValue& value : cut.values) {
    if (std::abs(value.frequency_hz - *given.frequency_hz) <= kTolerance * value.frequency_hz) continue;
    throw InputError(fmt::format("{}: declares {:g} GHz: remove --reference-frequency-ghz {:g}", file,
                                 value.frequency_hz * 1e-9, *given.frequency_hz * 1e-9));
  }
}

// Throws InputError if an elevation is given that differs from the file's.
void require_own_elevation(const RcsCut& cut, double elevation_deg, const std::string& file) {
  constexpr double kTolerance_deg = 1e-3;
  for (const FieldValue& value : cut.values) {
    if (std::abs(90 - value.theta_deg - elevation_deg) <= kTolerance_deg) continue;
    throw InputError(fmt::format("{}: declares elevation {:g} deg: remove --reference-elevation-deg {:g}", file,
                                 90 - value.theta_deg, elevation_deg));
  }
}

// Throws InputError for a value that is not finite, or whose power is not.
void require_finite(const RcsCut& cut, const std::string& file) {
  for (const FieldValue& value : cut.values) {
    if (std::isfinite(value.frequency_hz + value.theta_deg + value.phi_deg + value.level_dbsm)) continue;
    throw InputError(fmt::format("{}{}: an angle, a frequency or a level is not finite", file,
                                 value.line > 0 ? fmt::format(":{}", value.line) : std::string()));
  }
}

// Throws InputError if an incident wave is given that differs from the file's.
void require_own_transmitter(const RcsCut& cut, const FieldTableSettings& given, const std::string& file) {
  if (!cut.transmitter || *cut.transmitter == *given.transmitter) return;
  throw InputError(fmt::format("{}: is {}: remove --incidence", file,
                               cut.transmitter->is_monostatic
                                   ? std::string("monostatic")
                                   : fmt::format("of a wave incident from theta {:g} deg, phi {:g} deg",
                                                 cut.transmitter->theta_deg, cut.transmitter->phi_deg)));
}

// The head of compare.csv.
bool is_comparison(std::string_view text) {
  return text.starts_with("# seaglint ") &&
         text.substr(0, text.find('\n')).find(" compare: ") != std::string_view::npos;
}

}  // namespace

bool is_field_table(const std::filesystem::path& file) try {
  if (is_hdf5_file(file)) return false;
  const TextSource source = TextSource::read(file);
  if (is_pyaedt_json(source.text())) return true;
  const Reader* reader = find_reader(source);
  if (reader == nullptr || is_comparison(source.text())) return false;
  // Rows of numbers without names are those of many formats.
  return reader->read != read_four_columns || has_four_columns(source);
} catch (const InputError&) {
  return false;
}

FieldTable read_field_table(const std::filesystem::path& file, const FieldTableSettings& settings) {
  FieldTable table;
  table.name = file.filename().string();
  read_recognised(file, settings, table);
  std::erase_if(table.cuts, [](const RcsCut& cut) { return cut.values.empty(); });
  if (table.cuts.empty())
    throw InputError(fmt::format("{}: contains no values (read as {})", file.string(), table.reader));
  for (RcsCut& cut : table.cuts) {
    cut.name = table.name;
    require_finite(cut, file.string());
    cut.phi_scale = settings.phi_scale;
    cut.phi_offset_deg = settings.phi_offset_deg;
    if (settings.origin_m) cut.origin_m = *settings.origin_m;
    if (settings.frequency_hz) require_own_frequency(cut, settings, file.string());
    if (settings.elevation_deg) require_own_elevation(cut, *settings.elevation_deg, file.string());
    if (settings.transmitter) require_own_transmitter(cut, settings, file.string());
  }
  return table;
}

}  // namespace seaglint
