// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shells as solvers exchange them: nodes and elements by number, and from them the mesh.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {

// Longest name of a part, bytes.
inline constexpr std::size_t kLongestName = 1000;

// Nodes may follow the elements that name them. `at`: a position in the bytes of the file, for error messages.
class ShellModel {
 public:
  // place(at): that position as error messages name it, "FILE:LINE:COLUMN".
  ShellModel(std::string file, std::function<std::string(const char*)> place);

  [[noreturn]] void fail(const char* at, const std::string& what) const;

  // Throws InputError for a number that is negative and coordinates beyond 1e30.
  void node(std::int64_t number, const Vec3& position, const char* at);

  // Index of the part with this name; throws InputError at more than 65,000, and for a longer name than that.
  std::uint32_t part(const std::string& name, const char* at);
  // Names it otherwise.
  void rename(std::uint32_t part, const std::string& name);

  // Three or four corners, counter-clockwise seen from outside, by the numbers of their nodes. Returns the index of the
  // shell. `quadratic`: the element has further nodes, on its sides.
  std::size_t shell(std::uint32_t part, std::span<const std::int64_t> corners, bool quadratic, const char* at);
  void move_to_part(std::size_t shell, std::uint32_t part) { shells_[shell].part = part; }

  // Counts an element that is not read.
  void solid(std::string_view kind) { count(solids_, kind); }
  void other_shell(std::string_view kind) { count(others_, kind); }

  void add_finding(std::string sentence);

  // The triangles, quadrilaterals divided as polygons of other files (triangles_of_polygon()). Throws InputError for an
  // element that names a missing node, nodes given twice at different positions, and a model without shells.
  TriangleMesh mesh();

 private:
  struct Node {
    std::int64_t number;
    Vec3 position;
    const char* at;
  };
  struct Shell {
    std::size_t first;  // of its corners
    const char* at;
    std::uint32_t part;
    std::uint8_t count;
  };
  using Kinds = std::map<std::string, std::size_t, std::less<>>;

  static void count(Kinds& kinds, std::string_view kind);
  void sort_nodes();
  const Node& node_of(std::int64_t number, const char* at) const;
  void require_shells() const;
  std::vector<std::string> sentences() const;

  std::string file_;
  std::function<std::string(const char*)> place_;
  std::vector<Node> nodes_;
  std::vector<std::int64_t> corners_;  // of all shells
  std::vector<Shell> shells_;
  std::vector<std::string> part_names_;
  std::unordered_map<std::string, std::uint32_t> part_of_name_;
  std::size_t quadratic_ = 0;
  Kinds solids_, others_;
  OddPolygons odd_;
  std::vector<std::string> findings_;
};

}  // namespace seaglint
