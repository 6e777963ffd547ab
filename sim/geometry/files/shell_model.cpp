// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/shell_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_formats.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {
namespace {

constexpr std::size_t kMaxNodes = 0x7fffffff;
constexpr std::size_t kMaxKinds = 100;  // kinds of element that have a count of their own
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

// "3 solid elements (CHEXA, CTETRA)"
std::string counted(const std::map<std::string, std::size_t, std::less<>>& kinds, const char* what) {
  std::size_t sum = 0;
  std::vector<std::string> names;
  for (const auto& [name, count] : kinds) {
    sum += count;
    if (names.size() < 4) names.push_back(name);
  }
  if (kinds.size() > names.size()) names.emplace_back("...");
  return fmt::format("{} {} element{} ({})", sum, what, sum == 1 ? "" : "s", fmt::join(names, ", "));
}

}  // namespace

ShellModel::ShellModel(std::string file, std::function<std::string(const char*)> place)
    : file_(std::move(file)), place_(std::move(place)) {}

void ShellModel::fail(const char* at, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place_(at), what));
}

void ShellModel::count(Kinds& kinds, std::string_view kind) {
  auto found = kinds.find(kind);
  if (found == kinds.end()) found = kinds.emplace(kinds.size() < kMaxKinds ? std::string(kind) : "others", 0).first;
  ++found->second;
}

void ShellModel::node(std::int64_t number, const Vec3& position, const char* at) {
  if (number < 0) fail(at, fmt::format("node {}: must be 0 or greater", number));
  if (nodes_.size() >= kMaxNodes) fail(at, "more nodes than 2147483647");
  Vec3 kept;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = coordinate_of(position[axis]);
    if (!coordinate) fail(at, fmt::format("node {} has the coordinate {}", number, position[axis]));
    kept[axis] = *coordinate;
  }
  nodes_.push_back({number, kept, at});
}

std::uint32_t ShellModel::part(const std::string& name, const char* at) {
  if (name.size() > kLongestName) fail(at, fmt::format("a name of a part of more than {} bytes", kLongestName));
  const auto [found, is_new] = part_of_name_.try_emplace(name, static_cast<std::uint32_t>(part_names_.size()));
  if (is_new) {
    if (part_names_.size() >= kMaxParts) fail(at, fmt::format("more than {} parts", kMaxParts));
    part_names_.push_back(name);
  }
  return found->second;
}

void ShellModel::rename(std::uint32_t part, const std::string& name) { part_names_[part] = name; }

std::size_t ShellModel::shell(std::uint32_t part, std::span<const std::int64_t> corners, bool quadratic,
                              const char* at) {
  shells_.push_back({corners_.size(), at, part, static_cast<std::uint8_t>(corners.size())});
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  quadratic_ += quadratic ? 1 : 0;
  return shells_.size() - 1;
}

void ShellModel::add_finding(std::string sentence) { findings_.push_back(std::move(sentence)); }

void ShellModel::sort_nodes() {
  std::stable_sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.number < b.number; });
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const Node &before = nodes_[i - 1], &node = nodes_[i];
    if (node.number == before.number && node.position != before.position)
      fail(node.at, fmt::format("node {} is given twice, at different positions", node.number));
  }
}

const ShellModel::Node& ShellModel::node_of(std::int64_t number, const char* at) const {
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), number,
                                      [](const Node& node, std::int64_t value) { return node.number < value; });
  if (found == nodes_.end() || found->number != number)
    fail(at, fmt::format("the element names node {}, which the file does not have", number));
  return *found;
}

void ShellModel::require_shells() const {
  if (!shells_.empty()) return;
  std::string found;
  if (!solids_.empty()) found = counted(solids_, "solid");
  if (!others_.empty()) found += (found.empty() ? "" : " and ") + counted(others_, "other");
  throw InputError(found.empty() ? fmt::format("{}: contains no shell elements", file_)
                                 : fmt::format("{}: contains {}, no shells that are read: export the surface as "
                                               "triangles or quadrilaterals",
                                               file_, found));
}

std::vector<std::string> ShellModel::sentences() const {
  std::vector<std::string> list = findings_;
  if (quadratic_ > 0) {
    list.push_back(fmt::format("{} element{} of higher order: read by the corners, sides are straight", quadratic_,
                               quadratic_ == 1 ? "" : "s"));
  }
  if (!solids_.empty()) list.push_back(counted(solids_, "solid") + ": not read, only shells are");
  if (!others_.empty()) list.push_back(counted(others_, "other") + ": not read");
  for (std::string& sentence : odd_.sentences()) list.push_back(std::move(sentence));
  return list;
}

TriangleMesh ShellModel::mesh() {
  require_shells();
  sort_nodes();
  MeshBuilder builder;
  std::vector<std::uint32_t> vertex_of(nodes_.size(), kUnused);
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> polygon;
  for (const Shell& shell : shells_) {
    vertices.clear();
    polygon.clear();
    for (std::size_t i = 0; i < shell.count; ++i) {
      const Node& node = node_of(corners_[shell.first + i], shell.at);
      std::uint32_t& vertex = vertex_of[static_cast<std::size_t>(&node - nodes_.data())];
      if (vertex == kUnused) vertex = builder.vertex(node.position);
      vertices.push_back(vertex);
      polygon.push_back(node.position);
    }
    builder.begin_part(part_names_[shell.part]);
    for (const auto& [i, j, k] : triangles_of_polygon(polygon, odd_, [&] { return place_(shell.at); })) {
      const std::uint32_t a = vertices[i], b = vertices[j], c = vertices[k];
      if (a != b && b != c && c != a) builder.triangle(a, b, c);
    }
  }
  TriangleMesh mesh = builder.take();
  mesh.findings = sentences();
  return mesh;
}

}  // namespace seaglint
