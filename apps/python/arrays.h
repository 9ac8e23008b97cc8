// C++ memory as NumPy arrays: no byte is copied, and whoever owns the memory stays for as long as an array looks at it.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <type_traits>
#include <vector>

#include "base/math.h"
#include "grid/grid3.h"

namespace brisance::python {

namespace py = pybind11;

/// Keeps something alive for Python.
template <class T>
py::capsule keeperOf(std::shared_ptr<T> owner) {
  using Owner = std::shared_ptr<T>;
  return py::capsule(new Owner(std::move(owner)), [](void* kept) { delete static_cast<Owner*>(kept); });
}

/// An array that cannot be written, and where its memory comes from.
template <class T, class Owner>
py::array readOnly(const T* values, const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides,
                   std::shared_ptr<Owner> owner) {
  py::array array(py::dtype::of<T>(), shape, strides, values, keeperOf(std::move(owner)));
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// What one element is made of: numbers of one type, one after the other.
template <class T>
struct Numbers {
  using Type = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
  static constexpr py::ssize_t count = 1;
};
template <class T>
struct Numbers<Vec3<T>> {
  using Type = T;
  static constexpr py::ssize_t count = 3;
};
template <>
struct Numbers<Quaternion> {
  using Type = double;
  static constexpr py::ssize_t count = 4;
};
template <class T, std::size_t N>
struct Numbers<std::array<T, N>> {
  using Type = T;
  static constexpr py::ssize_t count = N;
};

/// (n) of numbers, (n, 3) of vectors, (n, 4) of quaternions w, x, y, z.
template <class Vector, class Owner>
py::array viewOf(const Vector& vector, std::shared_ptr<Owner> owner) {
  using Element = typename Vector::value_type;
  using Part = Numbers<Element>;
  static_assert(sizeof(Element) == sizeof(typename Part::Type) * Part::count);
  std::vector<py::ssize_t> shape{std::ssize(vector)}, strides{sizeof(Element)};
  if (Part::count > 1) {
    shape.push_back(Part::count);
    strides.push_back(sizeof(typename Part::Type));
  }
  return readOnly(reinterpret_cast<const typename Part::Type*>(vector.data()), shape, strides, std::move(owner));
}

/// (nx, ny, nz), indexed [i, j, k], i running fastest in memory.
template <class T, class Owner>
py::array viewOf(const Grid3<T>& grid, std::shared_ptr<Owner> owner) {
  const py::ssize_t step = sizeof(T), row = step * grid.size.x, layer = row * grid.size.y;
  return readOnly(grid.values.data(), {grid.size.x, grid.size.y, grid.size.z}, {step, row, layer}, std::move(owner));
}

/// An array that owns a vector whose memory it takes over.
template <class T>
py::array arrayOf(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
  using Number = typename Numbers<T>::Type;
  auto owner = std::make_shared<std::vector<T>>(std::move(values));
  const auto* first = reinterpret_cast<const Number*>(owner->data());
  return py::array(py::dtype::of<Number>(), shape, first, keeperOf(owner));
}

template <class T>
py::tuple tupleOf(const Vec3<T>& v) {
  return py::make_tuple(v.x, v.y, v.z);
}
inline py::tuple tupleOf(const Quaternion& q) { return py::make_tuple(q.w, q.x, q.y, q.z); }

}  // namespace brisance::python
