// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "scarp/contact/frictionless.hpp"
#include "scarp/core/random.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "support/approx.hpp"

/// The list of near pairs and the forces that follow from it against every pair with every image.
namespace neighbours {

using scarp::Reason;
using scarp::Status;
using scarp::Tensor;
using scarp::Vector;
using scarp::Verdict;

template <class Shape>
using Smooth = scarp::Packing<Shape, scarp::Frictionless>;

/// Row, row and the lattice vector by which the second is moved; as in the list, the first is the smaller one or the
/// lattice vector's first component that is not zero is positive.
template <int Dim>
using Meeting = std::tuple<std::size_t, std::size_t, std::array<int, static_cast<std::size_t>(Dim)>>;

template <int Dim>
struct Answer {
  std::vector<Meeting<Dim>> meetings;  ///< sorted
  std::vector<Vector<Dim>> forces;     ///< on every grain
  std::vector<bool> too_deep;          ///< grains on top of others, where several directions of least overlap compete
};

/// Radius of curvature [m] at the tips of an oval, b^2/a; of a superellipse the stand-in that falls to zero at exponent
/// two.
template <class Size>
double tip_radius(Size const& size) {
  double const shorter = std::min(size[0], size[1]);
  double const exponent = size.size() > 2 ? size[size.size() - 1] : 1.0;
  return (2.0 - exponent) * shorter * shorter / std::max(size[0], size[1]);
}

/// Every pair of parts with every image within some cells; a grain's own parts do not meet.
template <class Shape>
Answer<Shape::dim> oracle(Smooth<Shape> const& packing, double reach, double stiffness) {
  constexpr int dim = Shape::dim;
  constexpr int cells = 2;  // the list looks one cell far
  constexpr std::size_t parts = scarp::part_count<Shape>();
  Answer<dim> answer;
  answer.forces.assign(packing.grain_count(), Vector<dim>::Zero());
  answer.too_deep.assign(packing.grain_count(), false);
  int images = 1;
  for (int a = 0; a < dim; ++a) images *= 2 * cells + 1;
  for (int image = 0; image < images; ++image) {
    std::array<int, dim> shift{};
    Vector<dim> offset = Vector<dim>::Zero();
    for (int a = 0, code = image; a < dim; ++a, code /= 2 * cells + 1) {
      shift[static_cast<std::size_t>(a)] = code % (2 * cells + 1) - cells;
      offset += packing.cell.col(a) * shift[static_cast<std::size_t>(a)];
    }
    bool const is_own_cell = offset.isZero(0.0);
    if (!is_own_cell && shift < std::array<int, dim>{}) continue;
    for (std::size_t i = 0; i < packing.row_count(); ++i) {
      for (std::size_t j = is_own_cell ? i + 1 : 0; j < packing.row_count(); ++j) {
        if (is_own_cell && i / parts == j / parts) continue;
        auto const from = scarp::row_position(packing, i);
        auto const to = scarp::row_position(packing, j);
        scarp::Point<dim, double> branch, start;
        double squared = 0.0;
        for (std::size_t a = 0; a < dim; ++a) branch[a] = to[a] + offset(static_cast<int>(a)) - from[a];
        for (double const component : branch) squared += component * component;
        for (std::size_t a = 0; a < dim; ++a) start[a] = branch[a] / std::sqrt(squared);
        auto const touch =
            scarp::converged_contact<Shape>(scarp::row_pose(packing, i), scarp::row_pose(packing, j), branch, start);
        if (touch.overlap < -reach) continue;
        answer.meetings.emplace_back(i, j, shift);
        if constexpr (Shape::warm_starts_normal) {
          double const shallow = 0.3 * std::min(tip_radius(packing.population->size(i / parts)),
                                                tip_radius(packing.population->size(j / parts)));
          if (touch.overlap > shallow) answer.too_deep[i / parts] = answer.too_deep[j / parts] = true;
        }
        Vector<dim> const force =
            stiffness * std::max(touch.overlap, 0.0) * Eigen::Map<Vector<dim> const>(touch.normal.data());
        answer.forces[i / parts] -= force;
        answer.forces[j / parts] += force;
      }
    }
  }
  std::sort(answer.meetings.begin(), answer.meetings.end());
  return answer;
}

/// The list, and the forces as the first step's change of velocity.
template <class Shape>
Answer<Shape::dim> listed(Smooth<Shape> packing, scarp::Frictionless const& law) {
  constexpr int dim = Shape::dim;
  Answer<dim> answer;
  auto const& pairs = packing.pairs;
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    auto const i = static_cast<std::size_t>(pairs.first[p]);
    auto j = static_cast<std::size_t>(pairs.second[p]);
    std::array<int, dim> shift{};
    if (j >= packing.row_count()) {
      auto const ghost = j - packing.row_count();
      std::copy_n(pairs.ghost_shift[ghost].begin(), dim, shift.begin());
      j = static_cast<std::size_t>(pairs.ghost_owner[ghost]);
    }
    answer.meetings.emplace_back(i, j, shift);
  }
  std::sort(answer.meetings.begin(), answer.meetings.end());
  packing.pairs.critical_step = 1e-3;
  packing.pairs.basis = scarp::list_basis(packing, law, packing.pairs.skin);  // else the list would be made anew
  scarp::TimeStepper<Smooth<Shape>> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.time_step_share = 1.0;
  scarp::StepObservation<dim> seen;
  REQUIRE(stepper.template step<scarp::Observe::balance>(packing, law, Tensor<dim>::Zero(), &seen).acceptable());
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    auto const velocity = packing.velocity.row(i);
    answer.forces.push_back(Eigen::Map<Vector<dim> const>(velocity.data()) / packing.population->inverse_mass()[i] /
                            1e-3);
  }
  return answer;
}

/// Grains of sizes from 1 to `ratio` thrown into the cell and those about it; where there is room, no two are closer
/// than a share of their bounding radii.
template <class Shape>
Smooth<Shape> heap(scarp::Random& random, std::size_t grains, double ratio, Tensor<Shape::dim> const& cell) {
  constexpr int dim = Shape::dim;
  constexpr double closest = 0.8;
  std::vector<typename scarp::Population<Shape>::Size> sizes(grains);
  for (auto& size : sizes) {
    double const length = std::pow(ratio, random.uniform());
    if constexpr (Shape::size_count == 1) {
      size = {length / Shape::bounding_radius({1.0})};
    } else {
      size[0] = length;
      size[1] = length * random.uniform(0.7, 1.0);
      if constexpr (Shape::size_count == 3) size[2] = random.uniform(0.7, 1.3);  // exponent
    }
  }
  Smooth<Shape> packing;
  packing.population = std::make_shared<scarp::Population<Shape> const>(sizes, 1.0, 1.0);
  packing.cell = cell;
  packing.position.resize(grains);
  packing.orientation.resize(grains);
  packing.rest();
  std::vector<Vector<dim>> placed;  // in lattice coordinates
  for (std::size_t i = 0; i < grains; ++i) {
    Vector<dim> place;
    bool free = false;
    for (int trial = 0; trial < 100 && !free; ++trial) {
      for (int a = 0; a < dim; ++a) place(a) = random.uniform(-1.0, 2.0);
      free = true;
      for (std::size_t j = 0; j < i && free; ++j) {
        Vector<dim> branch = place - placed[j];
        for (int a = 0; a < dim; ++a) branch(a) -= std::round(branch(a));
        free = (cell * branch).norm() > closest * (Shape::bounding_radius(sizes[i]) + Shape::bounding_radius(sizes[j]));
      }
    }
    placed.push_back(place);
    place = (cell * place).eval();
    for (int a = 0; a < dim; ++a) packing.position(i, a) = place(a);
    double const angle = random.uniform(0.0, 3.0);
    if constexpr (Shape::orientation_count == 2) packing.orientation.set_row(i, {std::cos(angle), std::sin(angle)});
  }
  return packing;
}

/// \return how many grains felt forces that were compared
template <class Shape>
int compare(Smooth<Shape> const& packing, double reach) {
  scarp::Frictionless const law{.normal_stiffness = 100.0};
  auto const expected = oracle(packing, reach, law.normal_stiffness);
  auto const found = listed(packing, law);
  CHECK(found.meetings == expected.meetings);
  double largest = 0.0;
  double worst = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < expected.forces.size(); ++i) {
    if (expected.too_deep[i] || expected.forces[i].isZero(0.0)) continue;
    ++compared;
    largest = std::max(largest, expected.forces[i].norm());
    worst = std::max(worst, (found.forces[i] - expected.forces[i]).norm());
  }
  // Round-off of places up to a hundred sizes; the last touch of a list and the first of a step differ in their start.
  CHECK(worst <= 1e-12 * largest);
  return compared;
}

template <class Shape>
void check_any_ratio_of_sizes_and_any_shear() {
  constexpr int dim = Shape::dim;
  scarp::Random random(11);
  int compared = 0;
  std::size_t met = 0;
  for (double const ratio : {1.0, 10.0, 100.0}) {
    for (double const shear : {0.0, 0.45, -0.9, 2.3}) {
      CAPTURE(ratio);
      CAPTURE(shear);
      double const reach = 0.1 * ratio;
      Tensor<dim> cell = (ratio > 1.0 ? 3.4 : 8.0) * ratio * Tensor<dim>::Identity();
      cell(0, 1) = shear * cell(0, 0);
      cell(dim - 1, 0) = 0.1 * cell(0, 0);
      auto packing = heap<Shape>(random, 30, ratio, cell);
      auto const before = packing;
      REQUIRE(scarp::rebuild_pairs(packing, 0.6 * reach, 0.4 * reach).acceptable());
      met += packing.pairs.count();
      compared += compare(packing, reach);
      // The lattice is the same one, and the places are the same ones on it.
      Tensor<dim> const change = before.cell.inverse() * packing.cell;
      CHECK((change.array() - change.array().round()).abs().maxCoeff() < 1e-12);
      CHECK(change.determinant() == samples::Approx(1.0).epsilon(1e-12));
      for (std::size_t i = 0; i < packing.grain_count(); ++i) {
        auto const from = before.position.row(i);
        auto const to = packing.position.row(i);
        Vector<dim> const cells = packing.cell.inverse() * (Eigen::Map<Vector<dim> const>(to.data()) -
                                                            Eigen::Map<Vector<dim> const>(from.data()));
        CHECK((cells.array() - cells.array().round()).abs().maxCoeff() < 1e-12);
      }
    }
  }
  CHECK(compared > 8);  // few superellipses are shallow: corners have small radii
  CHECK(met > 100);
}

template <class Shape>
void check_narrow_cells() {
  constexpr int dim = Shape::dim;
  constexpr double reach = 0.05;
  scarp::Random random(5);
  int refused = 0, compared = 0, felt = 0, met_twice = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    Tensor<dim> cell = Tensor<dim>::Identity();
    for (int a = 0; a < dim; ++a) cell(a, a) = random.uniform(1.8, 4.0);  // largest radius: 1
    cell(0, 1) = random.uniform(-1.0, 1.0);
    cell(dim - 1, 0) = random.uniform(-0.3, 0.3);
    auto packing = heap<Shape>(random, 1 + static_cast<std::size_t>(trial % 4), 1.0, cell);
    double const narrowest = 2.0 * packing.population->largest_radius() + reach;
    Tensor<dim> const reduced = cell * scarp::lattice_reduction<dim>(cell).template cast<double>();
    auto const before = packing;
    Verdict const verdict = scarp::rebuild_pairs(packing, reach);
    // A grain may meet another one on several sides, but itself only where the cell is thinner than its diameter.
    if (scarp::min_height<dim>(reduced) <= narrowest) {
      CHECK(verdict == Verdict{Status::failed, Reason::cell_collapsed});
      CHECK(packing == before);
      ++refused;
      continue;
    }
    REQUIRE(verdict.acceptable());
    felt += compare(packing, reach);
    ++compared;
    std::set<Meeting<dim>> grains_met;
    for (auto const& [i, j, shift] : listed(packing, {.normal_stiffness = 100.0}).meetings) {
      grains_met.emplace(i / scarp::part_count<Shape>(), j / scarp::part_count<Shape>(), shift);
    }
    std::set<std::pair<std::size_t, std::size_t>> couples;
    for (auto const& [i, j, shift] : grains_met) couples.emplace(i, j);
    met_twice += static_cast<int>(grains_met.size() - couples.size());
  }
  CHECK(refused > 5);
  CHECK(compared > 15);
  CHECK((felt > 10 || Shape::warm_starts_normal));
  CHECK(met_twice > 5);
}

}  // namespace neighbours

/// The test cases for the shapes that a translation unit is about.
#define NEIGHBOURS_ARE_THOSE_OF_ALL_PAIRS(...)                                                                     \
  TEST_CASE_TEMPLATE("list and forces are those of all pairs with all images at any ratio of sizes and any shear", \
                     Shape, __VA_ARGS__) {                                                                         \
    neighbours::check_any_ratio_of_sizes_and_any_shear<Shape>();                                                   \
  }                                                                                                                \
  TEST_CASE_TEMPLATE("in a cell of one to two diameters all images are found or the cell is refused", Shape,       \
                     __VA_ARGS__) {                                                                                \
    neighbours::check_narrow_cells<Shape>();                                                                       \
  }
