// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/glb_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/text/json_keys.h"
#include "sim/core/text/json_problem.h"
#include "sim/core/text/shown.h"

namespace seaglint {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

void put_word(std::string& bytes, std::uint32_t value) {
  char raw[4];
  std::memcpy(raw, &value, 4);
  bytes.append(raw, 4);
}

std::size_t entries_of(const nlohmann::json& object, const char* list) {
  if (!object.is_object()) return 0;
  const auto found = object.find(list);
  return found == object.end() || !found->is_array() ? 0 : found->size();
}

// Entries of the lists of which a model is made. Each takes about 1 kB of memory however short it is.
std::size_t entry_count(const nlohmann::json& root) {
  std::size_t count = 0;
  for (const char* list : {"buffers", "bufferViews", "accessors", "materials", "meshes", "nodes", "scenes"})
    count += entries_of(root, list);
  for (const auto& [list, entries] : {std::pair{"meshes", "primitives"}, {"nodes", "children"}, {"scenes", "nodes"}}) {
    if (entries_of(root, list) == 0) continue;
    for (const nlohmann::json& item : root[list]) count += entries_of(item, entries);
  }
  return count;
}

// Extensions, or beginnings of their names, that leave positions and faces as they are.
constexpr std::string_view kHarmless[] = {
    "KHR_materials_", "KHR_texture_",  "KHR_lights_",      "KHR_xmp",           "KHR_animation_pointer",
    "EXT_texture_",   "EXT_lights_",   "EXT_materials_",   "EXT_mesh_features", "EXT_structural_metadata",
    "MSFT_texture_",  "MSFT_packing_", "ADOBE_materials_", "NV_materials_",     "KHR_mesh_quantization"};

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

// glTF 2.0, section 4.4: 12 bytes of header, then chunks of length, type, data.
GlbChunks glb_chunks(std::string_view bytes, const std::string& file) {
  if (!is_glb(bytes)) return {bytes, {}};
  const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); };
  if (bytes.size() < 20) fail(fmt::format("is cut short: {} bytes are no .glb", bytes.size()));
  if (word(bytes, 4) != 2) fail(fmt::format("is .glb version {}, not 2", word(bytes, 4)));
  if (word(bytes, 8) > bytes.size())
    fail(fmt::format("is cut short: its header promises {} bytes, it has {}", word(bytes, 8), bytes.size()));
  GlbChunks chunks;
  std::size_t at = 12;
  const std::size_t end = word(bytes, 8);
  for (int n = 0; at + 8 <= end; ++n) {
    const std::uint32_t size = word(bytes, at), type = word(bytes, at + 4);
    if (size > end - at - 8) fail(fmt::format("chunk {} promises {} bytes, {} are left", n, size, end - at - 8));
    if (n == 0 && type != kJsonChunk) fail("the first chunk is not JSON");
    if (n == 0) chunks.json = bytes.substr(at + 8, size);
    if (n == 1 && type == kBinaryChunk) chunks.binary = bytes.substr(at + 8, size);
    at += 8 + std::size_t{size};
  }
  return chunks;
}

std::string glb_of(std::string json, std::string_view binary_data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary(binary_data);
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string file = "glTF";
  put_word(file, 2);
  put_word(file, static_cast<std::uint32_t>(12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size())));
  put_word(file, static_cast<std::uint32_t>(json.size()));
  put_word(file, kJsonChunk);
  file += json;
  if (!binary.empty()) {
    put_word(file, static_cast<std::uint32_t>(binary.size()));
    put_word(file, kBinaryChunk);
    file += binary;
  }
  return file;
}

nlohmann::json parsed_gltf(std::string_view text, const std::string& file) {
  check_json(text, file);
  try {
    nlohmann::json root = nlohmann::json::parse(text.begin(), text.end());
    constexpr std::size_t kFewest = 100'000, kBytes = 64;  // each part of a mesh has about ten entries of 650 bytes
    if (const std::size_t count = entry_count(root); count > kFewest + text.size() / kBytes)
      throw InputError(
          fmt::format("{}: {} nodes, meshes and accessors in {} bytes are no mesh", file, count, text.size()));
    return root;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file, json_problem(error)));
  }
}

void refuse_required_extensions(const nlohmann::json& root, const std::string& file) {
  const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); };
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) fail("extensionsRequired is not a list");
  for (const nlohmann::json& name : *required) {
    const std::string extension = name.is_string() ? name.get<std::string>() : "?";
    const bool harmless = std::any_of(std::begin(kHarmless), std::end(kHarmless),
                                      [&](std::string_view begin) { return extension.starts_with(begin); });
    if (harmless) continue;
    const bool compressed = extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression";
    fail(fmt::format("needs the extension {}, which is not supported{}", shown(extension),
                     compressed ? ": decompress the mesh, for example by `gltf-transform copy`" : ""));
  }
}

}  // namespace seaglint
