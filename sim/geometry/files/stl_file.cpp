// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/stl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/utf8.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/polygons/coordinate.h"
#include "sim/geometry/files/stl_soup.h"
#include "sim/geometry/mesh/mesh_builder.h"

namespace seaglint {
namespace {

constexpr std::size_t kHeader = 84,
                      kFacet = 50;  // bytes: 80 of comment and the count; normal, three vertices, attribute

constexpr std::size_t kMaxSolids = 65000;

std::uint32_t count_in(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + 80, 4);
  return count;
}

// Whether bytes behind the last triangle hold geometry: further triangles where the count is wrong, or a second file.
bool are_triangles(std::string_view left) {
  const bool is_file =
      left.size() >= kHeader + kFacet && count_in(left) > 0 && count_in(left) <= (left.size() - kHeader) / kFacet;
  return left.size() % kFacet == 0 || is_file;
}

// Header, count, then facets of a normal and three vertices as little-endian float32. Other bytes behind them are a
// finding.
TriangleMesh read_binary(std::string bytes, const std::string& file) {
  if (bytes.size() < kHeader)
    throw InputError(fmt::format("{}: {} bytes are no binary STL, which begins with 84", file, bytes.size()));
  const std::uint32_t count = count_in(bytes);
  const std::size_t available = (bytes.size() - kHeader) / kFacet;
  if (count > available)
    throw InputError(fmt::format("{}: promises {} triangles, contains {}", file, count, available));
  const std::size_t end = kHeader + kFacet * count;
  const std::string_view left = std::string_view(bytes).substr(end);
  std::vector<std::string> findings;
  if (!left.empty()) {
    if (are_triangles(left))
      throw InputError(fmt::format("{}: promises {} triangles, which end at byte {}; {} bytes are left over", file,
                                   count, end, left.size()));
    findings.push_back(fmt::format("{} {} left over behind the last of {} triangles: not read", left.size(),
                                   left.size() == 1 ? "byte is" : "bytes are", count));
    bytes.resize(end);
  }
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      char* at = bytes.data() + kHeader + t * kFacet + 12 + 4 * i;
      float value = 0;
      std::memcpy(&value, at, 4);
      const auto coordinate = coordinate_of(value);
      if (!coordinate) throw InputError(fmt::format("{}: triangle {} has the coordinate {}", file, t, value));
      value = static_cast<float>(*coordinate) + 0.0f;  // turns -0 into +0
      std::memcpy(at, &value, 4);
    }
  }
  TriangleMesh mesh = read_stl_soup(bytes, count, file);
  mesh.findings.insert(mesh.findings.end(), findings.begin(), findings.end());
  return mesh;
}

class AsciiStl {
 public:
  AsciiStl(std::string text, const std::string& file) : text_(std::move(text)), rest_(text_), file_(file) {}

  TriangleMesh read() {
    for (std::string word = keyword(); !word.empty(); word = keyword()) {
      if (word == "solid") {
        begin_solid();
      } else if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        next_line(rest_);
        in_solid_ = false;
      } else {
        fail(fmt::format("\"{}\" where facet or endsolid belongs", shown(word)));
      }
    }
    if (in_solid_) fail("ends without endsolid: the file is cut off");
    return builder_.take();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = std::count(text_.begin(), text_.end() - static_cast<std::ptrdiff_t>(rest_.size()), '\n') + 1;
    throw InputError(fmt::format("{}:{}: {}", file_, line, what));
  }

  std::string lower_word() {
    std::string word(next_word(rest_));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }

  // The next keyword in lower case; "end loop" is endloop.
  std::string keyword() {
    const std::string word = lower_word();
    return word == "end" ? word + lower_word() : word;
  }

  void expect(const char* word) {
    const std::string found = keyword();
    if (found != word) fail(fmt::format("\"{}\" where {} belongs", shown(found), word));
  }

  void begin_solid() {
    if (in_solid_) fail("solid where endsolid belongs");
    in_solid_ = true;
    std::string_view line = next_line(rest_);
    std::string name;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      if (!name.empty()) name += ' ';
      name += word;
    }
    solid_ = name.empty() ? "body" : utf8_of(name);
  }

  double coordinate() {
    const std::string_view word = next_word(rest_);
    const auto number = parse_any_number(word);
    const auto value = number ? coordinate_of(*number) : std::nullopt;
    if (!value) fail(fmt::format("\"{}\" is not a coordinate", shown(word)));
    return *value;
  }

  void facet() {
    expect("normal");
    // The normal is ignored: it follows from the vertices, and some exporters write nan for slivers.
    for (int i = 0; i < 3; ++i) next_word(rest_);
    expect("outer");
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("vertex");
      for (double& value : corner) value = coordinate();
    }
    expect("endloop");
    expect("endfacet");
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    builder_.begin_part(solid_);
    if (builder_.part_count() > kMaxSolids) fail(fmt::format("more than {} solids", kMaxSolids));
    const std::uint32_t a = builder_.vertex(corners[0]), b = builder_.vertex(corners[1]),
                        c = builder_.vertex(corners[2]);
    builder_.triangle(a, b, c);
  }

  const std::string text_;
  std::string_view rest_;
  const std::string& file_;
  MeshBuilder builder_;
  std::string solid_ = "body";
  bool in_solid_ = false;
};

// "solid" comes first, behind a byte order mark perhaps; no text has bytes such as 0 at its beginning.
bool is_text(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf", kSolid = "solid";
  std::string_view start = bytes;
  if (start.starts_with(kMark)) start.remove_prefix(kMark.size());
  const std::string_view word = next_word(start);
  const bool says_solid =
      std::ranges::equal(word, kSolid, [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
  const std::string_view head = bytes.substr(0, 512);
  const bool has_other_bytes = std::any_of(head.begin(), head.end(), [](char c) {
    return (c >= 0 && c < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f') || c == 0x7f;
  });
  return says_solid && !has_other_bytes;
}

}  // namespace

TriangleMesh read_stl(std::string bytes, const std::string& file) {
  // Binary files may also begin with "solid": then their size decides.
  const bool has_binary_size =
      bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * std::size_t{count_in(bytes)};
  if (!has_binary_size && is_text(bytes)) return AsciiStl(plain_lines(std::move(bytes)), file).read();
  return read_binary(std::move(bytes), file);
}

}  // namespace seaglint
