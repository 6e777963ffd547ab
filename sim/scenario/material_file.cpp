// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/material_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// Whether a material is named by its file, not by a name of assets/materials.
bool is_path(const std::string& name) { return name.ends_with(".yaml") || name.find('/') != std::string::npos; }

fs::path file_of_name(const std::string& name) { return fs::path("assets/materials") / (name + ".yaml"); }

constexpr std::size_t kMaxTerms = 64, kMaxRows = 10000, kMaxLayers = 100;

void visit(DebyeSpec& spec, FieldVisitor& v) {
  v.require("strength");
  v.number("strength", spec.strength, within(0, 1e5), "");
  v.require("relaxation_ghz");
  v.number("relaxation_ghz", spec.relaxation_ghz, within(1e-6, 1e6), "");
}

void visit(MeasuredSpec& spec, FieldVisitor& v) {
  v.require("frequency_ghz");
  v.number("frequency_ghz", spec.frequency_ghz, within(1e-3, 1000), "");
  v.require("real");
  v.number("real", spec.real, above_up_to(0, 1e5), "");
  v.number("loss", spec.loss, within(0, 1e5), "");
}

void visit(DispersionSpec& spec, FieldVisitor& v) {
  v.number("real", spec.real, above_up_to(0, 1e5), "");
  v.number("loss", spec.loss, within(0, 1e5), "");
  v.number("conductivity_s_m", spec.conductivity_s_m, within(0, 1e9), "");
  v.list("debye", spec.debye, kMaxTerms, visit, "");
  v.list("table", spec.table, kMaxRows, visit, "");
}

void visit(LayerSpec& spec, FieldVisitor& v) {
  v.require("thickness_mm");
  v.number("thickness_mm", spec.thickness_mm, above_up_to(0, 1000), "");
  v.section("permittivity", spec.permittivity, visit, "");
  v.section("permeability", spec.permeability, visit, "");
}

void visit(MaterialSpec& spec, FieldVisitor& v) {
  v.require("material");
  v.text("material", spec.name, "");
  v.require("source");
  v.text("source", spec.source, "");
  v.require("kind");
  v.choice("kind", spec.kind, {"pec", "conductor", "impedance", "layers", "sea_water"}, "");
  v.number("lowest_ghz", spec.lowest_ghz, within(0.001, 1000), "");
  v.number("highest_ghz", spec.highest_ghz, within(0.001, 1000), "");
  v.number("roughness_mm", spec.roughness_mm, within(0, 100), "");
  const auto only = [&](SurfaceKind kind, const char* key, double& value, const Bound& bound) {
    if (v.optional(key, spec.kind == kind)) v.number(key, value, bound, "");
  };
  only(SurfaceKind::kConductor, "conductivity_s_m", spec.conductivity_s_m, within(1, 1e9));
  only(SurfaceKind::kImpedance, "resistance", spec.resistance, within(0, 1e6));
  only(SurfaceKind::kImpedance, "reactance", spec.reactance, within(-1e6, 1e6));
  if (v.optional("backing", spec.kind == SurfaceKind::kLayers)) v.choice("backing", spec.backing, {"pec", "air"}, "");
  v.list("layers", spec.layers, kMaxLayers, visit, "");
  only(SurfaceKind::kSeaWater, "temperature_c", spec.temperature_c, within(-2, 29));
  only(SurfaceKind::kSeaWater, "salinity_psu", spec.salinity_psu, within(0, 40));
}

void check_dispersion(const DispersionSpec& spec, const std::string& path, bool magnetic,
                      const ScenarioDocument& document) {
  if (magnetic && spec.conductivity_s_m > 0) {
    document.fail_at(path + ".conductivity_s_m", "not allowed here: valid only with a permittivity");
  }
  for (std::size_t i = 1; i < spec.table.size(); ++i) {
    if (spec.table[i].frequency_ghz <= spec.table[i - 1].frequency_ghz) {
      document.fail_at(fmt::format("{}.table.{}.frequency_ghz", path, i),
                       fmt::format("must be greater than the row before, {}", spec.table[i - 1].frequency_ghz));
    }
  }
}

// Keys that do not apply to this kind are errors.
void check_material(const MaterialSpec& spec, const ScenarioDocument& document) {
  if (spec.highest_ghz < spec.lowest_ghz) {
    document.fail_at("highest_ghz", fmt::format("must be at least lowest_ghz, {}", spec.lowest_ghz));
  }
  const auto only = [&](const char* key, SurfaceKind kind, const char* name) {
    if (spec.kind != kind && document.root.find(key) != nullptr) {
      document.fail_at(key, fmt::format("not allowed here: valid only with kind: {}", name));
    }
  };
  only("conductivity_s_m", SurfaceKind::kConductor, "conductor");
  only("resistance", SurfaceKind::kImpedance, "impedance");
  only("reactance", SurfaceKind::kImpedance, "impedance");
  only("backing", SurfaceKind::kLayers, "layers");
  only("layers", SurfaceKind::kLayers, "layers");
  only("temperature_c", SurfaceKind::kSeaWater, "sea_water");
  only("salinity_psu", SurfaceKind::kSeaWater, "sea_water");
  if (spec.kind == SurfaceKind::kLayers && spec.layers.empty()) document.fail_at("layers", "this key is missing");
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const std::string path = fmt::format("layers.{}", i);
    check_dispersion(spec.layers[i].permittivity, path + ".permittivity", false, document);
    check_dispersion(spec.layers[i].permeability, path + ".permeability", true, document);
  }
}

}  // namespace

MaterialSpec read_material(const fs::path& file) {
  return parse_material(read_file(file, kMaxYamlBytes), file.string());
}

MaterialSpec parse_material(const std::string& yaml, const std::string& file_name) {
  const ScenarioDocument document{file_name, {}, parse_yaml(yaml, file_name)};
  ErrorList errors(document);
  MaterialSpec spec;
  read_fields(document, errors, [&](FieldVisitor& visitor) { visit(spec, visitor); });
  errors.check({""}, [&] { check_material(spec, document); });
  errors.throw_if_any();
  return spec;
}

namespace {

constexpr std::string_view kLensName = "luneburg_lens", kDecibels = "dB";

}  // namespace

std::string lens_material_name(double loss_db) {
  return loss_db > 0 ? fmt::format("{}_{}{}", kLensName, loss_db, kDecibels) : std::string(kLensName);
}

std::optional<MaterialSpec> lens_material(const std::string& name) {
  if (!name.starts_with(kLensName)) return std::nullopt;
  MaterialSpec lens;
  lens.name = name;
  lens.source = "geometrical optics of a Luneburg lens";
  lens.kind = SurfaceKind::kLens;
  std::string_view loss = std::string_view(name).substr(kLensName.size());
  if (loss.empty()) return lens;
  if (!loss.starts_with('_') || !loss.ends_with(kDecibels)) return std::nullopt;
  loss.remove_prefix(1);
  loss.remove_suffix(kDecibels.size());
  const std::optional<double> value = parse_number(loss);
  if (!value || !(*value >= 0 && *value <= 10)) return std::nullopt;
  lens.loss_db = *value;
  return lens;
}

std::optional<fs::path> find_material_file(const std::string& name, const fs::path& folder, const std::string& where) {
  if (name == "pec" || lens_material(name)) return std::nullopt;
  const bool is_file = is_path(name);
  const fs::path path = is_file ? fs::path(name) : file_of_name(name);
  if (std::optional<fs::path> file = search_file(path.string(), folder)) return file;
  if (is_file) {
    throw InputError(fmt::format("{}: value '{}': no such material file, {}{}", where, name, places_text(folder),
                                 similar_file(name, folder)));
  }
  std::error_code error;
  std::vector<std::string> names{"pec"};
  for (const fs::path& place : search_folders(folder)) {
    for (const auto& entry : fs::directory_iterator(place / path.parent_path(), error)) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  throw InputError(fmt::format("{}: value '{}': no such material in {}, {}: {}", where, name,
                               path.parent_path().string(), places_text(folder), suggestion(name, names)));
}

std::optional<MaterialSpec> known_material(const std::string& name, const fs::path& folder) {
  if (name == "pec" || is_path(name)) return std::nullopt;
  if (const auto file = search_file(file_of_name(name).string(), folder)) return read_material(*file);
  return lens_material(name);
}

MaterialSpec find_material(const std::string& name, const fs::path& folder, const std::string& where) {
  const std::optional<fs::path> file = find_material_file(name, folder, where);
  return file ? read_material(*file) : lens_material(name).value_or(MaterialSpec{});
}

}  // namespace seaglint
