// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <set>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Where each entry of each element matrix goes in the values of the global sparse matrix, found once per mesh.
/// Degrees of freedom are numbered dim * node + axis.
class Sparsity {
 public:
  /// The pattern of all pairs of degrees of freedom that share an element.
  template <class Element>
  explicit Sparsity(Mesh<Element> const& mesh) {
    constexpr int dim = Element::dim;
    build_pattern(neighbours(mesh), dim);
    addresses_.reserve(mesh.elements.size() * detail::index(Element::nodes * dim * Element::nodes * dim));
    for (auto const& element : mesh.elements) {
      for (int const column_node : element) {
        for (int k = 0; k < dim; ++k) {
          for (int const row_node : element) {
            for (int i = 0; i < dim; ++i) {
              addresses_.push_back(address(dim * row_node + i, dim * column_node + k));
            }
          }
        }
      }
    }
  }

  /// For each element its matrix's entries, column by column, as positions in the values of the global matrix.
  std::vector<int> const& addresses() const { return addresses_; }

  /// Makes `matrix` a zero matrix of this pattern; reuses its memory when it already has it.
  void reset(Eigen::SparseMatrix<double>& matrix) const {
    if (matches(matrix)) {
      matrix.coeffs().setZero();
    } else {
      matrix = pattern_;
    }
  }

 private:
  template <class Element>
  static std::vector<std::set<int>> neighbours(Mesh<Element> const& mesh) {
    std::vector<std::set<int>> of_node(mesh.nodes.size());
    for (auto const& element : mesh.elements) {
      for (int const node : element) {
        of_node[detail::index(node)].insert(element.begin(), element.end());
      }
    }
    return of_node;
  }

  void build_pattern(std::vector<std::set<int>> const& neighbours, int dim) {
    int const size = dim * detail::count(neighbours);
    pattern_.resize(size, size);
    Eigen::Index entries = 0;
    for (auto const& near : neighbours) entries += dim * dim * detail::count(near);
    pattern_.reserve(entries);
    for (int column = 0; column < size; ++column) {
      pattern_.startVec(column);
      for (int const node : neighbours[detail::index(column / dim)]) {
        for (int i = 0; i < dim; ++i) pattern_.insertBack(dim * node + i, column) = 0.0;
      }
    }
    pattern_.finalize();
  }

  int address(int row, int column) const {
    int const* const rows = pattern_.innerIndexPtr();
    int const* const first = rows + pattern_.outerIndexPtr()[column];
    int const* const end = rows + pattern_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(first, end, row) - rows);
  }

  bool matches(Eigen::SparseMatrix<double> const& matrix) const {
    auto const same = [](int const* a, int const* b, Eigen::Index length) { return std::equal(a, a + length, b); };
    return matrix.isCompressed() && matrix.rows() == pattern_.rows() && matrix.cols() == pattern_.cols() &&
           matrix.nonZeros() == pattern_.nonZeros() &&
           same(matrix.outerIndexPtr(), pattern_.outerIndexPtr(), pattern_.outerSize() + 1) &&
           same(matrix.innerIndexPtr(), pattern_.innerIndexPtr(), pattern_.nonZeros());
  }

  Eigen::SparseMatrix<double> pattern_;
  std::vector<int> addresses_;
};

}  // namespace scarp
