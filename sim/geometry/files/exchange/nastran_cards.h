// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// NASTRAN bulk data: cards in small (8 columns), large (16 columns) and free field, with their continuation lines (MSC
// Nastran Quick Reference Guide, "Bulk Data Entries"), and the coordinate systems that they define.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/text/text_source.h"

namespace seaglint {

class NastranCards {
 public:
  // Begins behind BEGIN BULK, or with the first line where there is none. Throws InputError for BEGIN SUPER.
  explicit NastranCards(TextSource source);

  // Moves to the next card; false at its end, which is ENDDATA or the end of the text. Throws InputError for a
  // continuation line without a card, one with the label of another card, and more fields than a line can have.
  bool next();

  const std::string& name() const { return name_; }  // upper case, without the * of large fields
  const char* at() const { return line_.data(); }    // first line of the card
  const std::vector<std::string_view>& comments() const { return comments_; }  // in front of the card, from their $

  // Field i of the card, its name being field 1, without blanks; fields 10, 20, ... (labels) are not counted: the first
  // field of the second line is 10. Empty beyond the last and beyond field kMostFields.
  std::string_view field(std::size_t i) const;
  bool has(std::size_t i) const { return !field(i).empty(); }
  // Throws InputError for anything but an integer or, where there is a fallback, nothing.
  std::int64_t integer(std::size_t i, std::optional<std::int64_t> fallback = std::nullopt) const;
  // A real, also as "1.5-3"; 0 of an empty field. Throws InputError for anything else.
  double real(std::size_t i) const;

  bool has_begin() const { return has_begin_; }
  bool has_end() const { return name_ == "ENDDATA"; }
  std::string_view rest() const { return rest_; }
  const TextSource& source() const { return source_; }

 private:
  struct Line;
  Line split(std::string_view line) const;
  void begin();
  bool next_content(std::string_view& line);
  void add(const Line& line);

  static constexpr std::size_t kMostFields = 33;  // of four lines

  TextSource source_;
  std::string_view rest_;
  std::string_view line_;
  std::string name_;
  std::vector<std::string_view> fields_;  // the name, then the others
  std::vector<std::string_view> comments_, comments_after_;
  bool has_begin_ = false;
};

// A number as NASTRAN writes it: "1.5", "1.5E-3", "1.5D-3", "1.5-3".
std::optional<double> parse_nastran_real(std::string_view text);

// Coordinate systems CORD2R, CORD2C and CORD2S. Systems may be given behind the nodes and the systems that refer to
// them.
class NastranFrames {
 public:
  // Reads a card CORD...; throws InputError for a number that is not positive, given twice, or three points on a line.
  void add(const NastranCards& card);

  // Replaces references by the base system; throws InputError for one that refers to itself or to a missing system.
  void resolve(const TextSource& source);

  // A point (x, y, z; r, theta in deg, z; or r, theta, phi in deg) in the base system; nullopt for an unknown system.
  // System 0 is the base system.
  std::optional<Vec3> in_base(std::int64_t system, const Vec3& point) const;

  // Whether a card CORD1R, CORD1C, CORD1S, CORD3G with this number has been added: these are not read.
  bool is_of_other_kind(std::int64_t system) const { return others_.contains(system); }

 private:
  enum class Kind { kRectangular, kCylindrical, kSpherical };
  struct Frame {
    Kind kind = Kind::kRectangular;
    std::int64_t reference = 0;
    Vec3 a, b, c;  // origin, point on the z axis, point in the half-plane of x and z
    const char* at = nullptr;
    Mat3 R = Mat3::Identity();  // axes in the base system, columns
    bool is_resolved = false;
  };
  static Vec3 cartesian(Kind kind, const Vec3& point);
  void place(Frame& frame, const TextSource& source) const;

  std::map<std::int64_t, Frame> frames_;
  std::set<std::int64_t> others_;
};

}  // namespace seaglint
