// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Coordinate systems of NASTRAN: CORD2R, CORD2C and CORD2S.

#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "sim/core/numbers/linear.h"
#include "sim/geometry/files/exchange/nastran_cards.h"

namespace seaglint {

// Systems may be given behind the nodes and the systems that refer to them.
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
