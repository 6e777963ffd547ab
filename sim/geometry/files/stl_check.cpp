// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/stl_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <unordered_map>

#include "sim/core/process/error.h"
#include "sim/core/text/utf8.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

constexpr std::size_t kHeader = 84,
                      kFacet = 50;  // bytes: 80 of comment and the count; normal, three vertices, attribute

// Header, count, then facets of a normal and three vertices as little-endian float32; no trailing bytes.
SanitisedPolygons check_binary(std::string bytes, const std::string& file) {
  if (bytes.size() < kHeader)
    throw InputError(fmt::format("{}: {} bytes are no binary STL, which begins with 84", file, bytes.size()));
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  const std::size_t available = (bytes.size() - kHeader) / kFacet;
  if (count > available)
    throw InputError(fmt::format("{}: promises {} triangles, contains {}", file, count, available));
  const std::size_t end = kHeader + kFacet * count;
  if (bytes.size() > end)
    throw InputError(fmt::format("{}: promises {} triangles, which end at byte {}; {} bytes are left over", file, count,
                                 end, bytes.size() - end));
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      char* at = bytes.data() + kHeader + t * kFacet + 12 + 4 * i;
      float value = 0;
      std::memcpy(&value, at, 4);
      const auto coordinate = coordinate_of(value);
      if (!coordinate) throw InputError(fmt::format("{}: triangle {} has the coordinate {}", file, t, value));
      std::memcpy(at, &*coordinate, 4);
    }
  }
  SanitisedPolygons plain;
  plain.bytes = std::move(bytes);
  plain.binary = true;
  plain.triangle_count = count;
  return plain;
}

class AsciiStl {
 public:
  AsciiStl(std::string_view bytes, const std::string& file) : bytes_(bytes), rest_(bytes), file_(file) {}

  SanitisedPolygons check() {
    for (std::string word = lower_word(); !word.empty(); word = lower_word()) {
      if (word == "solid") {
        begin_solid();
      } else if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        next_line(rest_);
      } else {
        fail(fmt::format("\"{}\" where facet or endsolid belongs", word.substr(0, 40)));
      }
    }
    return std::move(plain_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = std::count(bytes_.begin(), bytes_.end() - static_cast<std::ptrdiff_t>(rest_.size()), '\n') + 1;
    throw InputError(fmt::format("{}:{}: {}", file_, line, what));
  }

  std::string lower_word() {
    std::string word(next_word(rest_));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }

  void expect(const char* word) {
    const std::string found = lower_word();
    if (found != word) fail(fmt::format("\"{}\" where {} belongs", found.substr(0, 40), word));
  }

  void begin_solid() {
    std::string_view line = next_line(rest_);
    std::string name;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      if (!name.empty()) name += ' ';
      name += word;
    }
    name = name.empty() ? "body" : utf8_of(name);
    auto& names = plain_.part_names;
    const auto [place, is_new] = part_of_name_.try_emplace(name, names.size());
    if (is_new && names.size() > 65000) fail("more than 65000 solids");
    if (is_new) names.push_back(name);
    part_ = static_cast<std::uint16_t>(place->second);
  }

  float coordinate() {
    const std::string_view word = next_word(rest_);
    const auto number = number_of(word);
    const auto value = number ? coordinate_of(*number) : std::nullopt;
    if (!value) fail(fmt::format("\"{}\" is not a coordinate", word.substr(0, 40)));
    return *value;
  }

  void facet() {
    expect("normal");
    // The normal is ignored: it follows from the vertices, and some exporters write nan for slivers.
    for (int i = 0; i < 3; ++i) next_word(rest_);
    expect("outer");
    expect("loop");
    std::array<std::array<float, 3>, 3> corners{};
    for (auto& corner : corners) {
      expect("vertex");
      for (float& value : corner) value = coordinate();
    }
    expect("endloop");
    expect("endfacet");
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    plain_.bytes += "outer loop\n";
    for (const auto& p : corners)
      fmt::format_to(std::back_inserter(plain_.bytes), "vertex {} {} {}\n", p[0], p[1], p[2]);
    ++plain_.triangle_count;
    plain_.triangle_part.push_back(part_);
  }

  std::string_view bytes_;
  std::string_view rest_;
  const std::string& file_;
  SanitisedPolygons plain_;
  std::unordered_map<std::string, std::size_t> part_of_name_;
  std::uint16_t part_ = 0;
};

}  // namespace

SanitisedPolygons sanitised_stl(std::string bytes, const std::string& file) {
  // Binary files may also begin with "solid": then their size decides.
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + 80, 4);
  const bool has_binary_size = bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * std::size_t{count};
  std::string_view start = bytes;
  const std::string_view word = next_word(start);
  const bool says_solid = word.size() == 5 && (word == "solid" || word == "SOLID" || word == "Solid");
  if (has_binary_size || !says_solid) return check_binary(std::move(bytes), file);
  return AsciiStl(bytes, file).check();
}

}  // namespace seaglint
