// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

std::uint32_t word(std::string_view bytes, std::size_t at) { return number_at<std::uint32_t>(bytes.data() + at); }

void put_word(std::string& bytes, std::size_t value) { append_number(bytes, static_cast<std::uint32_t>(value)); }

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

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  // empty: no binary chunk
};

// The chunks of a .glb (glTF 2.0, section 4.4: 12 bytes of header, then chunks of length, type, data); any other text
// is one JSON chunk.
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

// A .glb of these chunks, each padded to a multiple of 4 bytes.
std::string glb_of(std::string json, std::string_view binary_data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary(binary_data);
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string file = "glTF";
  put_word(file, 2);
  put_word(file, 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  put_word(file, json.size());
  put_word(file, kJsonChunk);
  file += json;
  if (!binary.empty()) {
    put_word(file, binary.size());
    put_word(file, kBinaryChunk);
    file += binary;
  }
  return file;
}

// Throws for a text that is no JSON, is nested too deeply, has a key twice in an object, or more entries of nodes,
// meshes and accessors than a mesh of its size.
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

// Throws for a required extension on which the geometry depends and which is not read. Those of materials, textures,
// lights and metadata are no part of the geometry; KHR_mesh_quantization is read.
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

using Json = nlohmann::json;

constexpr std::uint64_t kMaxBufferBytes = std::uint64_t{1} << 30;  // of one buffer
constexpr std::uint64_t kMaxZeros = 1'000'000;                     // elements of a sparse accessor without other data

// glTF 2.0, section 3.6.2.2: bytes of a component; 0 for another type.
std::uint64_t component_size(std::uint64_t type) {
  constexpr std::array<std::uint64_t, 7> kBytes{1, 1, 2, 2, 0, 4, 4};
  return type >= 5120 && type <= 5126 ? kBytes[type - 5120] : 0;
}

constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

bool is_equal(std::string_view a, std::string_view b) { return lower_case(a) == lower_case(b); }  // but for case

bool is_data_uri(std::string_view uri) { return is_equal(uri.substr(0, 5), "data:"); }

// The text without blanks and line ends, with %2B, %2F and %3D as + / =, padded with = to a multiple of four.
std::string base64_digits(std::string_view text) {
  std::string digits;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isspace(static_cast<unsigned char>(text[i]))) continue;
    char digit = text[i];
    for (const auto& [code, meaning] : {std::pair{"%2b", '+'}, {"%2f", '/'}, {"%3d", '='}}) {
      if (digit != '%' || !is_equal(text.substr(i, 3), code)) continue;
      digit = meaning;
      i += 2;
    }
    digits += digit;
  }
  while (digits.size() % 4 != 0) digits += '=';
  return digits;
}

class Checker {
 public:
  Checker(const Json& root, const std::string& file, std::uint64_t binary_size)
      : root_(root), file_(file), binary_size_(binary_size) {}

  Json reduced() const {
    if (!root_.is_object()) fail("is not a JSON object");
    const auto asset = root_.find("asset");
    if (asset == root_.end() || !asset->is_object() || text(*asset, "version").substr(0, 2) != "2.") {
      fail("is not glTF 2 (asset.version)");
    }
    if (asset->contains("minVersion") && text(*asset, "minVersion").substr(0, 2) != "2.")
      fail("needs more than glTF 2 (asset.minVersion)");
    refuse_required_extensions(root_, file_);
    Json plain = {{"asset", {{"version", "2.0"}}}};
    plain["buffers"] = each("buffers", [&](const Json& b, const std::string& at) { return buffer(b, at); });
    plain["bufferViews"] = each("bufferViews", [&](const Json& v, const std::string& at) { return view(v, at); });
    plain["accessors"] = each("accessors", [&](const Json& a, const std::string& at) { return accessor(a, at); });
    plain["materials"] = each("materials", [&](const Json& m, const std::string&) {
      return Json{{"name", text(m, "name")}};
    });
    plain["meshes"] = each("meshes", [&](const Json& m, const std::string& at) { return mesh(m, at); });
    plain["nodes"] = each("nodes", [&](const Json& n, const std::string& at) { return node(n, at); });
    plain["scenes"] = each("scenes", [&](const Json& s, const std::string& at) {
      return Json{{"nodes", index_list(s, "nodes", "nodes", at)}};
    });
    if (root_.contains("scene")) plain["scene"] = index(root_, "scene", "scenes", "the file");
    // tinygltf rejects empty lists.
    for (const char* name : {"buffers", "bufferViews", "accessors", "materials", "meshes", "nodes", "scenes"}) {
      if (plain[name].empty()) plain.erase(name);
    }
    return plain;
  }

  // Of a file that reduced() accepts.
  std::vector<std::string> findings() const {
    const auto meshes = root_.find("meshes");
    const auto count = meshes == root_.end() ? 0 : std::ranges::count_if(*meshes, has_morph_targets);
    if (count == 0) return {};
    return {fmt::format("{} morph targets (shape keys) of weight 0: read in the base shape",
                        count == 1 ? "1 mesh has" : fmt::format("{} meshes have", count))};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", file_, what)); }

  // The objects of a list, reduced; empty without the list. of_owner: begins their place in messages.
  template <typename Reduce>
  Json each(const char* name, Reduce reduce) const {
    return each(root_, name, "", reduce);
  }
  template <typename Reduce>
  Json each(const Json& owner, const char* name, const std::string& of_owner, Reduce reduce) const {
    Json list = Json::array();
    const auto found = owner.find(name);
    if (found == owner.end()) return list;
    if (!found->is_array()) fail(fmt::format("{}{} is not a list", of_owner, name));
    for (std::size_t i = 0; i < found->size(); ++i) {
      const std::string at = fmt::format("{}{}[{}]", of_owner, name, i);
      if (!(*found)[i].is_object()) fail(at + " is not an object");
      list.push_back(reduce((*found)[i], at));
    }
    return list;
  }

  std::size_t length(const char* name) const {
    const auto found = root_.find(name);
    return found == root_.end() || !found->is_array() ? 0 : found->size();
  }

  std::string text(const Json& object, const char* key) const {
    const auto found = object.find(key);
    return found == object.end() || !found->is_string() ? std::string() : found->get<std::string>();
  }

  std::uint64_t whole(const Json& value, const std::string& what) const {
    if (value.is_number_unsigned()) return value.get<std::uint64_t>();
    // Some exporters write 3.0 for 3.
    if (value.is_number_float()) {
      const double number = value.get<double>();
      if (number >= 0 && number < 9e15 && number == std::floor(number)) return static_cast<std::uint64_t>(number);
    }
    fail(fmt::format("{} is not a whole number of at least 0", what));
  }

  std::uint64_t whole(const Json& object, const char* key, const std::string& at, std::uint64_t fallback) const {
    const auto found = object.find(key);
    return found == object.end() ? fallback : whole(*found, fmt::format("{}.{}", at, key));
  }

  std::uint64_t index_value(const Json& value, const char* list, const std::string& what) const {
    const std::uint64_t i = whole(value, what);
    if (i >= length(list)) fail(fmt::format("{} = {} is outside {}, which has {}", what, i, list, length(list)));
    return i;
  }

  std::uint64_t index(const Json& object, const char* key, const char* list, const std::string& at) const {
    const auto found = object.find(key);
    if (found == object.end()) fail(fmt::format("{} has no {}", at, key));
    return index_value(*found, list, fmt::format("{}.{}", at, key));
  }

  Json index_list(const Json& object, const char* key, const char* list, const std::string& at) const {
    Json indices = Json::array();
    const auto found = object.find(key);
    if (found == object.end()) return indices;
    if (!found->is_array()) fail(fmt::format("{}.{} is not a list", at, key));
    for (const Json& value : *found) indices.push_back(index_value(value, list, fmt::format("{}.{}", at, key)));
    return indices;
  }

  std::uint64_t buffer_size(std::uint64_t i) const {
    return whole(root_["buffers"][i], "byteLength", fmt::format("buffers[{}]", i), 0);
  }

  Json buffer(const Json& b, const std::string& at) const {
    const std::uint64_t size = whole(b, "byteLength", at, 0);
    if (size == 0) fail(at + " is empty");
    if (size > kMaxBufferBytes) fail(fmt::format("{}.byteLength = {} is above {}", at, size, kMaxBufferBytes));
    Json plain{{"byteLength", size}};
    const std::string uri = text(b, "uri");
    if (is_data_uri(uri)) {
      plain["uri"] = "data:application/octet-stream;base64," + base64_of(uri, size, at);
    } else if (!uri.empty()) {
      plain["uri"] = uri;
    } else if (at != "buffers[0]" || size > binary_size_) {
      fail(fmt::format("{}.byteLength = {} but the file's binary chunk contains {} bytes", at, size,
                       at == "buffers[0]" ? binary_size_ : 0));
    }
    return plain;
  }

  // The digits of a data URI, data:[type][;parameter ...];base64,DIGITS, that encode `size` bytes: three in four
  // digits.
  std::string base64_of(std::string_view uri, std::uint64_t size, const std::string& at) const {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) fail(at + ".uri is a data URI without a comma");
    constexpr std::string_view kBase64 = ";base64";
    const std::string_view head = uri.substr(0, comma);
    if (head.size() < kBase64.size() || !is_equal(head.substr(head.size() - kBase64.size()), kBase64))
      fail(at + ".uri is a data URI other than base64, which is not supported");
    const std::string digits = base64_digits(uri.substr(comma + 1));
    const std::size_t end = std::min(digits.find_first_not_of(kBase64Digits), digits.size());
    if (digits.find_first_not_of('=', end) != std::string::npos)
      fail(fmt::format("{}.uri: digit {} of its base64 is none", at, end + 1));
    const std::uint64_t bytes = end / 4 * 3 + (end % 4 == 0 ? 0 : end % 4 - 1);
    if (bytes != size) fail(fmt::format("{}.byteLength = {} but its data URI has {} bytes", at, size, bytes));
    return digits;
  }

  Json view(const Json& v, const std::string& at) const {
    const std::uint64_t buffer = index(v, "buffer", "buffers", at);
    const std::uint64_t offset = whole(v, "byteOffset", at, 0), size = whole(v, "byteLength", at, 0);
    const std::uint64_t stride = whole(v, "byteStride", at, 0), available = buffer_size(buffer);
    if (size == 0) fail(at + " is empty");
    if (offset > available || size > available - offset) {
      fail(fmt::format("{} wants bytes {} to {} of buffers[{}], which has {}", at, offset, offset + size, buffer,
                       available));
    }
    if (stride != 0 && (stride < 4 || stride > 252 || stride % 4 != 0)) {
      fail(fmt::format("{}.byteStride = {} is not a multiple of 4 in 4..252", at, stride));
    }
    Json plain{{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", size}};
    if (stride != 0) plain["byteStride"] = stride;
    return plain;
  }

  Json accessor(const Json& a, const std::string& at) const {
    const std::uint64_t type = whole(a, "componentType", at, 0), size = component_size(type);
    const std::uint64_t count = whole(a, "count", at, 0), offset = whole(a, "byteOffset", at, 0);
    const std::string shape = text(a, "type");
    constexpr std::pair<std::string_view, std::uint64_t> kShapes[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    std::uint64_t components = 0;
    for (const auto& [name, n] : kShapes) components = shape == name ? n : components;
    if (size == 0) fail(fmt::format("{}.componentType = {} is unknown", at, type));
    if (components == 0) fail(fmt::format("{}.type = \"{}\" is unknown", at, shape));
    if (count == 0) fail(at + " is empty");
    Json plain{{"componentType", type}, {"count", count}, {"type", shape}, {"byteOffset", offset}};
    if (const auto normalised = a.find("normalized"); normalised != a.end() && normalised->is_boolean())
      plain["normalized"] = *normalised;
    if (a.contains("sparse")) plain["sparse"] = sparse(a["sparse"], count, size * components, at + ".sparse");
    // An accessor without a view is all zeros; without sparse values it is rejected where a mesh uses it.
    if (a.contains("bufferView")) {
      plain["bufferView"] = checked_view(a, count, size * components, at);
    } else {
      if (count > kMaxZeros && a.contains("sparse")) fail(fmt::format("{}.count = {} without data", at, count));
      plain["byteOffset"] = 0;
    }
    return plain;
  }

  // The view of `count` elements of so many bytes, which contains all of them.
  std::uint64_t checked_view(const Json& a, std::uint64_t count, std::uint64_t element, const std::string& at) const {
    const std::uint64_t i = index(a, "bufferView", "bufferViews", at), offset = whole(a, "byteOffset", at, 0);
    const std::string view_name = fmt::format("bufferViews[{}]", i);
    const Json& v = root_["bufferViews"][i];
    const std::uint64_t stride = std::max(element, whole(v, "byteStride", view_name, 0));
    const std::uint64_t available = whole(v, "byteLength", view_name, 0);
    if (count > kMaxBufferBytes || offset > available || (count - 1) * stride + element > available - offset) {
      fail(fmt::format("{} wants {} elements of {} bytes from byte {} of {}, which has {}", at, count, stride, offset,
                       view_name, available));
    }
    return i;
  }

  // Values that replace those of an accessor (glTF 2.0, section 3.6.2.3).
  Json sparse(const Json& s, std::uint64_t elements, std::uint64_t element, const std::string& at) const {
    if (!s.is_object() || !s.contains("indices") || !s.contains("values") || !s["indices"].is_object() ||
        !s["values"].is_object()) {
      fail(at + " has no indices and values");
    }
    const std::uint64_t count = whole(s, "count", at, 0), type = whole(s["indices"], "componentType", at, 0);
    if (count == 0 || count > elements)
      fail(fmt::format("{}.count = {}: must be within 1 and {}", at, count, elements));
    if (type != 5121 && type != 5123 && type != 5125) fail(fmt::format("{}.indices are not unsigned", at));
    const std::uint64_t indices = checked_view(s["indices"], count, component_size(type), at + ".indices"),
                        values = checked_view(s["values"], count, element, at + ".values");
    return {
        {"count", count},
        {"indices",
         {{"bufferView", indices}, {"byteOffset", whole(s["indices"], "byteOffset", at, 0)}, {"componentType", type}}},
        {"values", {{"bufferView", values}, {"byteOffset", whole(s["values"], "byteOffset", at, 0)}}}};
  }

  void check_use(std::uint64_t i, const std::string& at, const char* use) const {
    const Json& a = root_["accessors"][i];
    if (!a.contains("bufferView") && !a.contains("sparse"))
      fail(fmt::format("{}: accessors[{}] ({}) has no data", at, i, use));
  }

  // glTF 2.0, section 3.7.2.1: triangles have three vertices each; strips and fans have one triangle per vertex after
  // the second.
  void check_corners(const Json& plain, std::uint64_t mode, const std::string& at) const {
    const bool indexed = plain.contains("indices");
    const auto accessor = (indexed ? plain["indices"] : plain["attributes"]["POSITION"]).get<std::uint64_t>();
    const std::uint64_t count = whole(root_["accessors"][accessor], "count", at, 0);
    const char* what = indexed ? "indices" : "vertices without indices";
    if (mode == 4 && count % 3 != 0) fail(fmt::format("{}: {} {} are no whole number of triangles", at, count, what));
    if (count < 3) fail(fmt::format("{}: {} {} make no triangle", at, count, what));
  }

  // Floats, or integers as KHR_mesh_quantization allows them: of positions any of 8 and 16 bits, of normals signed and
  // normalised ones.
  bool is_vector(const Json& a, bool normal) const {
    const std::uint64_t type = whole(a, "componentType", "accessor", 0);
    const auto normalised = a.find("normalized");
    const bool fraction = normalised != a.end() && normalised->is_boolean() && normalised->get<bool>();
    const bool quantised = normal ? (type == 5120 || type == 5122) && fraction : type >= 5120 && type <= 5123;
    return text(a, "type") == "VEC3" && (type == 5126 || (quantised && uses("KHR_mesh_quantization")));
  }

  bool uses(const char* extension) const {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      const auto found = root_.find(list);
      if (found != root_.end() && std::count(found->begin(), found->end(), extension) > 0) return true;
    }
    return false;
  }

  // True where NORMAL is an accessor of vectors with data, one per position. Any other is left out: normals never
  // refuse a mesh.
  bool has_normals(const Json& attributes, std::uint64_t position) const {
    const auto found = attributes.find("NORMAL");
    if (found == attributes.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() >= length("accessors"))
      return false;
    const Json &a = root_["accessors"][found->get<std::uint64_t>()], &positions = root_["accessors"][position];
    return (a.contains("bufferView") || a.contains("sparse")) && is_vector(a, true) &&
           whole(a, "count", "NORMAL", 0) == whole(positions, "count", "POSITION", 0);
  }

  Json primitive(const Json& p, const std::string& at) const {
    const std::uint64_t mode = whole(p, "mode", at, 4);
    if (mode > 6) fail(fmt::format("{}.mode = {} is unknown", at, mode));
    const auto attributes = p.find("attributes");
    if (attributes == p.end() || !attributes->is_object()) fail(at + " has no attributes");
    const std::uint64_t position = index(*attributes, "POSITION", "accessors", at + ".attributes");
    Json plain{{"mode", mode}, {"attributes", {{"POSITION", position}}}};
    const bool is_surface = mode >= 4;
    if (is_surface) {
      check_use(position, at, "POSITION");
      if (!is_vector(root_["accessors"][position], false))
        fail(fmt::format("{}: accessors[{}] (POSITION) is not VEC3 of float or of quantised integers", at, position));
    }
    if (is_surface && has_normals(*attributes, position)) plain["attributes"]["NORMAL"] = (*attributes)["NORMAL"];
    if (p.contains("indices")) {
      const std::uint64_t indices = index(p, "indices", "accessors", at);
      if (is_surface) {
        check_use(indices, at, "indices");
        const Json& a = root_["accessors"][indices];
        const std::uint64_t type = whole(a, "componentType", at, 0);
        if (text(a, "type") != "SCALAR" || (type != 5121 && type != 5123 && type != 5125)) {
          fail(fmt::format("{}: accessors[{}] (indices) is not an unsigned SCALAR", at, indices));
        }
      }
      plain["indices"] = indices;
    }
    if (is_surface) check_corners(plain, mode, at);
    if (p.contains("material")) plain["material"] = index(p, "material", "materials", at);
    return plain;
  }

  Json mesh(const Json& m, const std::string& at) const {
    const auto reduce = [&](const Json& p, const std::string& here) { return primitive(p, here); };
    const Json list = each(m, "primitives", at + ".", reduce);
    if (list.empty()) fail(at + " has no primitives");
    return Json{{"name", text(m, "name")}, {"primitives", list}};
  }

  static bool has_morph_targets(const Json& m) {
    return std::ranges::any_of(m["primitives"], [](const Json& p) { return p.contains("targets"); });
  }

  // glTF 2.0, section 3.7.2.2: the weights of a node replace those of its mesh, and are 0 by default.
  void check_weights(const Json& n, const std::string& at) const {
    const std::uint64_t i = index(n, "mesh", "meshes", at);
    const Json& m = root_["meshes"][i];
    if (!has_morph_targets(m)) return;
    const Json& owner = n.contains("weights") ? n : m;
    const auto weights = owner.find("weights");
    const bool at_rest = weights == owner.end() ||
                         (weights->is_array() && std::ranges::all_of(*weights, [](const Json& w) { return w == 0; }));
    if (!at_rest) {
      fail(
          fmt::format("{}: meshes[{}] has morph targets with weights other than 0, which are not supported: bake the "
                      "shape into the positions",
                      at, i));
    }
  }

  void copy_numbers(const Json& from, Json& to, const char* key, std::size_t count, const std::string& at) const {
    const auto found = from.find(key);
    if (found == from.end()) return;
    bool good = found->is_array() && found->size() == count;
    for (std::size_t i = 0; good && i < count; ++i)
      good = (*found)[i].is_number() && std::isfinite((*found)[i].get<double>());
    if (!good) fail(fmt::format("{}.{} is not a list of {} numbers", at, key, count));
    to[key] = *found;
  }

  // glTF 2.0, section 3.5.3: one affine matrix, or translation, rotation and scale.
  void check_transform(const Json& plain, const std::string& at) const {
    constexpr double kRounding = 1e-6;  // of a matrix stored in float32
    if (plain.contains("matrix")) {
      for (const char* key : {"translation", "rotation", "scale"}) {
        if (plain.contains(key)) fail(fmt::format("{} has a matrix and a {}: only one of them may place it", at, key));
      }
      for (std::size_t column = 0; column < 4; ++column) {
        const double last = plain["matrix"][4 * column + 3].get<double>();
        if (std::abs(last - (column == 3 ? 1 : 0)) > kRounding)
          fail(fmt::format("{}.matrix has {} in its last row, which must be 0 0 0 1", at, last));
      }
    }
    double norm = 1;
    if (plain.contains("rotation")) {
      norm = 0;
      for (const Json& q : plain["rotation"]) norm = std::hypot(norm, q.get<double>());
    }
    if (norm < kRounding) fail(fmt::format("{}.rotation is zero, no quaternion of a rotation", at));
  }

  Json node(const Json& n, const std::string& at) const {
    Json plain{{"name", text(n, "name")}};
    // These would displace or deform the mesh.
    if (n.contains("skin")) fail(at + " has a skin, which is not supported: bake the pose into the positions");
    const auto extensions = n.find("extensions");
    if (extensions != n.end() && extensions->contains("EXT_mesh_gpu_instancing"))
      fail(at + " has instances (EXT_mesh_gpu_instancing), which are not supported: make them nodes");
    if (n.contains("children")) {
      Json children = index_list(n, "children", "nodes", at);
      if (!children.empty()) plain["children"] = children;
    }
    if (n.contains("mesh")) {
      plain["mesh"] = index(n, "mesh", "meshes", at);
      check_weights(n, at);
    }
    for (const auto& [key, count] : {std::pair{"matrix", 16u}, {"translation", 3u}, {"rotation", 4u}, {"scale", 3u}})
      copy_numbers(n, plain, key, count, at);
    check_transform(plain, at);
    return plain;
  }

  const Json& root_;
  const std::string& file_;
  std::uint64_t binary_size_;
};

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

SanitisedGltf sanitised_gltf(std::string_view bytes, const std::string& file) {
  const GlbChunks chunks = glb_chunks(bytes, file);
  const Json root = parsed_gltf(chunks.json, file);
  SanitisedGltf plain;
  try {
    const Checker checker(root, file, chunks.binary.size());
    plain.bytes = checker.reduced().dump();
    plain.findings = checker.findings();
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: {}", file, json_problem(error)));
  }
  if (is_glb(bytes)) plain.bytes = glb_of(std::move(plain.bytes), chunks.binary);
  return plain;
}

}  // namespace seaglint
