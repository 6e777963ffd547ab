// SPDX-License-Identifier: BSD-3-Clause
// Writes files that this program makes itself as seeds: DIRECTORY/{manifest,shard,npz,glb,...}/...
#include <fmt/format.h>

#include <complex>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "classify/dataset/format/shard.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

fs::path seed(const fs::path& root, const char* reader, const char* name) {
  make_directory(root / reader);
  return root / reader / name;
}

Shard small_shard(bool complex) {
  Shard shard{{"0.1.0", "processor"}, {{0, 1, 2}, {0, 0.5}}, {}};
  for (int i = 0; i < 2; ++i) {
    Sample sample;
    sample.record.sample = i;
    sample.record.target_name = "ship";
    sample.magnitude.assign(shard.axes.cells(), 1.0f);
    if (complex) sample.complex_values.assign(2 * shard.axes.cells(), 0.5f);
    sample.hop_code = {0, 1, 2, 3};
    sample.centre_list = {{1, 0.5, 2}};
    sample.record.centres = 1;
    shard.samples.push_back(sample);
  }
  return shard;
}

// A tetrahedron of two parts, one with another material.
TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.triangle_part = {0, 0, 1, 1};
  mesh.triangle_material = {0, 0, 1, 1};
  mesh.part_names = {"bottom", "top"};
  mesh.materials = {Material{}, Material{"grp"}};
  return mesh;
}

// Two headings and two frequencies, shortened from tests/reference/ship_motion/s175_veres.re1 (source and licence:
// SOURCE.md there).
std::string veres() {
  std::string text = R"( MOTION TRANSFER FUNCTIONS  - VERES Version  4.02.3
 Run name:
 Ship name: S175
 Loading condition description: Design waterline

 ShipX exported data
  0.1025E+04  0.981E+01
  0.1750E+03  0.254E+02  0.95E+01
  0.2547E+01  0.955E+01
     1     2     2     6
  0.0000E+00  0.0000E+00  0.0000E+00   2.547       9.550
)";
  for (const auto& [heading, from, along] : {std::tuple{"0.00", "-", " "}, {"180.00", " ", "-"}})
    text += fmt::format(
        "     {}\n  0.1047198\n  1 {}0.43E-02 {}0.99E+00\n  2  0.34E-06  0.20E-07\n  3  0.99E+00  0.66E-05\n"
        "  4  0.21E-08 -0.14E-09\n  5 {}0.46E-05 {}0.11E-02\n  6 -0.12E-07  0.16E-08\n"
        "  0.2094395\n  1 {}0.16E-01 {}0.96E+00\n  2  0.55E-07 -0.11E-06\n  3  0.98E+00 -0.22E-02\n"
        "  4  0.63E-08 -0.18E-08\n  5 {}0.90E-04 {}0.45E-02\n  6  0.32E-09 -0.14E-08\n",
        heading, from, from, along, along, from, from, along, along);
  return text;
}

// Two periods and two headings.
std::string wamit() {
  std::string rows;
  for (const char* at : {"0.11E+01  0.0E+00", "0.11E+01  0.9E+02", "0.12E+02  0.0E+00", "0.12E+02  0.9E+02"})
    for (const char* mode : {"1  5.0E-01  6.0E+01  2.5E-01  4.33E-01", "2  0.0E+00  9.0E+01  0.0E+00  0.0E+00",
                             "3  1.0E+00  0.0E+00  1.0E+00  0.0E+00", "4  0.0E+00  9.0E+01  0.0E+00  0.0E+00",
                             "5  1.0E-02 -9.0E+01  0.0E+00 -1.0E-02", "6  0.0E+00  9.0E+01  0.0E+00  0.0E+00"})
      rows += fmt::format("  {}  {}\n", at, mode);
  return rows;
}

const char* const kOpenFast = R"(
Predictions were generated on 01-Jan-2026 by OpenFAST.

Description: raft

Time	PtfmSurge	PtfmSway	PtfmHeave	PtfmRoll	PtfmPitch	PtfmYaw
(s)	(m)	(m)	(m)	(deg)	(deg)	(deg)
0.0000	0.1	0.2	0.3	1.0	2.0	3.0
0.0250	0.1	0.2	0.3	1.5	2.5	3.5
0.0500	0.1	0.2	0.3	2.0	2.0	3.0
0.0750	0.1	0.2	0.3	2.5	1.5	2.5
)";

const char* const kOwnCut = R"(# seaglint 0.1.0
# transmitter_azimuth_deg=20 transmitter_elevation_deg=3
frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hh_dbsm
10000000000,0,0,0.5,-0.25,-5.05
10000000000,1,0,1,0,0
)";

const char* const kEmbeddings = R"(sample,label,target,group,sea_state,mwr,ccf,sigma_r_m,sigma_v_mps,e0,logit
0,1,ship,0,0,0.1,0.2,0.3,0.4,0.5,0.6
1,0,array,0,0,0.1,0.2,0.3,0.4,0.5,0.6
2,1,ship,1,0,0.1,0.2,0.3,0.4,0.5,0.6
)";

// One tree with one split.
const char* const kTrees = R"({"learner": {"attributes": {}, "feature_names": [], "feature_types": [],
"gradient_booster": {"model": {
"gbtree_model_param": {"num_parallel_tree": "1", "num_trees": "1", "size_leaf_vector": "0"}, "tree_info": [0],
"trees": [{"base_weights": [0.2, -0.1, 0.1], "categories": [], "categories_nodes": [], "categories_segments": [],
"categories_sizes": [], "default_left": [0, 0, 0], "id": 0, "left_children": [1, -1, -1], "loss_changes": [12, 0, 0],
"parents": [2147483647, 0, 0], "right_children": [2, -1, -1], "split_conditions": [0.3, -0.1, 0.1],
"split_indices": [1, 0, 0], "split_type": [0, 0, 0], "sum_hessian": [4.5, 2, 2.5],
"tree_param": {"num_deleted": "0", "num_feature": "2", "num_nodes": "3", "size_leaf_vector": "0"}}]}, "name": "gbtree"},
"learner_model_param": {"base_score": "5E-1", "boost_from_average": "1", "num_class": "0", "num_feature": "2",
"num_target": "1"}, "objective": {"name": "binary:logistic", "reg_loss_param": {"scale_pos_weight": "1"}}},
"version": [1, 7, 4]})";

const char* const kModelCard = R"({"format": "seaglint model 1", "program_version": "0.1.0", "seed": 3,
"classes": ["array", "ship"], "features": ["mwr"], "embedding": ["lambda_1", "logit"],
"grid": {"range_m": {"cells": 256, "first": -95.9, "last": 95.2},
"velocity_mps": {"cells": 16, "first": -4.7, "last": 4.1}},
"settings": {"features": {"max_centres": "64"}, "learning": {"split.by": "sea", "epochs": "2"},
"map": {"range_span_m": "192"}},
"data_sets": [{"scenario": "points", "scenario_sha256": "02b9", "seed": 3, "samples": 32}],
"division": "split by sea realisation", "train_rows": 24,
"feature_ranges": [{"name": "mwr", "units": "(m/s)^2", "lowest": 0, "highest": 7.6, "undefined_in_some": false,
"quantiles_5_50_95": {"array": [0, 0, 0], "ship": [2, null, 6.9]}}],
"condition_ranges": [{"name": "azimuth_deg", "units": "deg", "lowest": null, "highest": null,
"undefined_in_some": true, "quantiles_5_50_95": {"array": [0, 0, 0], "ship": [1, 2, 3]}}],
"sha256": {"network.bin": "0f"}})";

// Two pulses of a measured interval.
void write_echo(const fs::path& file) {
  constexpr std::size_t kPulses = 2, kSamples = 66;  // 50 MHz by steps of 25 MHz / 33
  std::vector<double> time_s;
  for (std::size_t k = 0; k < kSamples; ++k) time_s.push_back((static_cast<double>(k) - 32.5) / 50e6);
  const auto array = [](const char* name, const char* type, const std::vector<std::uint64_t>& shape,
                        const auto& values) {
    return npz_array(name, type, shape, bytes_of_values(std::span(values)));
  };
  write_npz(
      file,
      {array("echo", "<c8", {kPulses, kSamples}, std::vector<std::complex<float>>(kPulses * kSamples, 1.0f)),
       array("time_s", "<f8", {kSamples}, time_s), array("pulse_time_s", "<f8", {kPulses}, std::vector{0.0, 250e-6}),
       array("carrier_hz", "<f8", {kPulses}, std::vector{16e9, 16.025e9}),
       array("hop_code", "<i8", {kPulses}, std::vector<std::int64_t>{0, 1})},
      {{"scenario.yaml",
        "seaglint: 1\nradar: {pulses: 2, pulse_width_us: 1.2}\n"
        "targets: {p: {label: 0, points: [{position_m: [0, 0, 0]}]}}\n"},
       {"description.json", R"({"columns": {"label": 1, "target_name": "ferry", "scr_peak_cell_db": null}})"}});
}

// Of one training step on two maps.
void write_network(const fs::path& file, std::size_t classes) {
  const std::vector<CentreList> maps{{{-40, -0.1, 1}, {40, 0.1, 1}}, {{-40, 0.1, 1}, {40, 0.2, 1}}};
  const std::vector<std::size_t> rows{0, 1};
  const std::vector<int> labels{0, 1};
  LearningSpec spec;
  spec.epochs = spec.embedding_size = 1;
  Network::train(maps, {rows, {}}, labels, spec, 1, 0, nullptr, classes).save(file);
}

void write_texts(const fs::path& root) {
  write_file(seed(root, "veres", "small.re1"), veres());
  write_file(seed(root, "wamit", "small.4"), wamit());
  write_file(seed(root, "series", "openfast.out"), kOpenFast);
  write_file(seed(root, "own_table", "own.csv"), kOwnCut);
  write_file(seed(root, "embeddings", "embeddings.csv"), kEmbeddings);
  write_file(seed(root, "trees", "trees.json"), kTrees);
  write_file(seed(root, "model_card", "model.json"), kModelCard);
  write_file(seed(root, "hop_code", "code.txt"), "# carriers\n0, 5, 3, 15\n1;2\t7 8\n");
  write_file(seed(root, "numbers", "range"), "0.1:1.5:0.1");
  write_file(seed(root, "numbers", "list"), "1,2.5e-3,-4D+2");
  write_file(seed(root, "override", "list"), "view.azimuth_deg=10:170:10");
  write_file(seed(root, "override", "layout"), "targets.ship.layout={line: {count: 4, spacing_m: 40}}");
}

void write_seeds(const fs::path& root) {
  write_texts(root);
  write_shard(seed(root, "shard", "plain.h5"), small_shard(false), 4);
  write_shard(seed(root, "shard", "complex.h5"), small_shard(true), 4);
  const Manifest manifest{"quick",
                          std::string(64, 'a'),
                          "0.1.0",
                          {"processor"},
                          1,
                          2,
                          2,
                          3,
                          {{"shard_00000.h5", 0, 2, std::string(64, 'b')}}};
  write_file(seed(root, "manifest", "manifest.json"), to_json(manifest));
  write_npz(seed(root, "npz", "data.npz"), {npz_array("samples/label", "<i8", {2}, std::string(16, '\0'))},
            {{"description.json", "{\"manifest_sha256\": \"0\"}"}});
  write_echo(seed(root, "echo", "echo.npz"));
  write_network(seed(root, "network", "two.bin"), 2);
  write_network(seed(root, "network", "three.bin"), 3);
  write_mesh(seed(root, "glb", "tetrahedron.glb"), tetrahedron());
  write_mesh(seed(root, "gltf", "tetrahedron.gltf"), tetrahedron());
  write_mesh(seed(root, "ply", "tetrahedron.ply"), tetrahedron());
  write_mesh(seed(root, "stl", "tetrahedron.stl"), tetrahedron());
  write_mesh(seed(root, "obj", "tetrahedron.obj"), tetrahedron());
}

}  // namespace
}  // namespace seaglint

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "use: fuzz_seeds DIRECTORY\n");
    return 2;
  }
  seaglint::write_seeds(argv[1]);
  return 0;
}
