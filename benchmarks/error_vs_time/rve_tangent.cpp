// SPDX-License-Identifier: BSL-1.0
// The tangent of a sheared packing: cheap policies and derivatives by trial, against a derivative by smaller trials.
#include <map>

#include "rve_packings.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/perturbation_tangent.hpp"
#include "scarp/dem/loading_paths.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/homogenise/sliding_aware_tangent.hpp"
#include "scarp/measure/sweep.hpp"
#include "subjects.hpp"

namespace error_vs_time {
namespace {

/// A derivative by trial: strain of the trial [-] and the balance to which the packing settles after it, relative to
/// the forces that the trial changes.
struct Trial {
  double strain = 1e-4;
  double balance = 0.1;
};

/// At 1 % of pure shear, at rest; made once for every seed.
Grains const& sheared(int seed) {
  static std::map<int, Grains> made;
  if (auto const found = made.find(seed); found != made.end()) return found->second;
  Grains packing = consolidated(400, seed);
  auto const law = examples::study_law();
  scarp::TimeStepper<Grains> stepper;
  auto const step = scarp::pure_shear<2>(2e-6).gradient_per_step;
  for (int k = 0; k < 5000; ++k) {
    if (!stepper.step(packing, law, step).acceptable()) throw scarp::PreparationError("a packing was lost in shear");
  }
  static_cast<void>(stepper.stop(packing, law));
  return made.emplace(seed, std::move(packing)).first->second;
}

scarp::Measured told(scarp::VoigtTangent<2> const& tangent) {
  scarp::Measured measured;
  measured.answer("tangent", Eigen::VectorXd(tangent.reshaped()));
  measured.answer("answer to more of the same", Eigen::VectorXd(tangent * scarp::EngineeringStrain<2>(1.0, -1.0, 0.0)));
  return measured;
}

/// Shear goes on in the direction in which the packing was sheared, so that sliding contacts slide on.
scarp::Measured by_trial(Trial const& trial, int repetition) {
  Grains const& packing = sheared(repetition + 1);
  scarp::CpuTime const clock;
  scarp::PerturbationTangent const policy{.strain = trial.strain,
                                          .strain_steps = std::max(20, static_cast<int>(trial.strain / 1e-6)),
                                          .unbalanced_tolerance = trial.balance * trial.strain,
                                          .most_steps = 200'000};
  long steps = 0;
  auto const answer = policy.differentiate(packing, examples::study_law(), {1.0, -1.0, 0.0}, &steps);
  auto measured = told(answer.tangent);
  measured.seconds = clock.seconds();
  measured.inner_steps = steps;
  measured.verdict = answer.verdict;
  return measured;
}

scarp::SweepTable sweep_tangents(Options const& options) {
  scarp::Sweep sweep("rve_tangent", Trial{}, by_trial);
  sweep.reference({.strain = 1e-6, .balance = 0.05});
  sweep.vary("strain of the trial", &Trial::strain, {1e-3, 3e-4, 1e-4, 3e-5, 1e-5});
  sweep.vary("balance after the trial", &Trial::balance, {10.0, 3.0, 1.0, 0.3, 0.1});
  sweep.vary_over<scarp::ElasticContactTangent, scarp::SlidingAwareTangent, scarp::CondensedTangent>(
      "policy", {"eq. 6 of the study", "sliding-aware", "condensed"}, [](auto policy, Trial const&, int repetition) {
        Grains const& packing = sheared(repetition + 1);
        scarp::CpuTime const clock;
        auto measured = told(policy(packing, examples::study_law()));
        measured.seconds = clock.seconds();
        return measured;
      });
  return sweep.run(options.repetitions_or(options.quick ? 1 : 5));
}

bool const registered =
    register_subject({"rve_tangent", "the tangent of a sheared packing", sweep_tangents, {0.5, 0.2, 0.1}});

}  // namespace
}  // namespace error_vs_time
