// SPDX-License-Identifier: BSL-1.0
#include "other.hpp"

#include "scarp/tensor/tensor.hpp"
#include "scarp/tensor/voigt.hpp"

scarp::Random const* other_random() {
  static scarp::Random const random(1);
  return &random;
}

double other_shear(double strain) {
  scarp::Gradient<2> gradient;
  gradient << 0.0, strain, 0.0, 0.0;
  return scarp::to_engineering_strain<2, double>(gradient)(2);
}
