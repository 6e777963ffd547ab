// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/file.h"
#include "sim/field_export/field_export.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/files/mesh_io.h"
#include "tests/temporary_folder.h"
#include "tools/compare/comparison.h"
#include "tools/compare/comparison_text.h"

namespace seaglint {
namespace {

// Run time of reading and writing a mesh against the number of its parts: the same faces in 1 and in 60,000 parts.

void MeshWithManyParts(benchmark::State& state) {
  const TemporaryFolder folder;
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (const char* face : {"f 1 2 3\n", "f 1 2 4\n"}) {
    for (int i = 0; i < 60000; ++i) obj += fmt::format("g part_number_{}\n{}", i % state.range(0), face);
  }
  write_file(folder.path() / "parts.obj", obj);
  for (auto _ : state) write_mesh(folder.path() / "parts.glb", read_mesh(folder.path() / "parts.obj"));
}
BENCHMARK(MeshWithManyParts)->Arg(1)->Arg(60000)->Unit(benchmark::kMillisecond);

// Speed of reading exports in bytes per second, and of comparing two of them.

// A point 0.5 m ahead of the origin: 1,000 azimuths at 201 frequencies, vv and hv.
std::vector<RcsCut> cuts() {
  std::vector<RcsCut> both(2);
  both[0].element = Polarisation::kVv;
  both[1].element = Polarisation::kHv;
  for (RcsCut& cut : both) {
    cut.transmitter = DeclaredTransmitter{};
    for (int f = 0; f < 201; ++f) {
      for (int a = 0; a < 1000; ++a) {
        const double frequency_hz = 9e9 + 5e6 * f, azimuth_deg = 0.36 * a;
        const double phase = 4 * kPi * frequency_hz / kSpeedOfLight * 0.5 * std::cos(radians(azimuth_deg));
        cut.values.push_back({frequency_hz, 90, azimuth_deg, 10.99, std::polar(1.0, phase), 0});
      }
    }
  }
  return both;
}

std::string own_text() {
  std::string text = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,vv_re,vv_im\n";
  const std::vector<RcsCut> both = cuts();
  for (const FieldValue& v : both[0].values)
    text += fmt::format("{:.9g},{:.9g},0,{:.9g},{:.9g}\n", v.frequency_hz, v.phi_deg, v.amplitude_m->real(),
                        v.amplitude_m->imag());
  return text;
}

void read(benchmark::State& state, const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  write_file(folder.path() / name, text);
  for (auto _ : state) benchmark::DoNotOptimize(read_field_table(folder.path() / name, {}));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
}

void ReadOwnTable(benchmark::State& state) { read(state, "own.csv", own_text()); }
void ReadFekoTable(benchmark::State& state) { read(state, "v.ffe", feko_text(cuts(), true)); }

// Pairs, fit, statistics and rows of compare.csv.
void CompareTables(benchmark::State& state) {
  const TemporaryFolder folder;
  write_file(folder.path() / "own.csv", own_text());
  const FieldTable table = read_field_table(folder.path() / "own.csv", {});
  for (auto _ : state) {
    const std::vector<ExportComparison> comparisons{compare_with_table(table, table, {}, 1)};
    benchmark::DoNotOptimize(comparison_csv(comparisons, 1));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(table.cuts[0].values.size()));
}

BENCHMARK(ReadOwnTable)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadFekoTable)->Unit(benchmark::kMillisecond);
BENCHMARK(CompareTables)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seaglint
