// SPDX-License-Identifier: BSL-1.0
// User-defined grain shape: a convex oval by its support function, from a loose cloud to a packing.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/shape/convex_shape.hpp"

#include "lattice.hpp"

/// Support function \f$ h = r\,(1 + \epsilon\cos 2\phi) \f$, phi from the grain's axis; size is (r [m], epsilon).
struct Oval : scarp::ConvexShape<Oval, 2> {
  template <class T>  // a number with its derivatives, of one grain or of several
  static constexpr T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
    return size[0] * (1.0 + size[1] * (cosine * cosine - sine * sine));
  }
};
using Grains = scarp::Packing<Oval, scarp::LinearFrictional>;  // names what a shape lacks

/// Ovals of one form and of several sizes.
struct OvalGrading {
  using Shape = Oval;
  scarp::SizeOf<Oval> sample(scarp::Random& random) const { return {random.uniform(4e-3, 6e-3), 0.15}; }
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
