// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vectors as NumPy arrays without a copy.

#include <pybind11/numpy.h>

#include <memory>
#include <utility>
#include <vector>

namespace seaglint {

// The array owns the values; their number is the product of the shape.
template <class T>
pybind11::array_t<T> array_of(std::vector<T>&& values, std::vector<pybind11::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owned->data();
  const pybind11::capsule owner(owned.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

template <class T>
pybind11::array_t<T> array_of(std::vector<T>&& values) {
  const auto count = static_cast<pybind11::ssize_t>(values.size());
  return array_of(std::move(values), {count});
}

template <class T>
pybind11::array_t<T> copy_of(const std::vector<T>& values) {
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

}  // namespace seaglint
