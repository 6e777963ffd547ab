// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_elements.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace seaglint {
namespace {

template <typename Number>
double component_at(const unsigned char* first, int axis, bool normalised) {
  Number value{};
  std::memcpy(&value, first + static_cast<std::size_t>(axis) * sizeof value, sizeof value);
  // glTF 2.0, section 3.6.2.2: fractions of the largest value, -1 at least.
  const auto number = static_cast<double>(value);
  return normalised ? std::max(number / static_cast<double>(std::numeric_limits<Number>::max()), -1.0) : number;
}

}  // namespace

Vec3 vector_at(const GltfElements& elements, std::size_t i) {
  if (elements.first == nullptr) return Vec3::Zero();
  const unsigned char* first = elements.first + i * elements.stride;
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    switch (elements.component) {
      case 5120: x[axis] = component_at<std::int8_t>(first, axis, elements.normalised); break;
      case 5121: x[axis] = component_at<std::uint8_t>(first, axis, elements.normalised); break;
      case 5122: x[axis] = component_at<std::int16_t>(first, axis, elements.normalised); break;
      case 5123: x[axis] = component_at<std::uint16_t>(first, axis, elements.normalised); break;
      default: x[axis] = component_at<float>(first, axis, false);
    }
  }
  return x;
}

std::optional<GltfElements> with_replaced(const GltfElements& elements, std::size_t count, const unsigned char* indices,
                                          std::size_t width, const unsigned char* values) {
  const auto own = std::make_shared<std::vector<unsigned char>>(elements.count * elements.size);
  for (std::size_t i = 0; i < elements.count && elements.first != nullptr; ++i)
    std::memcpy(own->data() + i * elements.size, elements.first + i * elements.stride, elements.size);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t index = 0;
    std::memcpy(&index, indices + i * width, width);
    if (index >= elements.count) return std::nullopt;
    std::memcpy(own->data() + index * elements.size, values + i * elements.size, elements.size);
  }
  GltfElements replaced = elements;
  replaced.first = own->data();
  replaced.stride = elements.size;
  replaced.own = own;
  return replaced;
}

}  // namespace seaglint
