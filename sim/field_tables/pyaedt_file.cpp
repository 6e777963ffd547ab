// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/pyaedt_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/json_keys.h"
#include "sim/core/text/json_problem.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_name.h"
#include "sim/field_tables/rows/pandas_table.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxJsonBytes = std::size_t{16} << 20;
constexpr const char* kFileKey = "monostatic_file";

struct Description {
  std::string data_file;  // name without a folder
  nlohmann::json unit;    // of frequencies; null without the key
  nlohmann::json model;   // an object of [mesh file, colour, opacity, unit] by name, or an array without meshes
};

double hz_of_unit(const fs::path& json, const nlohmann::json& unit) {
  for (const auto& [name, hz] :
       {std::pair<const char*, double>{"GHz", 1e9}, {"MHz", 1e6}, {"kHz", 1e3}, {"Hz", 1}, {"THz", 1e12}}) {
    if (unit == name) return hz;
  }
  throw InputError(
      fmt::format("{}: frequency_units {}: must be GHz, MHz, kHz, Hz or THz", json.string(), shown(unit.dump())));
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find_first_of("/\\") == std::string::npos &&
         name.find('\0') == std::string::npos;
}

Description read_description(const fs::path& file) {
  const std::string text = read_file(file, kMaxJsonBytes);
  check_json(text, file.string());
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    const nlohmann::json& name = json.at(kFileKey);
    if (name.is_null())
      throw InputError(fmt::format("{}: {} is null: only the geometry was exported", file.string(), kFileKey));
    if (!name.is_string() || !is_plain_name(name.get<std::string>())) {
      throw InputError(fmt::format("{}: {} {}: must be the name of a file in the same folder", file.string(), kFileKey,
                                   shown(name.dump())));
    }
    return {name.get<std::string>(), json.value("frequency_units", nlohmann::json()),
            json.value("model_info", nlohmann::json())};
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), json_problem(error)));
  }
}

// The unit of read_mesh() of this name in HFSS; nullptr for another.
const char* mesh_unit(const nlohmann::json& unit) {
  for (const auto& [name, known] : {std::pair<const char*, const char*>{"meter", "m"},
                                    {"m", "m"},
                                    {"mm", "mm"},
                                    {"cm", "cm"},
                                    {"km", "km"},
                                    {"in", "in"},
                                    {"ft", "ft"}}) {
    if (unit == name) return known;
  }
  return nullptr;
}

// The meshes that the JSON names, which PyAEDT puts into the folder `geometry` beside it. None and a note where one of
// them cannot be used: what remains is another model.
void add_geometry(const fs::path& json, const nlohmann::json& model, FieldTable& table) {
  if (!model.is_object()) return;
  std::vector<GeometryFile> geometry;
  for (const auto& [object, entry] : model.items()) {
    const auto unusable = [&](const std::string& why) {
      table.notes.push_back(fmt::format("its geometry is not used: {}: {}", in_quotes(object), why));
    };
    const bool is_entry = entry.is_array() && entry.size() >= 4 && entry[0].is_string();
    if (!is_entry || !is_plain_name(entry[0].get<std::string>()))
      return unusable("must be [mesh file, colour, opacity, unit]");
    const std::string name = entry[0].get<std::string>();
    const char* unit = mesh_unit(entry[3]);
    if (unit == nullptr)
      return unusable(fmt::format("unit {}: must be meter, mm, cm, km, in or ft", shown(entry[3].dump())));
    std::error_code error;
    fs::path file = json.parent_path() / "geometry" / name;
    if (!fs::is_regular_file(file, error)) file = json.parent_path() / name;
    if (!fs::is_regular_file(file, error))
      return unusable(fmt::format("no file {} beside the JSON or in its folder geometry", in_quotes(name)));
    geometry.push_back({file, unit});
  }
  table.geometry = std::move(geometry);
}

// The JSON files of a folder by name.
std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".json" && entry->is_regular_file(error) &&
        entry->file_size(error) <= kMaxJsonBytes)
      files.push_back(entry->path());
    error.clear();
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The JSON beside a table that names it.
fs::path description_of(const fs::path& table) {
  for (const fs::path& file : json_files(table.parent_path().empty() ? fs::path(".") : table.parent_path())) {
    try {
      if (read_description(file).data_file == table.filename()) return file;
    } catch (const InputError&) {  // another JSON
    }
  }
  throw InputError(fmt::format("{}: the unit of its frequencies is in a JSON beside it whose {} is {}: there is none",
                               table.string(), kFileKey, in_quotes(table.filename().string())));
}

std::optional<Polarisation> element_in_name(const fs::path& file) {
  std::optional<Polarisation> element;
  const std::string name = file.stem().string();
  for (const Polarisation known : {Polarisation::kHh, Polarisation::kHv, Polarisation::kVh, Polarisation::kVv}) {
    if (!has_word(name, kPolarisationNames[static_cast<int>(known)])) continue;
    if (element) return std::nullopt;
    element = known;
  }
  return element;
}

Polarisation element_of_pair(const fs::path& json, const fs::path& data, const FieldTableSettings& settings,
                             FieldTable& table) {
  const std::optional<Polarisation> of_json = element_in_name(json), of_data = element_in_name(data);
  if (of_json && of_data && of_json != of_data)
    throw InputError(fmt::format("{}: its name and that of {} have different polarisations", json.string(),
                                 in_quotes(data.filename().string())));
  const std::optional<Polarisation> named = of_json ? of_json : of_data;
  const std::vector<Polarisation>& wanted = settings.elements;
  if (!named && wanted.size() == 1) return wanted.front();
  if (!named) {
    throw InputError(fmt::format(
        "{}: does not say its polarisation, nor does its name (VV, HV, VH or HH, received and transmitted): "
        "give --reference-polarisation hh, hv, vh or vv",
        json.string()));
  }
  const char* name = kPolarisationNames[static_cast<int>(*named)];
  if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), *named) == wanted.end())
    throw InputError(fmt::format("{}: is {} by its name, which is not wanted", json.string(), name));
  table.notes.push_back(fmt::format("{} by the file's name (received, transmitted)", name));
  return *named;
}

}  // namespace

bool is_pyaedt_json(std::string_view text) {
  return trimmed(text.substr(0, text.find('{') + 1)) == "{" &&
         text.find("\"monostatic_file\"") != std::string_view::npos;
}

void read_pyaedt_file(const fs::path& file, const FieldTableSettings& settings, FieldTable& table) {
  const bool is_table = is_hdf5_file(file);
  const fs::path json = is_table ? description_of(file) : file;
  const Description description = read_description(json);
  const fs::path data = is_table ? file : file.parent_path() / description.data_file;
  if (!is_hdf5_file(data))
    throw InputError(fmt::format("{}: {} {}: no such HDF5 file beside it", json.string(), kFileKey,
                                 in_quotes(description.data_file)));
  table.notes.emplace_back("e^{+jwt}; theta^ = -v, phi^ = h; monostatic");
  RcsCut cut;
  cut.element = element_of_pair(json, data, settings, table);
  cut.transmitter.emplace();
  const double to_hz = hz_of_unit(json, description.unit);
  for (const PandasRow& row : read_pandas_table(data)) {
    if (row.frequency <= 0)
      throw InputError(fmt::format("{}: Freq {:g}: must be greater than 0", data.string(), row.frequency));
    cut.values.push_back(
        field_value(cut.element, row.frequency * to_hz, row.theta_deg, row.phi_deg, row.value / std::sqrt(4 * kPi), 0));
  }
  table.cuts.push_back(std::move(cut));
  add_geometry(json, description.model, table);
}

}  // namespace seaglint
