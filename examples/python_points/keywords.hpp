// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace python_points {

namespace py = pybind11;

template <class T>
concept Keyword = std::is_arithmetic_v<T> || std::same_as<T, std::string> || std::same_as<T, std::vector<double>>;

/// Calls task(name, member) for the numbers and words among the members of a material and of its parts.
template <class Material, class Task>
void for_each_keyword(Material& material, Task const& task) {
  auto const visit = [&](auto const& self, std::string_view name, auto& member) -> void {
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (Keyword<Member>) {
      task(py::str(std::string(name)), member);
    } else if constexpr (scarp::Described<Member>) {
      Member::members(member, [&](std::string_view inner, auto& part) { self(self, inner, part); });
    }
  };
  visit(visit, "", material);
}

/// Members of a material by their names.
template <class Material>
py::dict keywords_of(Material const& material) {
  py::dict keywords;
  for_each_keyword(material, [&](py::str const& name, auto const& member) { keywords[name] = member; });
  return keywords;
}

/// \throws InputError for a value of another kind, and for keywords that the material does not have
template <class Material>
void take_keywords(py::dict given, Material& material) {
  for_each_keyword(material, [&](py::str const& name, auto& member) {
    if (!given.contains(name)) return;
    py::object value = given.attr("pop")(name);
    if (py::hasattr(value, "__fspath__")) value = value.attr("__fspath__")();
    try {
      member = value.cast<std::remove_reference_t<decltype(member)>>();
    } catch (py::cast_error const&) {
      scarp::reject("{} is {} (a value like {} is expected): correct it", std::string(name),
                    std::string(py::repr(value)), std::string(py::repr(py::cast(member))));
    }
    if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(member)>>) {
      if (std::isnan(member)) scarp::reject("{} is not a number (NaN): correct it", std::string(name));
    }
  });
  if (!given.empty()) {
    scarp::reject("there is no keyword {} (there are {}): use one of these",
                  std::string(py::str(*given.begin()->first)),
                  std::string(py::str(py::str(", ").attr("join")(keywords_of(material)))));
  }
}

/// \throws InputError for masked numbers
inline void require_unmasked(py::handle given, std::string_view what) {
  auto const masks = py::module_::import("numpy").attr("ma");
  bool const is_list =
      py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given);  // of rows, each with a mask perhaps
  if (masks.attr("is_masked")(is_list ? masks.attr("array")(given) : py::reinterpret_borrow<py::object>(given))
          .cast<bool>())
    scarp::reject("{} are masked (a mask would be lost): fill the masked numbers, or leave their points out", what);
}

/// Rows of double precision without gaps. shape: of a row
/// \throws InputError for other types and shapes
inline py::array_t<double, py::array::c_style> rows_of(py::object const& given, char const* what,
                                                       std::vector<py::ssize_t> const& shape) {
  require_unmasked(given, what);
  auto const array = given.is_none() ? py::array() : py::array::ensure(given);
  if (!array || given.is_none()) {
    PyErr_Clear();
    scarp::reject("{} are no array ({}): give a NumPy array", what, std::string(py::str(given.get_type())));
  }
  if (!array.dtype().equal(py::dtype::of<double>())) {
    scarp::reject("{} have the type {} (float64 is expected): convert them, numpy.asarray(values, dtype=float)", what,
                  std::string(py::str(array.dtype())));
  }
  std::vector<py::ssize_t> const found(array.shape(), array.shape() + array.ndim());
  if (found.empty() || std::vector(found.begin() + 1, found.end()) != shape) {
    scarp::reject("{} have the shape ({}) (expected is (n{}{})): give a row to each point", what, scarp::listed(found),
                  shape.empty() ? "" : ", ", scarp::listed(shape));
  }
  return array;
}

/// An array of a vector's memory, which it keeps: no copy. shape, strides [bytes]: of one element
template <class Number, class T>
py::array array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides) {
  auto* const kept = new std::vector<T>(std::move(values));
  py::capsule const owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  shape.insert(shape.begin(), static_cast<py::ssize_t>(kept->size()));
  strides.insert(strides.begin(), static_cast<py::ssize_t>(sizeof(T)));
  return py::array(py::dtype::of<Number>(), shape, strides, kept->data(), owner);
}

}  // namespace python_points
