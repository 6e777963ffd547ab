// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/nastran_frames.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "sim/core/numbers/constants.h"

namespace seaglint {

Vec3 NastranFrames::cartesian(Kind kind, const Vec3& point) {
  if (kind == Kind::kRectangular) return point;
  const double r = point.x(), theta = radians(point.y());
  if (kind == Kind::kCylindrical) return {r * std::cos(theta), r * std::sin(theta), point.z()};
  // theta from the z axis, phi about it (MSC Nastran Quick Reference Guide, CORD2S).
  const double phi = radians(point.z());
  return {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
}

void NastranFrames::add(const NastranCards& card) {
  const std::int64_t number = card.integer(2);
  const TextSource& source = card.source();
  if (number <= 0) source.fail(card.field(2), fmt::format("{} {}: must be greater than 0", card.name(), number));
  const bool is_known = card.name() == "CORD2R" || card.name() == "CORD2C" || card.name() == "CORD2S";
  if (!is_known) {
    others_.insert(number);
    return;
  }
  Frame frame;
  frame.kind = card.name() == "CORD2C"   ? Kind::kCylindrical
               : card.name() == "CORD2S" ? Kind::kSpherical
                                         : Kind::kRectangular;
  frame.reference = card.integer(3, 0);
  frame.at = card.at();
  for (int i = 0; i < 3; ++i) {
    const auto field = static_cast<std::size_t>(4 + i);
    frame.a[i] = card.real(field);
    frame.b[i] = card.real(field + 3);
    frame.c[i] = card.real(field + 6);
  }
  if (!frames_.try_emplace(number, frame).second)
    source.fail(card.field(2), fmt::format("{} {} is given twice", card.name(), number));
}

std::optional<Vec3> NastranFrames::in_base(std::int64_t system, const Vec3& point) const {
  if (system == 0) return point;
  const auto found = frames_.find(system);
  if (found == frames_.end()) return std::nullopt;
  const Frame& frame = found->second;
  return Vec3(frame.a + frame.R * cartesian(frame.kind, point));
}

// The axes of a system whose reference is resolved.
void NastranFrames::place(Frame& frame, const TextSource& source) const {
  for (Vec3* point : {&frame.a, &frame.b, &frame.c}) {
    const std::optional<Vec3> base = in_base(frame.reference, *point);
    if (!base) {
      source.fail(std::string_view(frame.at, frame.at),
                  fmt::format("coordinate system {}, which it refers to, is not given", frame.reference));
    }
    *point = *base;
  }
  const Vec3 z = frame.b - frame.a, y = z.cross(frame.c - frame.a);
  if (!(y.norm() > 1e-9 * z.norm() * (frame.c - frame.a).norm()))
    source.fail(std::string_view(frame.at, frame.at), "the three points of the coordinate system are on one line");
  frame.R.col(2) = z.normalized();
  frame.R.col(1) = y.normalized();
  frame.R.col(0) = frame.R.col(1).cross(frame.R.col(2));
  frame.is_resolved = true;
}

void NastranFrames::resolve(const TextSource& source) {
  for (auto& [number, first] : frames_) {
    std::vector<Frame*> chain;
    for (Frame* frame = &first; !frame->is_resolved;) {
      chain.push_back(frame);
      const auto next = frames_.find(frame->reference);
      if (next == frames_.end()) break;
      frame = &next->second;
      if (chain.size() > frames_.size())
        source.fail(std::string_view(first.at, first.at), fmt::format("coordinate system {} refers to itself", number));
    }
    for (; !chain.empty(); chain.pop_back()) place(*chain.back(), source);
  }
}

}  // namespace seaglint
