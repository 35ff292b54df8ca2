// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace lego_loam_sc::python {

namespace nb = nanobind;

// Arguments: any array of numbers on the CPU. Another type of number is converted first, which
// their functions say with nb::sig; an array with gaps, such as a slice of columns, is read as it
// lies.
using Points = nb::ndarray<const float, nb::shape<-1, 3>, nb::device::cpu>;
template <class Number>
using Numbers = nb::ndarray<const Number, nb::shape<-1>, nb::device::cpu>;

// Results: a view of memory that an object owns (return it with rv_policy::reference_internal).
template <class Number, nb::ssize_t... Shape>
using View = nb::ndarray<nb::numpy, const Number, nb::shape<Shape...>>;

// Hands the vector itself over to numpy; elements of `Width` numbers make an array of two
// dimensions.
template <class Number, nb::ssize_t... Width, class Element>
auto to_numpy(std::vector<Element>&& elements) {
  static_assert(sizeof(Element) == (sizeof(Number) * ... * Width));
  auto* kept = new std::vector<Element>(std::move(elements));
  nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<Element>*>(p); });
  return nb::ndarray<nb::numpy, Number, nb::shape<-1, Width...>>(
      kept->data(), {kept->size(), static_cast<std::size_t>(Width)...}, owner);
}

}  // namespace lego_loam_sc::python
