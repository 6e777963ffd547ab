// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Every reader of a user's file as a function of the file's bytes. It returns when the file is read or refused with an
// InputError; anything else that is thrown is a fault, as is a result that breaks the promise of the reader's header.

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"

namespace seaglint {

// Tables (sim/core/text), and what is computed from them at once.
void fuzz_numbers(const std::string& bytes);   // a number, an integer or a range of the command line
void fuzz_spectrum(const std::string& bytes);  // wave spectrum
void fuzz_hop_code(const std::string& bytes);
void fuzz_scatter(const std::string& bytes);  // scatter diagram
void fuzz_series(const std::string& bytes);   // motion: own, DualSPHysics, OpenFAST
void fuzz_sections(const std::string& bytes);
void fuzz_veres(const std::string& bytes);
void fuzz_wamit(const std::string& bytes);

// Radar cross sections.
void fuzz_rcs_cut(const std::string& bytes);    // four columns
void fuzz_own_table(const std::string& bytes);  // of `seaglint rcs`
void fuzz_named_columns(const std::string& bytes);
void fuzz_cst(const std::string& bytes);         // farfield tables
void fuzz_cst_curves(const std::string& bytes);  // 1D
void fuzz_ffs(const std::string& bytes);
void fuzz_ffe(const std::string& bytes);
void fuzz_hfss(const std::string& bytes);
void fuzz_pyaedt(const std::string& bytes);       // the HDF5 file
void fuzz_pyaedt_json(const std::string& bytes);  // the JSON beside it

// Scenarios.
void fuzz_yaml(const std::string& bytes);      // the tree alone
void fuzz_override(const std::string& bytes);  // KEY=VALUE of --set
void fuzz_material(const std::string& bytes);
void fuzz_scenario(const std::string& bytes);  // with plan and effective values

// Meshes, with their diagnosis and repair.
void fuzz_obj(const std::string& bytes);
void fuzz_stl(const std::string& bytes);
void fuzz_ply(const std::string& bytes);
void fuzz_gltf(const std::string& bytes);
void fuzz_glb(const std::string& bytes);
void fuzz_nastran(const std::string& bytes);
void fuzz_unv(const std::string& bytes);
void fuzz_gmsh(const std::string& bytes);

// Data sets.
void fuzz_manifest(const std::string& bytes);
void fuzz_shard(const std::string& bytes);
void fuzz_npz(const std::string& bytes);
void fuzz_inputs(const std::string& bytes);      // inputs.sha256
void fuzz_embeddings(const std::string& bytes);  // embeddings.csv

// Models and echoes.
void fuzz_trees(const std::string& bytes);       // handmade.json, with the probabilities of rows
void fuzz_model_card(const std::string& bytes);  // model.json
void fuzz_network(const std::string& bytes);     // network.bin, with its outputs for a map
void fuzz_echo(const std::string& bytes);        // I/Q samples over time

// What their definitions share.

// Writes the bytes into a file of this name in a folder of this process (below TMPDIR); the next call replaces it.
inline std::filesystem::path file_of(const std::string& bytes, const char* name) {
  static const TemporaryFolder folder;
  std::filesystem::path path = folder.path() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

// Calls use(); true if it threw an InputError, false if it returned.
template <class Use>
bool is_refused(Use use) {
  try {
    use();
    return false;
  } catch (const InputError& error) {
    const std::string message = error.what();
    SEAGLINT_CHECK(!message.empty(), "an InputError without a message");
    return true;
  }
}

}  // namespace seaglint
