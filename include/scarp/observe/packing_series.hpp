// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/packings/packing_tables.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/run/root_rank.hpp"

namespace scarp {

/// Writes the packing of one material point, grains and contacts with their forces, at the first accepted steps at
/// which the load has come to given shares of its end: packings/NAME_k_grains.csv, _contacts.csv, _cell.csv for k = 0,
/// 1, ... and their list packings/NAME.csv. Nothing where the point carries no packing of discs or ellipses in the
/// plane.
class PackingSeries : public NeverStops {
 public:
  /// point: number of a material point, see nearest_point
  /// shares: of `to`, from 0 to 1, increasing
  /// \throws InputError for other shares, and for an end or a unit that is not positive
  PackingSeries(std::filesystem::path const& folder, std::string name, int point, double to, std::vector<double> shares,
                LoadMeasure measure)
      : folder_(folder / "packings"),
        name_(std::move(name)),
        point_(point),
        to_(require_positive("end of the load", to)),
        shares_(std::move(shares)),
        measure_(detail::validated(std::move(measure))) {
    double before = -1.0;
    for (double const share : shares_) {
      if (!(share >= 0.0 && share <= 1.0 && share > before))
        reject("packings are to be written at a share {} of the load (after {}): give increasing shares from 0 to 1",
               share, before);
      before = share;
    }
  }

  /// Writes the packing of an accepted state that has come to the next share.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    constexpr double round_off = 1e-9;  // loads that are sums of steps
    auto const due = [&] {
      return next_ < std::ssize(shares_) && report.load >= (shares_[detail::index(next_)] - round_off) * to_;
    };
    if (!report.verdict.acceptable() || !due()) return;
    while (due()) ++next_;
    write(problem, report.load);
  }

  /// Writes the last state of a run whose fault has moved and that stopped between two shares.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (load > 0.0 && load > last_) write(problem, load);
  }

  SCARP_MEMBERS_EXCEPT((folder_, name_, point_, to_, shares_, measure_), next_, last_, throws_)

 private:
  template <class Problem>
  void write(Problem const& problem, double load) {
    last_ = load;
    std::optional<PackingPicture> picture;
    visit_point(problem, detail::require_point(problem, point_),
                [&](auto const& points, int k) { picture = points.template picture<PackingPicture>(k); });
    if (!picture) return;
    make_folder(folder_);
    write_packing_tables(folder_, *picture, stem(throws_.size()));
    throws_.push_back(measure_.of(load));
    CsvTable list({measure_.name, "packing"});
    for (std::size_t k = 0; k < throws_.size(); ++k) list.add(throws_[k], stem(k));
    list.write(folder_ / (name_ + ".csv"));
  }

  std::string stem(std::size_t k) const { return fmt::format("{}_{}", name_, k); }

  std::filesystem::path folder_;
  std::string name_;
  int point_;
  double to_;
  std::vector<double> shares_;
  LoadMeasure measure_;
  int next_ = 0;
  double last_ = -1.0;
  std::vector<double> throws_{};  ///< of the packings that are written, over the unit
};

}  // namespace scarp
