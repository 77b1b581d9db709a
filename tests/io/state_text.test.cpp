// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/state_text.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "support/packings.hpp"

namespace {

struct Part {
  scarp::Verdict verdict{scarp::Status::not_converged, scarp::Reason::unbalanced};
  std::string name = "sand";
  std::pair<double, int> both{0.5, 2};

  SCARP_MEMBERS(verdict, name, both)
};

struct Whole {
  double number = 1.25;
  Eigen::Matrix2d tensor = (Eigen::Matrix2d() << 1, 2, 3, 4).finished();
  std::vector<double> few{1.0, 2.0};
  std::vector<int> many = std::vector<int>(20, 7);
  std::vector<Part> parts = std::vector<Part>(1);

  SCARP_MEMBERS(number, tensor, few, many, parts)
};

}  // namespace

TEST_CASE("a state's members are lines of text, parts indented, long lists cut") {
  CHECK(scarp::state_text(Whole{}) ==
        "number: 1.25\n"
        "tensor: 1, 2; 3, 4\n"
        "few: 1, 2\n"
        "many: 20 numbers: 7, 7, 7, 7, 7, 7, ...\n"
        "parts, 1 of them:\n"
        "  0:\n"
        "    verdict:\n"
        "      status: not_converged\n"
        "      reason: unbalanced\n"
        "    name: \"sand\"\n"
        "    both:\n"
        "      first: 0.5\n"
        "      second: 2\n");
}

TEST_CASE("the state of a packing within an adaptor can be read") {
  using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
  scarp::StiffnessFloor<Rve> const provider{
      Rve{.law = samples::study_law(), .source = {samples::consolidated<samples::Discs>(50).packing}}};
  auto const text = scarp::state_text(provider.initial_state({}));
  for (auto const* expected : {"unbalanced_ratio: ", "position: 50 rows of 2\n", "status: ok\n", "density: 2650\n"}) {
    CAPTURE(expected);
    CHECK(text.find(expected) != std::string::npos);
  }
}
