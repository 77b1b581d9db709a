// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <span>

#include "choice.hpp"
#include "scarp/budget/detail/point_checks.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/observe/rve_quantities.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace biaxial_specimen {

/// Packings at all points of a specimen, discs or ellipses. A material field whose DEM is compiled once (sand.cpp), not
/// again for every element.
class Sand {
 public:
  static constexpr int dim = 2;

  /// pressure [Pa]: of packings that are prepared
  /// \throws InputError for files that are wrong, PreparationError
  Sand(Grains const& grains, double pressure, std::span<scarp::Site<2> const> sites, scarp::ThreadExecutor& executor);
  Sand(Sand&&) noexcept;
  ~Sand();

  int point_count() const;
  void plan(int point, scarp::Gradient<2> const& predicted);
  void refine_plan(int point);
  scarp::Response<2> respond(int point, scarp::Gradient<2> const& increment);
  long work(int point) const;
  scarp::VoigtStress<2> committed_stress(int point) const;
  scarp::VoigtTangent<2> committed_tangent(int point) const;
  scarp::VoigtTangent<2> trial_tangent(int point) const;
  void commit();

  /// What a picture shows of a point: void ratio, fabric, coordination.
  template <class Look>
  void visit(int point, Look&& look) const {
    look(*this, point);
  }
  Sand const& provider() const { return *this; }
  scarp::Quantities committed(int point) const;

  /// What an error budget asks.
  friend scarp::PointBalance point_balance(Sand const& sand, int point, scarp::Gradient<2> const& increment);
  friend scarp::DoubledAnswer<2> doubled_answer(Sand const& sand, int point, scarp::Gradient<2> const& increment);
  friend scarp::DoubledAnswer<2> followed_answer(Sand const& sand, int point, scarp::Gradient<2> const& increment,
                                                 std::string& bits);

 private:
  struct Fields;
  std::unique_ptr<Fields> fields_;
};

struct SandQuantities {
  scarp::Quantities operator()(Sand const&, scarp::Quantities quantities) const { return quantities; }
};

static_assert(scarp::MaterialField<Sand>);

}  // namespace biaxial_specimen
