// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/principal.hpp"

#include <doctest/doctest.h>

namespace {

using scarp::Principal;
using scarp::Tensor;
using scarp::Vector;

/// Symmetric, of the given principal values in general directions.
Tensor<3> symmetric(Vector<3> const& values) {
  // Two reflections are a rotation.
  Vector<3> const first = Vector<3>(1.0, 0.3, -0.9).normalized();
  Vector<3> const second = Vector<3>(0.2, 2.0, 0.5).normalized();
  Tensor<3> const turn = (Tensor<3>::Identity() - 2.0 * first * first.transpose()) *
                         (Tensor<3>::Identity() - 2.0 * second * second.transpose());
  return turn * values.asDiagonal() * turn.transpose();
}

}  // namespace

TEST_CASE("principal values come largest first with their directions") {
  Vector<3> const values(4.0, 1.5, -2.0);
  Tensor<3> const tensor = symmetric(values);
  Principal const found = scarp::principal(tensor);
  CHECK((found.values - values).norm() < 1e-14 * values.norm());
  CHECK((tensor * found.directions - found.directions * values.asDiagonal()).norm() < 1e-14 * values.norm());
}

TEST_CASE("principal values in the plane and in space are those of Mohr's circle and of the eigenvectors") {
  Tensor<2> plane;
  plane << 5.0, 4.0, 4.0, -1.0;  // centre 2, radius 5
  CHECK(scarp::principal_values<2>(plane) == Vector<2>(7.0, -3.0));
  CHECK(scarp::principal_values<2>(Tensor<2>{{0.0, 0.0}, {0.0, -0.3}}) == Vector<2>(0.0, -0.3));
  Vector<3> const values(4.0, 4.0, -2.0);
  CHECK((scarp::principal_values<3>(symmetric(values)) - values).norm() < 1e-14 * values.norm());
}

TEST_CASE("the derivative of an isotropic function follows from its principal values, equal ones included") {
  // Analytic: A^2 + tr(A) A changes by A E + E A + tr(A) E + tr(E) A.
  Tensor<3> change;
  change << 0.3, -0.1, 0.7, -0.1, 0.9, 0.2, 0.7, 0.2, -0.5;
  for (Vector<3> const& values : {Vector<3>(4.0, 1.5, -2.0), Vector<3>(4.0, 4.0, -2.0), Vector<3>(3.0, 3.0, 3.0),
                                  Vector<3>(1.0 + 1e-10, 1.0, 1.0 - 1e-10), Vector<3>(1e7 + 1.0, 1e7, 2e6)}) {
    Tensor<3> const tensor = symmetric(values);
    auto const at = scarp::principal(tensor);
    double const trace = tensor.trace();
    Tensor<3> of_values = at.values.rowwise().replicate<3>();
    of_values.diagonal() += 2.0 * at.values + Vector<3>::Constant(trace);
    Vector<3> const answer = at.values.array().square() + trace * at.values.array();
    scarp::EngineeringStrain<3> const strain = scarp::to_engineering_strain<3, double>(change);
    scarp::VoigtStress<3> const found =
        scarp::isotropic_derivative(of_values, at.values, answer, at.directions) * strain;
    Tensor<3> const exact = tensor * change + change * tensor + trace * change + change.trace() * tensor;
    // Round-off of quotients of differences that are 1e-7 of the values.
    CHECK((found - scarp::to_voigt_stress<3, double>(exact)).norm() < 1e-7 * exact.norm());
  }
}
