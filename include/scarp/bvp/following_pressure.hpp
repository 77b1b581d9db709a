// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <array>
#include <vector>

#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/facet_chain.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/element/line.hpp"

namespace scarp {

/// A constant pressure on facets of a plane mesh's outline, body on their left. It stays normal to them and grows with
/// them, as that of a fluid behind a membrane:
/// \f$ f_a = -p\,t \int N_a\,(y', -x')\,d\xi = -p\,t \sum_b G_{ab}\,(y_b, -x_b),\; G_{ab} = \int N_a N_b'\,d\xi \f$
/// Linear in the positions of the nodes and exact for facets that are parabolas. Its stiffness is not
/// symmetric where a loaded part ends.
template <ReferenceCell FacetType = Line2>
  requires(FacetType::dim == 1)
class FollowingPressure {
 public:
  using Facet = std::array<int, FacetType::nodes>;  ///< nodes of a facet, body on the left

  /// pressure [Pa], positive pushes inwards; thickness [m]
  /// \throws InputError for a pressure that is not finite, a thickness that is not positive, no facets or one twice
  FollowingPressure(std::vector<Facet> facets, double pressure, double thickness = 1.0)
      : facets_(std::move(facets)), thickness_(thickness) {
    detail::require_facets("a following pressure", facets_);
    require_finite("pressure", pressure);
    require_positive("thickness", thickness);
    for (auto const& where : FacetType::quadrature()) {
      coupling_ += pressure * thickness * where.weight * FacetType::shape(where.xi) *
                   FacetType::shape_gradients(where.xi).transpose();
    }
  }

  static int extra_dofs() { return 0; }
  double thickness() const { return thickness_; }  ///< [m]

  /// \throws InputError for facets of nodes that the mesh has not
  Verdict add_forces(std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment,
                     Eigen::VectorXd& forces) const {
    detail::require_nodes("a following pressure", facets_, nodes.size());
    for (auto const& facet : facets_) {
      for_each_pair(facet, [&](int at, int of, double per_length) {
        Vector<2> const place = nodes[detail::index(of)] + increment.segment<2>(2 * of);
        forces.segment<2>(2 * at) += per_length * Vector<2>(place.y(), -place.x());
      });
    }
    return {};
  }

  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    for (auto const& facet : facets_) {
      for_each_pair(facet, [&](int at, int of, double per_length) {
        entries.emplace_back(2 * at, 2 * of + 1, per_length);
        entries.emplace_back(2 * at + 1, 2 * of, -per_length);
      });
    }
  }

  static void commit(std::vector<Vector<2>> const&, Eigen::VectorXd const&) {}
  SCARP_MEMBERS_EXCEPT((facets_, thickness_, coupling_))  // nothing evolves

 private:
  template <class Visit>
  void for_each_pair(Facet const& facet, Visit const& visit) const {
    for (int a = 0; a < FacetType::nodes; ++a) {
      for (int b = 0; b < FacetType::nodes; ++b)
        visit(facet[detail::index(a)], facet[detail::index(b)], coupling_(a, b));
    }
  }

  std::vector<Facet> facets_;
  double thickness_;
  Eigen::Matrix<double, FacetType::nodes, FacetType::nodes> coupling_ =
      Eigen::Matrix<double, FacetType::nodes, FacetType::nodes>::Zero();  ///< \f$ p\,t\,G \f$ [N/m]
};

static_assert(Attachment<FollowingPressure<>, 2>);

}  // namespace scarp
