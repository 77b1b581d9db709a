// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp_benchmark {

/// The yardstick of the library's kernel: one grain per struct, one pair at a time, scalar, with branches; same contact
/// search, law, damping and integration. Its list of pairs is taken from a packing and never renewed.
template <class PackingType>
class NaiveKernel {
 public:
  static constexpr bool is_disc = std::is_same_v<typename PackingType::Shape, scarp::Disc>;

  struct Grain {
    double x, y, vx, vy, spin, angle;
    double a, b, inverse_mass, inverse_inertia;
    double xx, xy, yy;  // matrix of the support function
    double fx, fy, torque;
  };

  struct Pair {
    std::size_t first, second;
    int shift_x, shift_y;
    double nx, ny, shear;
  };

  NaiveKernel(PackingType const& packing, scarp::LinearFrictional const& law, scarp::LocalDamping const& damping,
              double time_step)
      : law_(law), damping_(damping), time_step_(time_step), cell_(packing.cell) {
    auto const& population = *packing.population;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      auto const size = population.size(i);
      Grain grain{};
      grain.x = packing.position(i, 0);
      grain.y = packing.position(i, 1);
      grain.vx = packing.velocity(i, 0);
      grain.vy = packing.velocity(i, 1);
      grain.spin = packing.spin(i, 0);
      grain.a = size.front();
      grain.b = size.back();
      if constexpr (!is_disc) grain.angle = std::atan2(packing.orientation(i, 1), packing.orientation(i, 0));
      grain.inverse_mass = population.inverse_mass()[i];
      grain.inverse_inertia = population.inverse_inertia()[i];
      grains_.push_back(grain);
    }
    auto const& pairs = packing.pairs;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
      Pair pair{};
      pair.first = static_cast<std::size_t>(pairs.first[p]);
      pair.second = static_cast<std::size_t>(pairs.second[p]);
      if (pair.second >= grains_.size()) {
        std::size_t const ghost = pair.second - grains_.size();
        pair.shift_x = pairs.ghost_shift[ghost][0];
        pair.shift_y = pairs.ghost_shift[ghost][1];
        pair.second = static_cast<std::size_t>(pairs.ghost_owner[ghost]);
      }
      if constexpr (!is_disc) {
        pair.nx = pairs.normal(p, 0);
        pair.ny = pairs.normal(p, 1);
      }
      pair.shear = pairs.shear(p, 0);
      pairs_.push_back(pair);
    }
  }

  std::vector<Grain> const& grains() const { return grains_; }
  std::size_t pair_count() const { return pairs_.size(); }

  void step(scarp::Tensor<2> const& strain) {
    forces(strain);
    move(strain);
  }

  void forces(scarp::Tensor<2> const& strain) {
    for (auto& grain : grains_) {
      grain.fx = grain.fy = grain.torque = 0.0;
      if constexpr (!is_disc) {
        double const c = std::cos(grain.angle);
        double const s = std::sin(grain.angle);
        double const excess = grain.a * grain.a - grain.b * grain.b;
        grain.xx = grain.b * grain.b + excess * c * c;
        grain.xy = excess * c * s;
        grain.yy = grain.b * grain.b + excess * s * s;
      }
    }
    double const turn = (strain(1, 0) - strain(0, 1)) / 2.0;
    for (auto& pair : pairs_) {
      Grain& one = grains_[pair.first];
      Grain& two = grains_[pair.second];
      double const dx = two.x + cell_(0, 0) * pair.shift_x + cell_(0, 1) * pair.shift_y - one.x;
      double const dy = two.y + cell_(1, 0) * pair.shift_x + cell_(1, 1) * pair.shift_y - one.y;
      Meeting const meeting = meet(pair, one, two, dx, dy);
      if (meeting.overlap <= 0.0) {
        pair.shear = 0.0;
        continue;
      }
      double const second_x = meeting.arm_x - dx;
      double const second_y = meeting.arm_y - dy;
      double const turn_one = one.spin * time_step_ + turn;
      double const turn_two = two.spin * time_step_ + turn;
      double const slip_x = (two.vx - one.vx) * time_step_ + strain(0, 0) * dx + strain(0, 1) * dy -
                            turn_two * second_y + turn_one * meeting.arm_y;
      double const slip_y = (two.vy - one.vy) * time_step_ + strain(1, 0) * dx + strain(1, 1) * dy +
                            turn_two * second_x - turn_one * meeting.arm_x;
      double const normal = law_.normal_stiffness * meeting.overlap;
      double const limit = law_.friction * normal;
      pair.shear -= law_.tangential_stiffness * (slip_y * meeting.nx - slip_x * meeting.ny);
      pair.shear = std::clamp(pair.shear, -limit, limit);
      double const fx = normal * meeting.nx - pair.shear * meeting.ny;
      double const fy = normal * meeting.ny + pair.shear * meeting.nx;
      one.fx -= fx;
      one.fy -= fy;
      one.torque -= meeting.arm_x * fy - meeting.arm_y * fx;
      two.fx += fx;
      two.fy += fy;
      two.torque += second_x * fy - second_y * fx;
    }
  }

 private:
  struct Meeting {
    double overlap, nx, ny, arm_x, arm_y;
  };
  struct Support {
    double value, slope, curvature_radius;
  };

  static Support support(Grain const& grain, double nx, double ny) {
    double const x = grain.xx * nx + grain.xy * ny;
    double const y = grain.xy * nx + grain.yy * ny;
    double const value = std::sqrt(x * nx + y * ny);
    return {value, (y * nx - x * ny) / value, (grain.xx * grain.yy - grain.xy * grain.xy) / (value * value * value)};
  }

  static Meeting meet(Pair& pair, Grain const& one, Grain const& two, double dx, double dy) {
    if constexpr (is_disc) {
      double const distance = std::sqrt(dx * dx + dy * dy);
      double const overlap = one.a + two.a - distance;
      double const reach = one.a - overlap / 2.0;
      return {overlap, dx / distance, dy / distance, dx / distance * reach, dy / distance * reach};
    } else {
      double const nx = pair.nx;
      double const ny = pair.ny;
      Support const first = support(one, nx, ny);
      Support const second = support(two, nx, ny);
      double const depth = first.value + second.value - dx * nx - dy * ny;
      double const slope = first.slope + second.slope + dx * ny - dy * nx;
      double const turn = std::clamp(-slope / (first.curvature_radius + second.curvature_radius - depth), -0.5, 0.5);
      double const length = std::sqrt(1.0 + turn * turn);
      pair.nx = (nx - turn * ny) / length;
      pair.ny = (ny + turn * nx) / length;
      double const level = (first.value - second.value) / 2.0;
      double const shift =
          (first.slope - second.slope + turn * (first.curvature_radius - second.curvature_radius)) / 2.0;
      return {depth + slope * turn / 2.0, pair.nx, pair.ny, dx / 2.0 + level * nx - shift * ny,
              dy / 2.0 + level * ny + shift * nx};
    }
  }

  double next(double velocity, double force, double mobility) const {
    double const damped = force - damping_.factor * std::copysign(std::abs(force), velocity);
    return damping_.kept * velocity + damped * mobility * time_step_;
  }

  void move(scarp::Tensor<2> const& strain) {
    scarp::Tensor<2> const identity = scarp::Tensor<2>::Identity();
    scarp::Tensor<2> const cell_step = identity + strain * (identity + strain / 2.0);  // exponential, strains are tiny
    double const turn = (strain(1, 0) - strain(0, 1)) / 2.0;
    for (auto& grain : grains_) {
      grain.vx = next(grain.vx, grain.fx, grain.inverse_mass);
      grain.vy = next(grain.vy, grain.fy, grain.inverse_mass);
      grain.spin = next(grain.spin, grain.torque, grain.inverse_inertia);
      double const x = cell_step(0, 0) * grain.x + cell_step(0, 1) * grain.y + grain.vx * time_step_;
      grain.y = cell_step(1, 0) * grain.x + cell_step(1, 1) * grain.y + grain.vy * time_step_;
      grain.x = x;
      grain.angle += grain.spin * time_step_ + turn;
    }
    cell_ = (cell_step * cell_).eval();
  }

  scarp::LinearFrictional law_;
  scarp::LocalDamping damping_;
  double time_step_;
  scarp::Tensor<2> cell_;
  std::vector<Grain> grains_;
  std::vector<Pair> pairs_;
};

}  // namespace scarp_benchmark
