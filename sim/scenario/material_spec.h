// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Surface material, as in a file of assets/materials. Time factor e^{+jwt}: permittivity and permeability are real - j
// loss; a passive medium has loss >= 0.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seaglint {

// strength / (1 + j f / relaxation)
struct DebyeSpec {
  double strength = 0;         // 0 <= x <= 1e5
  double relaxation_ghz = 10;  // 1e-6 <= x <= 1e6

  bool operator==(const DebyeSpec&) const = default;
};

struct MeasuredSpec {
  double frequency_ghz = 10;  // 1e-3 <= x <= 1000, ascending
  double real = 1;            // 0 < x <= 1e5
  double loss = 0;            // 0 <= x <= 1e5

  bool operator==(const MeasuredSpec&) const = default;
};

// A relative permittivity or permeability over frequency: a table of measured values, interpolated linearly in the
// logarithm of frequency, constant beyond its ends; without a table real - j loss + sum of Debye terms - j conductivity
// / (w eps0).
struct DispersionSpec {
  double real = 1;              // at infinite frequency when there are Debye terms, 0 < x <= 1e5
  double loss = 0;              // 0 <= x <= 1e5
  double conductivity_s_m = 0;  // 0 <= x <= 1e9; of a permittivity
  std::vector<DebyeSpec> debye;
  std::vector<MeasuredSpec> table;

  bool operator==(const DispersionSpec&) const = default;
};

struct LayerSpec {
  double thickness_mm = 1;  // 0 < x <= 1000
  DispersionSpec permittivity;
  DispersionSpec permeability;

  bool operator==(const LayerSpec&) const = default;
};

enum class SurfaceKind {
  kPec,        // perfect electric conductor
  kConductor,  // half-space of finite conductivity
  kImpedance,  // surface impedance relative to free space, independent of angle (Leontovich)
  kLayers,     // stack of plane layers, illuminated layer first, on a perfect conductor or with air behind
  kSeaWater,   // half-space of sea water
  kSubmerged,  // opaque, neither reflects nor radiates; not available in files
  kLens        // uncapped surface of a Luneburg lens reflector; not available in files
};
// True for surfaces that reflect no beam and diffract at no edge.
inline bool ends_beams(SurfaceKind kind) { return kind == SurfaceKind::kSubmerged || kind == SurfaceKind::kLens; }
enum class Backing { kPec, kAir };

struct MaterialSpec {
  std::string name = "pec";
  std::string source;  // source of the values
  SurfaceKind kind = SurfaceKind::kPec;
  double lowest_ghz = 0.001;      // frequency range of the source, 0.001 <= x <= 1000
  double highest_ghz = 1000;      // lowest_ghz <= x <= 1000
  double roughness_mm = 0;        // RMS height, 0 <= x <= 100
  double conductivity_s_m = 1e7;  // of a conductor, 1 <= x <= 1e9
  double resistance = 0;          // of an impedance, relative to free space, 0 <= x <= 1e6
  double reactance = 0;           // of an impedance, positive = inductive, |x| <= 1e6
  Backing backing = Backing::kPec;
  std::vector<LayerSpec> layers;
  double temperature_c = 20;  // of sea water, -2 <= x <= 29
  double salinity_psu = 35;   // of sea water, 0 <= x <= 40
  double loss_db = 0;         // of a lens, both ways, 0 <= x <= 10

  bool operator==(const MaterialSpec&) const = default;
};

// Name of the surface of a Luneburg lens in a mesh: luneburg_lens, with a loss luneburg_lens_1.5dB.
std::string lens_material_name(double loss_db);
// The material of such a name; nullopt for any other name.
std::optional<MaterialSpec> lens_material(const std::string& name);

// Reads and checks a material file. Throws InputError "file:line:col: key.path: value ...: bound".
MaterialSpec read_material(const std::filesystem::path& file);
MaterialSpec parse_material(const std::string& yaml, const std::string& file_name);

// File of a material: a path, or NAME for assets/materials/NAME.yaml; searched in `folder`, then in the working
// directory. nullopt for `pec` and the names of lenses. Throws InputError, beginning with `where`, when there is none.
std::optional<std::filesystem::path> find_material_file(const std::string& name, const std::filesystem::path& folder,
                                                        const std::string& where);

// The material of the name of a material in a mesh: assets/materials/NAME.yaml in the same places, or a lens; nullopt
// for `pec`, for a path and for a name without a file.
std::optional<MaterialSpec> known_material(const std::string& name, const std::filesystem::path& folder);

// Contents of the file of find_material_file(); a perfect conductor for `pec`, a lens for its name. Throws likewise.
MaterialSpec find_material(const std::string& name, const std::filesystem::path& folder, const std::string& where);

}  // namespace seaglint
