// SPDX-License-Identifier: BSD-3-Clause
// Run time of reading and writing a mesh against the number of its parts: the same faces in 1 and in 60,000 parts.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

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

}  // namespace
}  // namespace seaglint
