// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <filesystem>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/target_spec.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/cli/command_line.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class MeshCommand : public testing::Test {
 protected:
  // What the command prints.
  static std::string run(const std::vector<std::string>& words) {
    ProgramOptions program("test", "");
    CommandContext context;
    add_mesh(program, context);
    std::vector<const char*> argv{"test"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    const ParsedCommandLine parsed = program.parse(static_cast<int>(argv.size()), argv.data());
    if (parsed.error) throw InputError(*parsed.error);
    testing::internal::CaptureStdout();
    try {
      context.work();
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    return testing::internal::GetCapturedStdout();
  }

  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};

TEST_F(MeshCommand, CreatesEveryKindOfMesh) {
  const std::string file = (folder / "a.glb").string();
  const std::pair<std::vector<std::string>, double> kinds[] = {
      {{"plate", "--length-m", "2", "--width-m", "0.5"}, 1.0},
      {{"dihedral", "--length-m", "1", "--width-m", "0.5"}, 1.0},
      {{"trihedral", "--leg-m", "2"}, 6.0},
      {{"trihedral", "--leg-m", "2", "--square"}, 12.0},
      {{"cylinder", "--radius-m", "1", "--height-m", "1", "--segments", "4"}, 4 + 4 * std::sqrt(2.0)},
      {{"reflector", "--edge-m", "1"}, 15.0},
      {{"sphere", "--radius-m", "1", "--subdivisions", "0"}, 9.57454},
  };
  for (const auto& [kind, area] : kinds) {
    std::vector<std::string> words{"mesh", "make"};
    words.insert(words.end(), kind.begin(), kind.end());
    words.insert(words.end(), {"-o", file});
    EXPECT_HAS(run(words), "triangles") << kind[0];
    // float32 positions: 6e-8 of each coordinate, a dozen coordinates.
    EXPECT_NEAR(surface_area(read_mesh(file)), area, 1e-5) << kind[0];
  }
  run({"mesh", "make", "ship", "--length-m", "120", "--detail", "hull", "-o", file});
  EXPECT_NEAR(bounds(read_mesh(file)).upper.x(), 60, 0.01);
}

TEST_F(MeshCommand, MakesDecoysOfEveryKindWithTheirImperfections) {
  const std::string file = (folder / "a.glb").string();
  for (const char* kind : kDecoyKindNames) {
    EXPECT_HAS(run({"mesh", "make", "decoy", "--kind", kind, "-o", file}), "triangles") << kind;
    if (kind == std::string("luneburg_lens")) continue;
    EXPECT_HAS(run({"mesh",
                    "make",
                    "decoy",
                    "--kind",
                    kind,
                    "--leg-m",
                    "0.5",
                    "--seed",
                    "7",
                    "--angle-error-deg",
                    "0.5",
                    "--surface-error-mm",
                    "1",
                    "--rounding-mm",
                    "20",
                    "--inflatable",
                    "--missing-panels",
                    "1",
                    "--dented-panels",
                    "1",
                    "--dent-depth",
                    "0.1",
                    "--support",
                    "raft",
                    "--mast-m",
                    "1.2",
                    "--tether-m",
                    "3",
                    "-o",
                    file}),
               "triangles")
        << kind;
    EXPECT_HAS(run({"mesh", "info", file}), "mast") << kind;
  }
  run({"mesh", "make", "decoy", "--kind", "octahedral", "--panel", "circular", "--pose", "point_up", "--frame-mm", "10",
       "--support", "float", "--float-shape", "sphere", "--float-m", "0.5", "-o", file});
  run({"mesh", "make", "decoy", "--kind", "trihedral_cluster", "--cells", "4", "--boresight-elevation-deg", "10", "-o",
       file});
  run({"mesh", "make", "decoy", "--kind", "trihedral", "--seam-errors-deg", "0,0,1", "-o", file});
  run({"mesh", "make", "decoy", "--kind", "luneburg_lens", "--leg-m", "0.15", "--cap-half-angle-deg", "60",
       "--lens-loss-db", "0.5", "--boresight-elevation-deg", "10", "--support", "float", "-o", file});
  EXPECT_HAS(run({"mesh", "info", file}), "luneburg_lens_0.5dB");
  EXPECT_HAS(refusal_of([&] {
               run({"mesh", "make", "decoy", "--kind", "sphere", "-o", file});
             }),
             "{icosahedral,octahedral,trihedral_cluster,trihedral,dihedral,luneburg_lens}");
  EXPECT_HAS(refusal_of([&] { run({"mesh", "make", "decoy", "--panel", "square", "-o", file}); }), "octahedral");
}

TEST_F(MeshCommand, ReportsTheContentsOfAFileInItsUnit) {
  const std::string file = (folder / "plate.stl").string(), picture = (folder / "plate.png").string();
  write_mesh(file, make_plate(1000, 500));
  const std::string text = run({"mesh", "info", file, "--unit", "mm", "--picture", picture, "--width", "64"});
  EXPECT_HAS(text, "size       0 x 1 x 0.5 m");
  EXPECT_HAS(text, "triangles  2, vertices 4, area 0.5 m^2");
  EXPECT_HAS(text, "4 boundary");
  EXPECT_HAS(text, "4 free edges");
  EXPECT_THAT(read_file(picture), testing::StartsWith("\x89PNG"));
}

TEST_F(MeshCommand, RefusesWrongInput) {
  EXPECT_THROW(run({"mesh", "info", (folder / "absent.glb").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "--length-m", "-1", "-o", (folder / "a.glb").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "-o", (folder / "a.txt").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "-o", (folder / "no" / "a.glb").string()}), WorkError);
  EXPECT_THROW(run({"mesh", "make", "ship"}), InputError);
  EXPECT_THROW(run({"mesh", "make", "boat", "-o", "a.glb"}), InputError);
}

}  // namespace
}  // namespace seaglint
