// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/reference_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/field_tables/read_field_table.h"

namespace seaglint {
namespace {

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string cell = text.substr(begin, end - begin);
    begin = end + 1;
    const std::optional<double> value = parse_number(cell);
    if (!value) throw InputError(fmt::format("{} {}: '{}' is not a number", option, text, cell));
    values.push_back(*value);
  }
  if (values.size() != count)
    throw InputError(fmt::format("{} {}: must be {} numbers, separated by commas", option, text, count));
  return values;
}

// The value for file i: none, the only one, or the i-th.
const std::string* value_for(const std::string& option, const std::vector<std::string>& values, std::size_t i,
                             std::size_t files) {
  if (values.empty()) return nullptr;
  if (values.size() == 1) return &values[0];
  if (values.size() != files)
    throw InputError(fmt::format("{} is given {} times for {} references: once for all, or once for each", option,
                                 values.size(), files));
  return &values[i];
}

// hh, hv, vh or vv, or of the transmitted polarisation, h or v, both elements.
std::vector<Polarisation> elements_named(const std::string& name) {
  if (name == "h" || name == "v") return {element_of(true, name == "v"), element_of(false, name == "v")};
  for (int i = 0; i < 4; ++i) {
    if (name == kPolarisationNames[i]) return {static_cast<Polarisation>(i)};
  }
  throw InputError(fmt::format(
      "--reference-polarisation {}: must be hh, hv, vh or vv (received, transmitted), or h or v (transmitted)", name));
}

DeclaredTransmitter incidence_named(const std::string& text) {
  if (text == "monostatic") return {};
  const std::vector<double> angles = numbers("--incidence", text, 2);
  DeclaredTransmitter transmitter{false, angles[0], angles[1]};
  fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  return transmitter;
}

struct Folder {
  std::vector<std::filesystem::path> tables, others;  // by name
};

// Files whose name begins with a point, and folders within, are neither.
Folder contents_of(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code of_entry;
    if (entry->is_regular_file(of_entry) && !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path());
  }
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  std::sort(files.begin(), files.end());
  Folder folder;
  for (std::filesystem::path& file : files) (is_field_table(file) ? folder.tables : folder.others).push_back(file);
  if (folder.tables.empty())
    throw InputError(fmt::format("{}: no file in this folder is a table of the radar cross section", path.string()));
  return folder;
}

// "DIR: 3 tables; not read as tables: a.png, b.txt".
std::string contents_text(const std::filesystem::path& path, const Folder& folder) {
  constexpr std::size_t kLongest = 400;
  std::string others;
  for (const std::filesystem::path& file : folder.others)
    others += (others.empty() ? "" : ", ") + file.filename().string();
  return fmt::format("{}: {} {}{}{}", path.string(), folder.tables.size(),
                     folder.tables.size() == 1 ? "table" : "tables",
                     others.empty() ? "" : "; not read as tables: ", shown(others, kLongest));
}

}  // namespace

FieldTable joined_tables(std::vector<FieldTable> tables, const std::string& file) {
  FieldTable all = std::move(tables.front());
  if (tables.size() == 1) return all;
  all.name = std::filesystem::path(file).lexically_normal().string();
  for (std::size_t i = 1; i < tables.size(); ++i)
    all.cuts.insert(all.cuts.end(), tables[i].cuts.begin(), tables[i].cuts.end());
  return all;
}

void ReferenceArguments::add_to(CommandOptions& command) {
  const CommandOption reference =
      command
          .add_option(
              "--reference", files,
              "Compare with a cut that was measured or computed elsewhere (repeatable): an export of CST, FEKO or "
              "HFSS, a table of this command, of a chamber by azimuth, or four columns frequency_hz theta_deg phi_deg "
              "dBsm; or a folder of them")
          .repeatable("FILE")
          .group("Reference");
  for (const CommandOption& option : add_properties_to(command)) CommandOption(option).needs(reference);
  command
      .add_option("--figure", figure,
                  "Figure of the comparison, or of --uncertainty, .png or .svg; default: the output's name with .png")
      .group("Reference");
  command
      .add_option("--curves", curves,
                  "Curves of the comparison's figure as JSON: panels with their axes and series, for other programs")
      .needs(reference)
      .group("Reference");
}

std::vector<CommandOption> ReferenceArguments::add_properties_to(CommandOptions& command) {
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* what, const char* type) {
    return command.add_option(name, values, what).repeatable(type).group("Reference");
  };
  return {
      repeatable(
          "--reference-polarisation", polarisation,
          "hh, hv, vh or vv (received, transmitted), or h or v (transmitted: both elements); default what the file "
          "or its name says; once, or once for each file",
          "PP"),
      repeatable("--reference-phi", phi,
                 "A,B: the file's phi is A * azimuth + B degrees; default 1,0. Its theta is 90 - elevation", "A,B"),
      repeatable("--reference-frequency-ghz", frequency_ghz, "Frequency of a file that does not say it", "GHZ"),
      repeatable("--reference-elevation-deg", elevation_deg,
                 "Elevation of a table by azimuth that does not say it; default 0", "DEG"),
      repeatable(
          "--incidence", incidence,
          "monostatic, or THETA,PHI of the file: where the incident wave comes from, of a file that does not say it",
          "DIRECTION"),
      repeatable("--reference-origin-m", origin_m,
                 "The file's phase origin in the body's frame; default what the file says, else 0,0,0", "X,Y,Z"),
      command.add_option("--floor-db", floor_db, "Levels further below the file's maximum are clipped to this floor")
          .number_within(1.0, 300.0)
          .show_default()
          .group("Reference")};
}

ReferenceTables ReferenceArguments::read() const {
  ReferenceTables references;
  for (std::size_t i = 0; i < files.size(); ++i) {
    FieldTableSettings settings;
    if (const std::string* text = value_for("--reference-polarisation", polarisation, i, files.size()))
      settings.elements = elements_named(*text);
    if (const std::string* text = value_for("--reference-phi", phi, i, files.size())) {
      const std::vector<double> map = numbers("--reference-phi", *text, 2);
      if (map[0] == 0) throw InputError(fmt::format("--reference-phi {}: the factor must not be 0", *text));
      settings.phi_scale = map[0];
      settings.phi_offset_deg = map[1];
    }
    if (const std::string* text = value_for("--reference-frequency-ghz", frequency_ghz, i, files.size())) {
      settings.frequency_hz = numbers("--reference-frequency-ghz", *text, 1)[0] * 1e9;
      if (*settings.frequency_hz <= 0)
        throw InputError(fmt::format("--reference-frequency-ghz {}: must be > 0", *text));
    }
    if (const std::string* text = value_for("--reference-elevation-deg", elevation_deg, i, files.size())) {
      settings.elevation_deg = numbers("--reference-elevation-deg", *text, 1)[0];
      if (std::abs(*settings.elevation_deg) > 90)
        throw InputError(fmt::format("--reference-elevation-deg {}: must be within -90 and 90", *text));
    }
    if (const std::string* text = value_for("--incidence", incidence, i, files.size()))
      settings.transmitter = incidence_named(*text);
    if (const std::string* text = value_for("--reference-origin-m", origin_m, i, files.size())) {
      const std::vector<double> x = numbers("--reference-origin-m", *text, 3);
      settings.origin_m = Vec3(x[0], x[1], x[2]);
    }
    std::error_code error;
    if (!std::filesystem::is_directory(files[i], error)) {
      references.tables.push_back(read_field_table(files[i], settings));
      continue;
    }
    const Folder folder = contents_of(files[i]);
    references.folders.push_back(contents_text(files[i], folder));
    for (const std::filesystem::path& file : folder.tables)
      references.tables.push_back(read_field_table(file, settings));
  }
  return references;
}

}  // namespace seaglint
