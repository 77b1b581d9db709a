// SPDX-License-Identifier: BSL-1.0
// How much of the fault scene's work would shared responses save? Points that began with one packing and whose strain
// has differed by less than a tolerance ever since could take the response of one of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "../shared/data_file.hpp"
#include "../shared/nonlocal_fault.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using Scene = scarp::FreeFieldFault<scarp::Nonlocal<fault_rupture::Sand>>;
using Strain = scarp::Tensor<2>;

/// Groups of points that could share their responses, for one tolerance of strain. A point that leaves its group never
/// returns.
struct Groups {
  double tolerance;
  std::vector<int> of_point{};  ///< number of the group
  long steps = 0;               ///< DEM steps of all points
  long shared = 0;              ///< of points for which another one of the group would respond

  int count() const { return 1 + *std::max_element(of_point.begin(), of_point.end()); }

  /// strains: sums over all accepted steps; work: DEM steps of the last one
  void advance(std::vector<Strain> const& strains, std::vector<long> const& work) {
    int next = count();
    std::map<int, std::vector<int>> parts;  // representatives of each old group, its first one stays
    std::vector<int> representative_of(strains.size());
    std::vector<int> now = of_point;
    for (std::size_t k = 0; k < strains.size(); ++k) {
      auto& representatives = parts[of_point[k]];
      auto const like = std::find_if(representatives.begin(), representatives.end(), [&](int one) {
        return (strains[static_cast<std::size_t>(one)] - strains[k]).norm() <= tolerance;
      });
      steps += work[k];
      if (like != representatives.end()) {
        now[k] = now[static_cast<std::size_t>(*like)];
        shared += work[k];
      } else {
        if (!representatives.empty()) now[k] = next++;
        representatives.push_back(static_cast<int>(k));
      }
    }
    of_point = now;
  }
};

struct LikePoints : scarp::NeverStops {
  std::vector<Groups> groups;
  std::vector<Strain> strains;

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    auto const& points = problem.points();
    std::vector<long> work;
    for (int k = 0; k < points.size(); ++k) {
      Strain const increment = points.gradients()[static_cast<std::size_t>(k)];
      strains[static_cast<std::size_t>(k)] += increment;
      work.push_back(points.work(k));
    }
    for (auto& one : groups) one.advance(strains, work);
  }
};

/// Numbers of groups of equal committed states.
template <class Points>
std::vector<int> equal_states(Points const& points) {
  std::map<std::string, int> numbers;
  std::vector<int> found;
  for (int k = 0; k < points.size(); ++k)
    found.push_back(numbers.emplace(points.pack(k), static_cast<int>(numbers.size())).first->second);
  return found;
}

void run(int packings, bool quick, scarp::CsvTable& table) {
  auto const choice = benchmarks::nonlocal_fault(packings, quick);
  auto const study = fault_rupture::make_sand_free_field(choice);
  auto scene = benchmarks::without_provider<Scene>(choice, study);
  scene.soil.provider = study.soil;
  scarp::ThreadExecutor executor;
  auto problem = scene.problem(executor);
  LikePoints like;
  auto const began = equal_states(problem.points());
  like.strains.assign(began.size(), Strain::Zero());
  for (double const tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) like.groups.push_back({tolerance, began});
  int const groups = like.groups.front().count();
  auto report = scene.settle(problem, like);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, like));
  for (auto const& one : like.groups)
    table.add(packings, one.tolerance, began.size(), groups, one.count(),
              static_cast<double>(one.shared) / static_cast<double>(one.steps), report.load / study.ground.depth(),
              report.verdict.acceptable() ? "ok" : name(report.verdict.reason));
}

}  // namespace

/// --quick: 220 triangles with 60 grains each
int main(int argc, char** argv) try {
  bool const quick = benchmarks::is_quick(argc, argv);
  scarp::CsvTable table({"packings", "tolerance of strain", "points", "groups at the start", "groups at the end",
                         "share of DEM steps saved", "h/H", "status"});
  for (int const packings : {1, quick ? 2 : 16}) run(packings, quick, table);
  benchmarks::write_data("like_points", table.text());
  return 0;
} catch (std::exception const& problem) {
  fmt::print(stderr, "like_points: {}\n", problem.what());
  return 1;
}
