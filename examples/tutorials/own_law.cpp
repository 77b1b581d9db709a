// SPDX-License-Identifier: BSL-1.0
// User-defined contact law: a spring that stiffens, with friction, in packings of any shape.
#include "scarp/contact/coulomb.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/simd/select.hpp"

#include "lattice.hpp"

/// \f$ F_n = k\,u^{3/2},\; |F_t| \le \mu F_n \f$ with a linear shear spring; k [N/m^1.5], k_t [N/m].
struct Stiffening {
  static constexpr scarp::ContactInputs inputs{.shear = true};  // without it no slip is computed and nothing rubs

  double coefficient = 0.0;
  double tangential_stiffness = 0.0;
  double friction = 0.0;

  // constexpr: also for the threads of a card. T is a double, or a pack of as many contacts as a register holds: no
  // `if` on it, but lanes::select and its like.
  template <int Dim, class T>
  constexpr scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                                scarp::ContactMemory<Dim, T>& memory) const {
    using std::sqrt;
    T const closed = scarp::lanes::at_least(approach.overlap, T(0));
    T const normal = T(coefficient) * closed * sqrt(closed);
    T const lost = scarp::coulomb_slide<Dim, T>(memory.shear, approach.slip_increment, T(tangential_stiffness),
                                                T(friction) * normal);
    return {.normal = normal, .shear = memory.shear, .dissipated = lost};
  }
  constexpr scarp::ContactStiffness stiffness(double overlap, double) const {
    return {.normal = 1.5 * coefficient * std::sqrt(std::max(overlap, 0.0)), .tangential = tangential_stiffness};
  }
};
using Grains = scarp::Packing<scarp::Disc, Stiffening>;  // names what a law lacks
static_assert(scarp::Frictional<Stiffening>);

int main() {
  Stiffening const law{.coefficient = 1e9, .tangential_stiffness = 5e6, .friction = 0.5};
  double const radius = 5e-3, overlap = 1e-5, spacing = 2.0 * radius - overlap;
  scarp::DemRve const soil{law, tutorials::lattice<Grains>({radius}, {spacing, spacing})};
  auto const start = soil.initial_state({});
  // One contact of length d along each axis in each cell d x d x 1: stress = force / d.
  double const normal = law.coefficient * overlap * std::sqrt(overlap);
  bool good = tutorials::agree("normal stress [Pa]", -start.stress(0), normal / spacing, 1e-9);
  // Pure shear e: along each axis neighbours slip by e d, which the spring resists up to mu F_n. The branches turn by
  // e, and the normal forces p with them: less 2 p e.
  auto const shear_after = [&](double strain) {
    auto state = start;
    return advance(soil, state, scarp::Gradient<2>{{0.0, strain}, {strain, 0.0}}).stress(2);
  };
  double const pressure = normal / spacing, stuck = 2e-5, slid = 1e-3;
  good &= tutorials::agree("shear stress, no slip [Pa]", shear_after(stuck),
                           (law.tangential_stiffness - 2.0 * pressure) * stuck, 1e-4);
  // The branches lengthen by e^2 d / 2, which lowers the normal force by 0.75 e^2 d / u = 7.5e-4.
  good &=
      tutorials::agree("shear stress, sliding [Pa]", shear_after(slid), (law.friction - 2.0 * slid) * pressure, 1e-3);
  return good ? 0 : 1;
}
