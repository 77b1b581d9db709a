// SPDX-License-Identifier: BSL-1.0
// User-defined grain shape: a convex oval by its support function, from a loose cloud to a packing.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/shape/support_contact.hpp"

#include "lattice.hpp"

/// Support function \f$ h = r\,(1 + \epsilon\cos 2(\phi - \theta)) \f$; size is (r [m], epsilon), orientation (cos, sin) of
/// theta, the pose (r, r eps cos 2 theta, r eps sin 2 theta).
struct Oval {
  static constexpr int dim = 2, size_count = 2, orientation_count = 2, pose_count = 3;
  static constexpr bool warm_starts_normal = true;  // the search starts from the last step's normal
  using Size = scarp::SizeOf<Oval>;

  /// Grains that are not convex: called once for every grain.
  static void check(Size const& size) {
    if (size[1] > 0.3) scarp::reject("an oval has epsilon {} (from 1/3 on it is not convex): take up to 0.3", size[1]);
  }
  // Area and polar moment from h: A = int (h^2 - h'^2) / 2, I = int (h^2 + h'^2) h (h + h'') / 4 over the angle.
  static double content(Size const& size) {
    return std::numbers::pi * size[0] * size[0] * (1.0 - 1.5 * size[1] * size[1]);
  }
  static double gyration_squared(Size const& size) {
    double const square = size[1] * size[1];
    return size[0] * size[0] / 2.0 * (1.0 - square - 21.0 / 8.0 * square * square) / (1.0 - 1.5 * square);
  }
  static double bounding_radius(Size const& size) { return size[0] * (1.0 + size[1]); }
  static double eccentricity(Size const& size) { return 2.0 * size[0] * size[1]; }  // largest |h'|

  // From here on T is a double or a pack of several grains.
  template <class T>
  static std::array<T, 3> pose(std::array<T, 2> const& size, std::array<T, 2> const& axis) {
    T const excess = size[0] * size[1];
    return {size[0], excess * (axis[0] * axis[0] - axis[1] * axis[1]),
            excess * (axis[0] * axis[1] + axis[0] * axis[1])};
  }
  template <class T>
  static T contact_radius(std::array<T, 3> const& pose) {
    return pose[0];
  }
  template <class T>
  static scarp::Support<T> support(std::array<T, 3> const& pose, scarp::Point<2, T> const& n) {
    T const cosine = n[0] * n[0] - n[1] * n[1];
    T const sine = n[0] * n[1] + n[0] * n[1];
    T const part = pose[1] * cosine + pose[2] * sine;
    T const turned = pose[2] * cosine - pose[1] * sine;
    return {pose[0] + part, turned + turned, pose[0] - scarp::broadcast<T>(3) * part};
  }
  template <class T>
  static std::array<scarp::Support<T>, 2> supports(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                                   scarp::Point<2, T> const& n) {
    return {support(first, n), support(second, n)};
  }
  template <class T>
  static scarp::ContactGeometry<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                            scarp::Point<2, T> const& branch, scarp::Point<2, T> const& normal) {
    return scarp::support_contact<Oval>(first, second, branch, normal);
  }
};
using Grains = scarp::Packing<Oval, scarp::LinearFrictional>;  // names what a shape lacks

/// Ovals of one form and of several sizes.
struct OvalGrading {
  using Shape = Oval;
  Oval::Size sample(scarp::Random& random) const { return {random.uniform(4e-3, 6e-3), 0.15}; }
};

int main() {
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};
  scarp::TimeStepper<Grains> stepper;
  scarp::StepObservation<2> seen;
  // A lattice of ovals along x: 2 r (1 + eps) long, 2 r (1 - eps) high, both more than the spacing by the overlap.
  double const r = 5e-3, eps = 0.2, overlap = 1e-6;
  scarp::Vector<2> const spacing(2.0 * r * (1.0 + eps) - overlap, 2.0 * r * (1.0 - eps) - overlap);
  auto lattice = tutorials::lattice<Grains>({r, eps}, spacing);
  bool good = stepper.observe(lattice, law, seen).acceptable();
  double const force = law.normal_stiffness * overlap;
  good &= tutorials::agree("stress of a lattice along x [Pa]", -seen.stress(0, 0), force / spacing.y(), 1e-9);
  good &= tutorials::agree("stress of a lattice along y [Pa]", -seen.stress(1, 1), force / spacing.x(), 1e-9);

  scarp::Cloud<OvalGrading> const cloud{.grains = 40, .density = 2650.0, .thickness = 1.0};
  auto made = scarp::IsotropicPreparation{.pressure = 1e5}.prepare(cloud.make<Grains>(), law);
  good &= made.verdict.acceptable() && stepper.observe(made.packing, law, seen).acceptable();
  return tutorials::agree("pressure of a packing [Pa]", -seen.stress.trace() / 2.0, 1e5, 1e-3) && good ? 0 : 1;
}
