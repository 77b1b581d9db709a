// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/io/packings/packing_reader.hpp"
#include "scarp/shape/ellipse.hpp"
#include "support/approx.hpp"

namespace {

using Ellipses = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

constexpr double pressure = 2e5;  // [Pa]
constexpr scarp::LinearFrictional law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};

/// How far packings of other seeds scatter at an axial strain.
struct Point {
  double strain;
  double ratio_scatter;   ///< of axial over lateral stress
  double volume_scatter;  ///< of the volumetric strain
};

/// Sample standard deviations over ten seeds:
/// ./examples/run rve_biaxial --preparation-friction 0.05,0.1,0.15,0.2 --seeds 10
/// examples/rve_lab/against_sudodem.py (docs/rve.md has the whole command)
constexpr std::array scatter_at_friction_010{Point{0.0025, 0.0098, 2.0e-5}, Point{0.005, 0.0212, 5.6e-5},
                                             Point{0.01, 0.0392, 1.63e-4},  Point{0.015, 0.0651, 3.10e-4},
                                             Point{0.02, 0.1176, 6.28e-4},  Point{0.025, 0.1390, 1.064e-3},
                                             Point{0.03, 0.1697, 1.825e-3}};
constexpr std::array scatter_at_friction_015{Point{0.0025, 0.0130, 2.4e-5}, Point{0.005, 0.0272, 6.4e-5},
                                             Point{0.01, 0.0711, 2.46e-4},  Point{0.015, 0.1312, 6.80e-4},
                                             Point{0.02, 0.1598, 9.33e-4},  Point{0.025, 0.1426, 9.83e-4},
                                             Point{0.03, 0.1961, 1.153e-3}};

std::filesystem::path reference(std::string const& name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "reference" / "sudodem" / name;
}

/// The packing of the file at rest under the pressure, the cell rectangular. The file holds no shear forces: they grow
/// again while the forces come into balance, and the void ratio hardly changes.
Ellipses relaxed(std::string const& name, double width, double height) {
  scarp::Tensor<2> cell = scarp::Tensor<2>::Zero();
  cell.diagonal() << width, height;
  auto packing = scarp::read_packing<Ellipses>(reference(name + "_particles.csv"), cell, 2650.0, 0.2).packing;
  double const void_ratio = packing.void_ratio();
  scarp::Loading<2> loading;
  for (int axis = 0; axis < 2; ++axis) loading.controls.push_back(scarp::component_control<2>(axis, -pressure));
  scarp::TimeStepper<Ellipses> stepper;
  REQUIRE(scarp::Servo{}.reach(stepper, packing, law, loading).acceptable());
  REQUIRE(stepper.stop(packing, law).acceptable());
  // Measured: 4.5e-4 for A, 9e-4 for G.
  CHECK(packing.void_ratio() == samples::Approx(void_ratio).epsilon(2e-3));
  return packing;
}

/// SudoDEM's curve at an axial strain; its strains are positive in extension.
struct Curve {
  std::vector<double> axial, lateral, ratio;

  explicit Curve(std::filesystem::path const& path) {
    auto const table = scarp::read_csv(path);
    axial = table.column("ey");
    lateral = table.column("ex");
    ratio = table.column("syy");
    auto const held = table.column("sxx");
    for (std::size_t k = 0; k < ratio.size(); ++k) ratio[k] /= held[k];
  }
  double at(std::vector<double> const& values, double strain) const {
    REQUIRE(-axial.back() >= strain);
    std::size_t k = 1;
    while (-axial[k] < strain) ++k;
    double const share = (strain + axial[k - 1]) / (axial[k - 1] - axial[k]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }
  double volume(double strain) const { return strain - at(lateral, strain); }
};

/// 1e-5 of strain per step: the stress ratio lags by 0.002 behind that of 2e-6 at 0.25 %, a fifth of the scatter there.
template <std::size_t Count>
void compare(std::string const& name, double width, double height, std::array<Point, Count> const& points) {
  constexpr double strain_per_step = 1e-5;
  Ellipses packing = relaxed(name, width, height);
  Curve const expected(reference(name + "_biaxial.csv"));
  double const first_area = packing.cell.determinant();
  scarp::TimeStepper<Ellipses> stepper;
  scarp::CellDriver<Ellipses> drive(packing, law, scarp::drained_compression<2>(strain_per_step, pressure));
  long step = 0;
  for (auto const& point : points) {
    for (; step < std::lround(point.strain / strain_per_step); ++step) REQUIRE(drive.step(stepper).acceptable());
    auto const& stress = drive.seen().stress;
    double const volume = -std::log(packing.cell.determinant() / first_area);
    CAPTURE(point.strain);
    CHECK(std::abs(stress(1, 1) / stress(0, 0) - expected.at(expected.ratio, point.strain)) < point.ratio_scatter);
    CHECK(std::abs(volume - expected.volume(point.strain)) < point.volume_scatter);
  }
}

}  // namespace

// Expected: SudoDEM2D 6666937, tests/reference/README.md. Its spins have four times the inertia and its slip takes |c|
// for c.n, which statics does not feel at these strains. Cells are those of packing_reader.test.cpp's formula.
TEST_CASE("SudoDEM's packings give SudoDEM's curves to 3 % strain within the scatter of seeds") {
  compare("A", 0.16525763166656382, 0.1653063208111853, scatter_at_friction_010);
  compare("G", 0.16663676021512222, 0.16670996462691512, scatter_at_friction_015);
}
