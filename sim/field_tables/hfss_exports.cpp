// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_text.h"

namespace seaglint {
namespace {

constexpr std::string_view kMonostatic = "MonostaticRCS", kBistatic = "BistaticRCS";

// The directions and frequency in the name of a result, as far as they stand there.
struct NamedPlace {
  std::optional<double> frequency_hz, wave_theta_deg, wave_phi_deg, theta_deg, phi_deg;

  auto key() const { return std::tuple(frequency_hz, wave_theta_deg, wave_phi_deg, theta_deg, phi_deg); }
};

enum class Component { kTheta, kPhi, kTotal };

// A column of values and its unit: of levels; in metres, degrees or radians.
struct Level {
  std::size_t column = 0;
  LevelUnit unit;
};
struct ScaledColumn {
  std::size_t column = 0;
  double unit = 1;

  double value(const TextTable& rows, std::size_t row) const { return rows.number(row, column) * unit; }
};

// Columns of one component at one named place.
struct Result {
  NamedPlace place;
  Component component = Component::kTheta;  // received
  std::optional<Level> level;
  std::optional<ScaledColumn> magnitude_m, re_m, im_m, phase_rad;

  bool has_value() const { return level || magnitude_m || (re_m && im_m); }
};

std::optional<std::string_view> quoted_value(std::string_view name, std::string_view word) {
  std::optional<std::string_view> text = value_in_name(name, word);
  if (!text || !text->starts_with('\'')) return std::nullopt;
  text->remove_prefix(1);
  return text->substr(0, text->find('\''));
}

// Degrees of `85deg` or `1.48rad`; nullopt for another unit.
std::optional<double> angle_in_name(std::string_view text) {
  const std::optional<double> value = leading_number(text);
  const std::string_view unit = trimmed(text.substr(std::min(text.find_first_not_of("+-.0123456789eE"), text.size())));
  if (!value || (unit != "deg" && unit != "rad" && !unit.empty())) return std::nullopt;
  return unit == "rad" ? degrees(*value) : *value;
}

NamedPlace place_in(std::string_view name) {
  NamedPlace place;
  const auto angle = [&](const char* word) {
    const std::optional<std::string_view> text = quoted_value(name, word);
    return text ? angle_in_name(*text) : std::nullopt;
  };
  if (const auto text = quoted_value(name, "Freq")) place.frequency_hz = frequency_in_name(*text);
  place.wave_theta_deg = angle("IWaveTheta");
  place.wave_phi_deg = angle("IWavePhi");
  place.theta_deg = angle("Theta");
  place.phi_deg = angle("Phi");
  return place;
}

// What stands in the name of a result: `mag(ComplexMonostaticRCSTheta) [mm] - ...`.
struct ResultName {
  std::string function, unit;
  bool is_complex = false, is_bistatic = false;
  Component component = Component::kTheta;
};

// The unit in the first brackets; empty without them.
std::string unit_in(std::string_view name) {
  const std::size_t open = name.find('[');
  const std::size_t close = open == std::string_view::npos ? open : name.find(']', open);
  return close == std::string_view::npos ? std::string() : squeezed(name.substr(open + 1, close - open - 1));
}

// Empty for a column that is no result: an axis, or a quantity of another kind.
std::optional<ResultName> result_name(std::string_view name) {
  ResultName result;
  std::size_t at = name.find(kMonostatic);
  std::size_t end = at + kMonostatic.size();
  if (at == std::string_view::npos) {
    at = name.find(kBistatic);
    end = at + kBistatic.size();
    result.is_bistatic = true;
  }
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view before = name.substr(0, at);
  const std::string_view behind = name.substr(end);
  result.is_complex = before.ends_with("Complex");
  if (result.is_complex) before.remove_suffix(std::string_view("Complex").size());
  if (before.ends_with('(')) before.remove_suffix(1);
  result.function = trimmed(before);
  if (behind.starts_with("Theta")) {
    result.component = Component::kTheta;
  } else if (behind.starts_with("Phi")) {
    result.component = Component::kPhi;
  } else if (behind.starts_with("Total")) {
    result.component = Component::kTotal;
  } else {
    return std::nullopt;
  }
  result.unit = unit_in(behind);
  return result;
}

// The names of a report in one of the first lines, and the text below.
struct Head {
  std::string_view line;
  std::vector<std::string> names;
  char separator = ',';
  std::string_view rows;
};

std::optional<Head> head_of(const TextSource& source) {
  constexpr int kMaxLines = 20;
  std::string_view rest = source.text();
  for (int n = 0; n < kMaxLines && !rest.empty(); ++n) {
    const std::string_view text = rest, line = next_line(rest);
    if (line.find(kMonostatic) == std::string_view::npos && line.find(kBistatic) == std::string_view::npos) continue;
    for (const char separator : {',', ';', '\t'}) {
      std::string_view below = text;
      const TextRow row = next_row(below, separator);
      if (row.cells.size() < 2) continue;
      return Head{line, {row.cells.begin(), row.cells.end()}, separator, below};
    }
  }
  return std::nullopt;
}

class HfssTable {
 public:
  HfssTable(const TextSource& source, Head head)
      : source_(source),
        head_(std::move(head)),
        rows_(TextTable::below(source, head_.rows, head_.names, head_.separator)) {
    for (std::size_t k = 0; k < head_.names.size(); ++k) place_column(k);
    if (has(Component::kTheta) || has(Component::kPhi) || has(Component::kTotal)) return;
    source_.fail(head_.line, fmt::format("no column of MonostaticRCSTheta, ...Phi or ...Total, or of BistaticRCS, with "
                                         "dB(), mag(), re() and im(){}",
                                         unread_.empty() ? "" : "; not read: " + shown(unread_)));
  }

  const std::vector<Result>& results() const { return results_; }
  std::size_t rows() const { return rows_.rows(); }
  bool is_bistatic() const { return is_bistatic_; }
  bool has(Component component) const {
    return std::any_of(results_.begin(), results_.end(),
                       [&](const Result& result) { return result.component == component && result.has_value(); });
  }

  FieldValue value(const Result& result, Polarisation element, std::size_t row,
                   std::optional<double> given_frequency_hz) const {
    const NamedPlace& named = result.place;
    const double theta = is_bistatic_ ? angle(named.theta_deg, theta_, row, "Theta")
                                      : angle(named.wave_theta_deg, wave_theta_, row, "IWaveTheta"),
                 phi = is_bistatic_ ? angle(named.phi_deg, phi_, row, "Phi")
                                    : angle(named.wave_phi_deg, wave_phi_, row, "IWavePhi"),
                 frequency_hz = frequency(result, row, given_frequency_hz);
    const int line = rows_.line(row);
    if (result.re_m && result.im_m) {
      const Complex root_area(result.re_m->value(rows_, row), result.im_m->value(rows_, row));
      return field_value(element, frequency_hz, theta, phi, root_area / std::sqrt(4 * kPi), line);
    }
    const double level = level_dbsm(result, row);
    if (result.phase_rad) {
      const Complex s = std::polar(amplitude_of_dbsm(level), result.phase_rad->value(rows_, row));
      FieldValue value = field_value(element, frequency_hz, theta, phi, s, line);
      value.level_dbsm = level;
      return value;
    }
    return level_value(frequency_hz, theta, phi, level, line);
  }

  // The incident wave of a bistatic row; `given` where the file does not state it.
  std::optional<DeclaredTransmitter> transmitter(const Result& result, std::size_t row,
                                                 const std::optional<DeclaredTransmitter>& given) const {
    if (!is_bistatic_) return DeclaredTransmitter{};
    const bool states_theta = result.place.wave_theta_deg || wave_theta_;
    const bool states_phi = result.place.wave_phi_deg || wave_phi_;
    if (!states_theta && !states_phi) return given;
    DeclaredTransmitter transmitter{false, angle(result.place.wave_theta_deg, wave_theta_, row, "IWaveTheta"),
                                    angle(result.place.wave_phi_deg, wave_phi_, row, "IWavePhi")};
    fold_direction(transmitter.theta_deg, transmitter.phi_deg);
    return transmitter;
  }

 private:
  void place_column(std::size_t k) {
    const std::string_view name = head_.names[k];
    if (const std::optional<ResultName> result = result_name(name)) return place_result(k, *result);
    const std::string_view axis = trimmed(name.substr(0, name.find('[')));
    if (axis == "IWaveTheta") place_angle(wave_theta_, k);
    if (axis == "IWavePhi") place_angle(wave_phi_, k);
    if (axis == "Theta") place_angle(theta_, k);
    if (axis == "Phi") place_angle(phi_, k);
    if (axis == "Freq") place_frequency(k);
  }

  void place_result(std::size_t k, const ResultName& name) {
    if (!results_.empty() && name.is_bistatic != is_bistatic_)
      source_.fail(head_.line, "columns of the monostatic and of the bistatic radar cross section: export one of them");
    is_bistatic_ = name.is_bistatic;
    Result& result = result_at(place_in(head_.names[k]), name.component);
    const std::string& f = name.function;
    const bool is_magnitude = f.empty() || f == "mag" || f == "abs";
    if (f == "dB" || f == (name.is_complex ? "dB20" : "dB10")) {
      if (!name.unit.empty() && name.unit != "dB" && name.unit != "dBsm" && name.unit != "dBm^2")
        fail_unit(k, name, "dB() of it must be in [], [dB] or [dBsm]");
      result.level = Level{k, LevelUnit(source_, head_.line, head_.names[k], "dBsm", 0)};
    } else if (!name.is_complex && is_magnitude) {
      const std::string unit = name.unit.empty() ? "m^2" : name.unit == "dB" ? "dBsm" : name.unit;
      result.level = Level{k, LevelUnit(source_, head_.line, head_.names[k], unit, 0)};
      if (result.level->unit.is_field()) fail_unit(k, name, "must be an area");
    } else if (name.is_complex && (f == "mag" || f == "abs" || (f.empty() && !name.unit.empty()))) {
      result.magnitude_m = length_column(k, name);
    } else if (name.is_complex && f == "re") {
      result.re_m = length_column(k, name);
    } else if (name.is_complex && f == "im") {
      result.im_m = length_column(k, name);
    } else if (name.is_complex && (f.starts_with("ang") || f.starts_with("cang"))) {
      const bool in_degrees = f.ends_with("_deg");
      if (!in_degrees && !f.ends_with("_rad")) return add_unread(k);
      if (!name.unit.empty() && name.unit != (in_degrees ? "deg" : "rad"))
        fail_unit(k, name, "must agree with its name");
      result.phase_rad = ScaledColumn{k, in_degrees ? radians(1) : 1};
    } else {
      add_unread(k);
    }
  }
  void add_unread(std::size_t k) {
    if (!unread_.empty()) unread_ += ", ";
    unread_ += head_.names[k];
  }
  ScaledColumn length_column(std::size_t k, const ResultName& name) const {
    const std::optional<double> unit_m = name.unit.empty() ? 1.0 : length_unit_m(name.unit);
    if (!unit_m) fail_unit(k, name, "sqrt(sigma) must be in metres, [meter], or another length");
    return {k, *unit_m};
  }
  [[noreturn]] void fail_unit(std::size_t k, const ResultName& name, const char* wanted) const {
    source_.fail(head_.line, fmt::format("unit {} of {}: {}", in_quotes(name.unit), shown(head_.names[k]), wanted));
  }

  void place_angle(std::optional<ScaledColumn>& place, std::size_t k) {
    const std::string unit = unit_in(head_.names[k]);
    if (!unit.starts_with("deg") && unit != "rad")
      source_.fail(head_.line, fmt::format("{}: must be in [deg] or [rad]", shown(head_.names[k])));
    place = ScaledColumn{k, unit == "rad" ? degrees(1) : 1};
  }
  void place_frequency(std::size_t k) {
    const std::string unit = unit_in(head_.names[k]);
    const std::optional<double> hz = frequency_in_name("1 " + unit);
    if (!hz || !(unit.ends_with("Hz") || unit.ends_with("hz")))
      source_.fail(head_.line, fmt::format("{}: must be in [GHz], [MHz], [kHz] or [Hz]", shown(head_.names[k])));
    frequency_ = k;
    to_hz_ = *hz;
  }
  Result& result_at(const NamedPlace& place, Component component) {
    const auto found = std::find_if(results_.begin(), results_.end(), [&](const Result& other) {
      return other.component == component && other.place.key() == place.key();
    });
    if (found != results_.end()) return *found;
    results_.push_back({place, component, {}, {}, {}, {}, {}});
    return results_.back();
  }

  double level_dbsm(const Result& result, std::size_t row) const {
    if (result.level) return result.level->unit.level_dbsm(rows_, row, result.level->column);
    const double length_m = rows_.number(row, result.magnitude_m->column, 0) * result.magnitude_m->unit;
    return dbsm_of_area(length_m * length_m);
  }
  double angle(const std::optional<double>& named_deg, const std::optional<ScaledColumn>& place, std::size_t row,
               const char* name) const {
    if (named_deg) return *named_deg;
    if (!place) source_.fail(head_.line, fmt::format("no column {} [deg], nor {} in a result's name", name, name));
    return place->value(rows_, row);
  }
  double frequency(const Result& result, std::size_t row, std::optional<double> given) const {
    if (frequency_) return rows_.positive(row, *frequency_) * to_hz_;
    if (result.place.frequency_hz) return *result.place.frequency_hz;
    if (given) return *given;
    source_.fail(head_.line, "no column Freq, nor a frequency in the results' names: give --reference-frequency-ghz");
  }

  const TextSource& source_;
  Head head_;
  TextTable rows_;
  std::optional<ScaledColumn> wave_theta_, wave_phi_, theta_, phi_;  // degrees
  std::optional<std::size_t> frequency_;
  double to_hz_ = 1;
  bool is_bistatic_ = false;
  std::vector<Result> results_;
  std::string unread_;  // names of columns with other functions
};

}  // namespace

bool is_hfss_table(const TextSource& source) {
  const std::optional<Head> head = head_of(source);
  return head && std::any_of(head->names.begin(), head->names.end(), [](const std::string& name) {
           return name.find("IWave") != std::string::npos || name.find(kBistatic) != std::string::npos;
         });
}

void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  const HfssTable hfss(source, *head_of(source));
  table.notes.emplace_back(hfss.is_bistatic() ? "e^{+jwt}; theta^ = -v, phi^ = h; bistatic"
                                              : "e^{+jwt}; theta^ = -v, phi^ = h; monostatic");
  const auto add = [&](Component component, Polarisation element) {
    const std::size_t quantity = quantity_of(element, component == Component::kTotal);
    for (const Result& result : hfss.results()) {
      if (result.component != component || !result.has_value()) continue;
      for (std::size_t row = 0; row < hfss.rows(); ++row) {
        cut_for(table, quantity, hfss.transmitter(result, row, settings.transmitter))
            .values.push_back(hfss.value(result, element, row, settings.frequency_hz));
      }
    }
  };
  if (!hfss.has(Component::kTheta) && !hfss.has(Component::kPhi)) {
    const bool v = total_transmits_v(settings, source.name(), "an HFSS table");
    table.notes.push_back(total_note(v));
    return add(Component::kTotal, element_of(v, v));
  }
  require_elements(settings, source.name(), "an HFSS table");
  for (const Polarisation element : settings.elements)
    add(receives_v(element) ? Component::kTheta : Component::kPhi, element);
}

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
  if (const auto hz = unit.is_string() ? frequency_unit_hz(unit.get<std::string>()) : std::nullopt) return *hz;
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
  RcsCut& cut = cut_for(table, quantity_of(element_of_pair(json, data, settings, table), false), DeclaredTransmitter{});
  const double to_hz = hz_of_unit(json, description.unit);
  for (const PandasRow& row : read_pandas_table(data)) {
    if (row.frequency <= 0)
      throw InputError(fmt::format("{}: Freq {:g}: must be greater than 0", data.string(), row.frequency));
    cut.values.push_back(
        field_value(cut.element, row.frequency * to_hz, row.theta_deg, row.phi_deg, row.value / std::sqrt(4 * kPi), 0));
  }
  add_geometry(json, description.model, table);
}

}  // namespace seaglint
