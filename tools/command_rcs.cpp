// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "seaglint_version.h"
#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/number.h"
#include "sim/core/progress.h"
#include "sim/geometry/mesh_io.h"
#include "sim/scattering/respond.h"
#include "tools/command.h"

namespace seaglint {

namespace {

struct RcsArguments {
  std::string target, unit = "m", frequency_ghz, azimuth_deg, elevation_deg = "0", edges = "off", output;
  double ray_spacing_m = 0;
  int max_bounces = 8;
};

std::vector<double> range(const std::string& option, const std::string& text, double lower, double upper) {
  std::vector<double> values;
  try {
    values = parse_range(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  for (const double value : values) {
    if (value < lower || value > upper)
      throw InputError(fmt::format("{}: value {}: must be {} <= x <= {}", option, value, lower, upper));
  }
  return values;
}

double dbsm(const Complex& s) { return 10 * std::log10(std::max(4 * kPi * std::norm(s), 1e-30)); }

void run_rcs(const RcsArguments& arguments, const Shell& shell) {
  if (arguments.edges != "off") {
    throw InputError(
        "--edges on: edge currents are not modelled in this version; physical optics alone is --edges off");
  }
  const std::vector<double> frequencies = range("--frequency-ghz", arguments.frequency_ghz, 1e-3, 1000);
  const std::vector<double> azimuths = range("--azimuth-deg", arguments.azimuth_deg, -720, 720);
  const std::vector<double> elevations = range("--elevation-deg", arguments.elevation_deg, -90, 90);
  const std::size_t views = azimuths.size() * elevations.size(), rows = views * frequencies.size();
  constexpr std::size_t kMostRows = 4'000'000;  // 256 MB of matrices
  if (rows > kMostRows) throw InputError(fmt::format("{} rows of output: at most {}", rows, kMostRows));

  const TriangleMesh mesh = read_mesh(arguments.target, arguments.unit);
  const Scatterer scatterer(mesh);
  std::vector<double> wavenumbers;
  for (const double ghz : frequencies) wavenumbers.push_back(2 * kPi * ghz * 1e9 / kSpeedOfLight);

  const int threads = thread_count(shell.threads);
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::vector<std::array<Complex, 4>>> matrices(views);
  std::size_t rays = 0;
  {
    Progress progress("rcs", views);
    for (std::size_t view = 0; view < views; ++view) {
      const double az = radians(azimuths[view % azimuths.size()]), el = radians(elevations[view / azimuths.size()]);
      const RadarBasis basis = radar_basis({std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)});
      matrices[view] = scattering_matrices(
          scatterer, monostatic(basis), wavenumbers, {arguments.ray_spacing_m, arguments.max_bounces}, threads, &rays, &shell.stop);
      progress.advance();
    }
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  std::string csv = fmt::format(
      "# seaglint {} rcs\n# target {} unit {}: {} facets, radius {:.6g} m\n# physical optics at every visible bounce, "
      "max_bounces {}, edges off, "
      "ray_spacing_m {:.6g}\n# amplitudes in metres, e^{{+jwt}}, phase origin at the body's origin, S_pq: q "
      "transmitted, p received; basis of CONVENTIONS.md\n"
      "frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,hh_dbsm,vv_dbsm\n",
      kVersion, arguments.target, arguments.unit, scatterer.facets().size(), scatterer.radius(), arguments.max_bounces,
      arguments.ray_spacing_m > 0 ? arguments.ray_spacing_m : default_ray_spacing(scatterer));
  for (std::size_t q = 0; q < frequencies.size(); ++q) {
    for (std::size_t view = 0; view < views; ++view) {
      const auto& s = matrices[view][q];
      csv += fmt::format("{:.9g},{:.9g},{:.9g}", frequencies[q] * 1e9, azimuths[view % azimuths.size()],
                         elevations[view / azimuths.size()]);
      for (const Complex& x : s) csv += fmt::format(",{:.9g},{:.9g}", x.real(), x.imag());
      csv += fmt::format(",{:.4f},{:.4f}\n", dbsm(s[0]), dbsm(s[3]));
    }
  }
  write_file(arguments.output, csv);
  fmt::print(stderr, "{}: {} rows, {} views in {:.2f} s ({:.2f} M rays, {:.2f} M rays/s)\n", arguments.output, rows,
             views, seconds, 1e-6 * static_cast<double>(rays),
             1e-6 * static_cast<double>(rays) / std::max(seconds, 1e-9));
}

}  // namespace

void add_rcs(CLI::App& app, Shell& shell) {
  CLI::App* command = app.add_subcommand("rcs", "Scattering matrix of a mesh at rest over frequency and aspect");
  auto arguments = std::make_shared<RcsArguments>();
  command->add_option("--target", arguments->target, "Mesh file: .glb, .gltf, .obj, .stl or .ply")->required();
  command->add_option("--unit", arguments->unit, "Unit of the mesh: m, cm, mm, km, in, ft");
  command->add_option("--frequency-ghz", arguments->frequency_ghz, "A or A:B:STEP, both ends included")->required();
  command
      ->add_option("--azimuth-deg", arguments->azimuth_deg,
                   "A or A:B:STEP; 0 = radar ahead of the bow, counter-clockwise from above")
      ->required();
  command->add_option("--elevation-deg", arguments->elevation_deg, "A or A:B:STEP; of the radar seen from the target");
  command->add_option("--edges", arguments->edges, "Edge currents; only off in this version")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_option("--max-bounces", arguments->max_bounces, "Reflections followed")->check(CLI::Range(1, 64));
  command
      ->add_option("--ray-spacing-m", arguments->ray_spacing_m,
                   "Spacing of the rays that look for facets; 0 = 0.1 or radius / 25, the smaller")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("-o,--output", arguments->output, "CSV file to write")->required();
  add_threads_option(*command, shell);
  command->footer(
      "Example:\n  seaglint rcs --target assets/icosahedral_reflector.glb --frequency-ghz 16 --azimuth-deg 0:360:0.5 "
      "--elevation-deg 2 -o rcs.csv");
  command->callback([arguments, &shell] { shell.work = [arguments, &shell] { run_rcs(*arguments, shell); }; });
}

}  // namespace seaglint
