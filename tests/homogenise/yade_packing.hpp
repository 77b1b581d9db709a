// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "support/packings.hpp"

namespace samples {

/// The packing of 400 discs that Yade consolidated to 200 kPa, see tests/reference/README.md; without shear forces.
inline Discs yade_packing() {
  auto const path = std::filesystem::path(__FILE__).parent_path() / "../reference/yade/particles.csv";
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);  // id,x,y,r
  std::vector<scarp::Disc::Size<double>> sizes;
  std::vector<Vector<2>> places;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    double id = 0.0, x = 0.0, y = 0.0, radius = 0.0;
    char comma = ',';
    fields >> id >> comma >> x >> comma >> y >> comma >> radius;
    sizes.push_back({radius});
    places.emplace_back(x, y);
  }
  Tensor<2> cell;
  cell.col(0) = Vector<2>(0.19516606047263926, 0.0);
  cell.col(1) = Vector<2>(0.0008502401980710722, 0.19043137125613024);
  return place<Discs>(cell, sizes, places);
}

}  // namespace samples
