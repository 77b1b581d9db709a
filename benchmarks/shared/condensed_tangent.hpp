// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/tensor/voigt.hpp"
#include "sliding_springs.hpp"

namespace benchmarks {

/// What a present stress adds to the change of Cauchy's stress with strain, because branches and volume change while
/// the forces stay: \f$ d\sigma = \sigma\varepsilon - \sigma\,tr\,\varepsilon \f$ (symmetric part). [Pa], not symmetric
template <int Dim>
scarp::VoigtTangent<Dim> initial_stress_tangent(scarp::Tensor<Dim> const& stress) {
  scarp::VoigtTangent<Dim> tangent;
  for (int k = 0; k < scarp::voigt_size<Dim>; ++k) {
    scarp::Tensor<Dim> const strain = scarp::unit_strain<Dim>(k);
    tangent.col(k) = scarp::to_voigt_stress<Dim, double>(stress * strain - stress * strain.trace());
  }
  return tangent;
}

/// Uniform strain relaxed by the packing's own stiffness: centres and spins follow until no grain has a net force,
/// \f$ C = \frac1V (\sum M^T S M - A_l^T K^{-1} A),\; K = \sum B^T S B,\; A = \sum B^T S M,\; A_l = \sum B^T S^T M \f$
/// with a contact's spring S, its relative motion M in each strain mode and B in the motions of both grains (arms from
/// the centres to the contact), plus the terms of the present stress, 8 % of C_xxyy at a stress of 0.7 % of the
/// stiffness. That forces turn with their contacts is left out: 0.2 % there (docs/theory/homogenisation.md).
/// Spins are scaled by a length, so that K is in N/m throughout. Grains without contact are left out; rigid
/// translations, spins of smooth discs and grains on a single contact are held by `regularisation`, which changes other
/// motions by its own order only, because the forces A lie in the range of a symmetric K.
struct CondensedTangent {
  SlidingSprings sliding{};      ///< stiffness of contacts at their shear limit
  double regularisation = 1e-9;  ///< spring to the ground of every motion, over the mean k_n
  bool initial_stress = true;    ///< with the terms of the present stress; never in the fallback
  scarp::TangentFallback on_fallback = scarp::report_tangent_fallback;  ///< called at each fallback

  /// \throws scarp::InputError for springs to the ground that are negative or not finite
  void validate() const {
    sliding.validate();
    scarp::require_not_negative("spring to the ground of a condensed packing", regularisation);
  }

  /// The condensed tangent, or the one under uniform strain after `on_fallback` was called with the reason.
  template <class PackingType>
  scarp::VoigtTangent<PackingType::dim> operator()(PackingType const& packing,
                                                   typename PackingType::Law const& law) const {
    auto const result = condense(packing, law);
    if (!result.verdict.acceptable() && on_fallback != nullptr) {
      on_fallback("a packing's tangent could not be condensed, the one under uniform strain is used", result.verdict);
    }
    return result.tangent;
  }

  /// \return tangent [Pa] under uniform strain with failed / singular_system or not_finite where it cannot be relaxed;
  /// zero and fluid / no_contacts without contacts
  template <class PackingType>
  scarp::TangentResult<PackingType::dim> condense(PackingType const& packing,
                                                  typename PackingType::Law const& law) const {
    constexpr int dim = PackingType::dim;
    validate();
    Assembly<dim> const assembly = assemble(packing, law);
    scarp::VoigtTangent<dim> const affine = assembly.affine / packing.volume();
    if (assembly.stiffness.rows() == 0) return {affine, {scarp::Status::fluid, scarp::Reason::no_contacts}};
    if (!affine.allFinite() || !assembly.forces.allFinite())
      return {affine, {scarp::Status::failed, scarp::Reason::not_finite}};
    Eigen::MatrixXd relaxed;
    if (!(sliding.coupled ? solve_unsymmetric(assembly.stiffness, assembly.forces, relaxed)
                          : solve_symmetric(assembly.stiffness, assembly.forces, relaxed))) {
      return {affine, {scarp::Status::failed, scarp::Reason::singular_system}};
    }
    scarp::VoigtTangent<dim> tangent = affine - assembly.stresses.transpose() * relaxed / packing.volume();
    if (initial_stress) tangent += initial_stress_tangent<dim>(assembly.stress / packing.volume());
    if (!tangent.allFinite()) return {affine, {scarp::Status::failed, scarp::Reason::singular_system}};
    return {tangent, {}};
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  template <int Dim>
  struct Assembly {
    Matrix stiffness;          ///< K [N/m]; its lower triangle where it is symmetric
    Eigen::MatrixXd forces;    ///< A [N], a column for each strain mode
    Eigen::MatrixXd stresses;  ///< A_l [N]
    scarp::VoigtTangent<Dim> affine = scarp::VoigtTangent<Dim>::Zero();  ///< times the volume [N m]
    scarp::Tensor<Dim> stress = scarp::Tensor<Dim>::Zero();              ///< times the volume [N m]
  };

  /// Motion of the second grain of a contact relative to the first in each strain mode.
  template <int Dim>
  static Eigen::Matrix<double, Dim, scarp::voigt_size<Dim>> strain_motion(scarp::Vector<Dim> const& branch) {
    Eigen::Matrix<double, Dim, scarp::voigt_size<Dim>> motion;
    for (int k = 0; k < scarp::voigt_size<Dim>; ++k) motion.col(k) = scarp::unit_strain<Dim>(k) * branch;
    return motion;
  }

  /// Motion of a grain's contact point for (centre, spin x length).
  template <int Dim>
  static Eigen::Matrix<double, Dim, Dim + scarp::spin_size<Dim>> grain_motion(scarp::Point<Dim, double> const& arm,
                                                                              double length) {
    Eigen::Matrix<double, Dim, Dim + scarp::spin_size<Dim>> motion;
    motion.template leftCols<Dim>().setIdentity();
    for (int k = 0; k < scarp::spin_size<Dim>; ++k) {
      scarp::Turning<Dim, double> turn{};
      if constexpr (Dim == 2) {
        turn = 1.0 / length;
      } else {
        turn[scarp::detail::index(k)] = 1.0 / length;
      }
      auto const swing = scarp::turned_motion(turn, arm);
      motion.col(Dim + k) = Eigen::Map<scarp::Vector<Dim> const>(swing.data());
    }
    return motion;
  }

  template <class PackingType>
  Assembly<PackingType::dim> assemble(PackingType const& packing, typename PackingType::Law const& law) const {
    constexpr int dim = PackingType::dim;
    constexpr int motions = dim + scarp::spin_size<dim>;
    double const length = packing.population->largest_radius();
    std::vector<scarp::Contact<dim>> contacts;
    std::vector<Eigen::Index> place(packing.grain_count(), -1);
    Eigen::Index unknowns = 0;
    double normal_stiffness = 0.0;
    scarp::for_each_contact(packing, law, [&](scarp::Contact<dim> const& contact) {
      contacts.push_back(contact);
      normal_stiffness += contact.stiffness.normal;
      for (std::size_t const grain : {contact.first, contact.second}) {
        if (place[grain] >= 0) continue;
        place[grain] = unknowns;
        unknowns += motions;
      }
    });
    Assembly<dim> whole;
    whole.forces = Eigen::MatrixXd::Zero(unknowns, scarp::voigt_size<dim>);
    whole.stresses = whole.forces;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(contacts.size() * 4 * motions * motions + static_cast<std::size_t>(unknowns));
    for (auto const& contact : contacts) {
      scarp::Tensor<dim> const spring = sliding.spring(contact, law);
      scarp::Vector<dim> const n = contact.normal();
      auto const strained = strain_motion<dim>(contact.branch);
      whole.affine += strained.transpose() * spring * strained;
      whole.stress -= contact.force * contact.branch.transpose();
      std::array const start{place[contact.first], place[contact.second]};
      std::array const moved{(-grain_motion<dim>(contact.touch.arm_first, length)).eval(),
                             grain_motion<dim>(contact.touch.arm_second, length)};
      Eigen::Matrix<double, scarp::spin_size<dim>, scarp::spin_size<dim>> rolling;
      if constexpr (dim == 2) {
        rolling.setConstant(contact.stiffness.rolling / (length * length));
      } else {
        rolling = contact.stiffness.rolling / (length * length) * (scarp::Tensor<3>::Identity() - n * n.transpose());
      }
      for (std::size_t a = 0; a < 2; ++a) {
        whole.forces.template middleRows<motions>(start[a]) += moved[a].transpose() * spring * strained;
        whole.stresses.template middleRows<motions>(start[a]) += moved[a].transpose() * spring.transpose() * strained;
        for (std::size_t b = 0; b < 2; ++b) {
          Eigen::Matrix<double, motions, motions> block = moved[a].transpose() * spring * moved[b];
          block.template bottomRightCorner<scarp::spin_size<dim>, scarp::spin_size<dim>>() +=
              (a == b ? 1.0 : -1.0) * rolling;
          for (int i = 0; i < motions; ++i) {
            for (int j = 0; j < motions; ++j) {
              if (sliding.coupled || start[a] + i >= start[b] + j) {
                entries.emplace_back(start[a] + i, start[b] + j, block(i, j));
              }
            }
          }
        }
      }
    }
    double const ground = regularisation * normal_stiffness / static_cast<double>(contacts.size());
    for (Eigen::Index i = 0; i < unknowns; ++i) entries.emplace_back(i, i, ground);
    whole.stiffness.resize(unknowns, unknowns);
    whole.stiffness.setFromTriplets(entries.begin(), entries.end());
    return whole;
  }

  static bool solve_symmetric(Matrix const& matrix, Eigen::MatrixXd const& right, Eigen::MatrixXd& solution) {
    constexpr double min_pivot = 1e-13;  // over the largest: below it round-off decides
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver(matrix);
    if (solver.info() != Eigen::Success) return false;
    if (!(solver.vectorD().minCoeff() > min_pivot * solver.vectorD().maxCoeff())) return false;
    solution = solver.solve(right);
    return true;
  }

  static bool solve_unsymmetric(Matrix const& matrix, Eigen::MatrixXd const& right, Eigen::MatrixXd& solution) {
    Eigen::SparseLU<Matrix> solver;
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) return false;
    solution = solver.solve(right);
    return true;
  }
};

}  // namespace benchmarks
