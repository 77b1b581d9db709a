// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/dem/block/block_critical_step.hpp"
#include "scarp/dem/block/block_incidence.hpp"

namespace scarp {

/// Makes the list of near pairs of a block anew, as `rebuild_pairs` does; the work then has a trouble where it cannot.
/// \tparam Work a `BlockWork`
template <class Work>
class BlockList {
  using Types = typename Work::Types;
  using Shape = typename Types::Shape;
  using Scalar = typename Types::Scalar;
  using Shift = typename Work::Shift;
  static constexpr int dim = Types::dim;
  static constexpr auto axes = Work::axes;
  static constexpr int parts = Types::parts;

 public:
  /// The list of this work.
  SCARP_HOST_DEVICE constexpr explicit BlockList(Work& work) : w_(work), b_(work.bench) {}

  /// The list, the order of pairs by grains, and the critical step.
  SCARP_HOST_DEVICE constexpr void renew() {
    if (!reduce_and_wrap()) return;
    rename();
    sort_into_bins();
    count_pairs();
    if (w_.trouble != Trouble::none) return;
    write_pairs();
    detail::write_incidence(w_);
    w_.critical_step = detail::block_critical_step(w_);
    if (!(w_.critical_step > 0.0)) w_.trouble = Trouble::not_finite;
    w_.drift = 0.0;
  }

 private:
  SCARP_HOST_DEVICE constexpr bool fails(Trouble trouble) {
    w_.trouble = trouble;
    return false;
  }

  /// Reduces the cell, chooses bins and moves every grain into the cell.
  SCARP_HOST_DEVICE constexpr bool reduce_and_wrap() {
    change_ = detail::reduction_of<dim>(w_.cell);
    auto const reduced = detail::product_of<dim>(w_.cell, change_);
    if (!(detail::determinant_of<dim>(reduced) > 0.0)) return fails(Trouble::cell_collapsed);
    inverse_ = detail::inverse_of<dim>(reduced);
    double const search = 2.0 * w_.grains.largest_radius + w_.skin + w_.reach;
    double narrowest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < axes; ++a) {
      double squared = 0.0;
      for (std::size_t k = 0; k < axes; ++k) squared += inverse_[a * axes + k] * inverse_[a * axes + k];
      double const height = 1.0 / std::sqrt(squared);
      narrowest = height < narrowest ? height : narrowest;
      double const fit = std::floor(height / search);
      bins_[a] = fit < 1.0 ? 1 : fit > 255.0 ? 255 : static_cast<int>(fit);
    }
    if (!(narrowest > search)) return fails(Trouble::cell_collapsed);
    while (bin_count() > w_.grain_count && bin_count() > 1) {
      for (auto& bins : bins_) bins = bins > 1 ? bins - 1 : 1;
    }
    w_.cell = reduced;
    constexpr double farthest_cell = 1e6;
    double farthest = 0.0;
    each(w_.team, w_.grain_count, [&](int i) {
      for (std::size_t a = 0; a < axes; ++a) {
        double const cells = std::floor(fraction(i, a));
        double const size = cells < 0.0 ? -cells : cells;
        if (farthest == farthest && !(size <= farthest)) farthest = size;  // not-a-number stays
        b_.moved(a, i) = size <= farthest_cell ? static_cast<int>(cells) : 0;
      }
      for (std::size_t a = 0; a < axes; ++a) {
        double place = static_cast<double>(b_.position(a, i));
        for (std::size_t k = 0; k < axes; ++k) place -= reduced[a * axes + k] * static_cast<double>(b_.moved(k, i));
        b_.position(a, i) = static_cast<Scalar>(place);
      }
    });
    w_.write_offsets();
    auto const worst = std::bit_cast<double>(w_.team.largest(std::array{ordered_bits(farthest)})[0]);
    if (!(worst <= farthest_cell)) return fails(worst == worst ? Trouble::lost_grain : Trouble::not_finite);
    return true;
  }

  /// Coordinate of a grain along a base vector of the cell.
  SCARP_HOST_DEVICE constexpr double fraction(int i, std::size_t a) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < axes; ++k) sum += inverse_[a * axes + k] * static_cast<double>(b_.position(k, i));
    return sum;
  }

  /// Gives the present pairs the names that they have in the new cell; the bins follow with their barriers.
  SCARP_HOST_DEVICE constexpr void rename() {
    auto const old_to_new = detail::adjugate_of<dim>(change_);  // its determinant is one
    each(w_.team, w_.pair_count, [&](int p) {
      int const first = b_.first[p];
      int const second = b_.second[p];
      auto const old = Work::shift_of(b_.shift[p]);
      Shift shift{};
      for (std::size_t a = 0; a < axes; ++a) {
        double there = 0.0;
        for (std::size_t k = 0; k < axes; ++k) there += old_to_new[a * axes + k] * static_cast<double>(old[k]);
        shift[a] = static_cast<int>(there) + b_.moved(a, second / parts) - b_.moved(a, first / parts);
      }
      int const sign = Work::sign_of(shift);
      if (sign < 0 || (sign == 0 && first > second)) {
        b_.first[p] = static_cast<std::uint16_t>(second);
        b_.second[p] = static_cast<std::uint16_t>(first);
        for (auto& component : shift) component = -component;
        for (int k = 0; k < Types::normals; ++k) b_.normal(k, p) = -b_.normal(k, p);
        constexpr int from = dim == 3 ? 0 : Types::shears;  // the plane's tangent turns round with the normal
        for (int k = from; k < Types::shears + Types::moments; ++k) b_.memory(k, p) = -b_.memory(k, p);
      }
      b_.shift[p] = static_cast<std::uint8_t>(Work::code_of(shift));
    });
  }

  SCARP_HOST_DEVICE constexpr int bin_count() const {
    int product = 1;
    for (int const bins : bins_) product *= bins;
    return product;
  }
  SCARP_HOST_DEVICE constexpr Shift bin_of(int i) const {
    Shift bin{};
    for (std::size_t a = 0; a < axes; ++a) {
      int const at = static_cast<int>(std::floor(fraction(i, a) * bins_[a]));
      bin[a] = at < 0 ? 0 : at < bins_[a] ? at : bins_[a] - 1;
    }
    return bin;
  }

  /// Orders grains by bins, those of one bin by number.
  SCARP_HOST_DEVICE constexpr void sort_into_bins() {
    each(w_.team, w_.grain_count, [&](int i) {
      auto const bin = bin_of(i);
      int number = 0;
      for (std::size_t a = axes; a-- > 0;) number = number * bins_[a] + bin[a];
      b_.bin[i] = static_cast<std::uint16_t>(number);
    });
    w_.team.barrier();
    each(w_.team, w_.grain_count, [&](int i) {
      int const own = b_.bin[i];
      int before = 0;
      for (int j = 0; j < w_.grain_count; ++j) before += b_.bin[j] < own || (b_.bin[j] == own && j < i) ? 1 : 0;
      b_.order[before] = static_cast<std::uint16_t>(i);
    });
    w_.team.barrier();
  }

  /// First place in `order` of a bin that is not below this one.
  SCARP_HOST_DEVICE constexpr int start_of(int bin) const {
    int low = 0;
    int high = w_.grain_count;
    while (low < high) {
      int const middle = (low + high) / 2;
      if (b_.bin[b_.order[middle]] < bin) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

  /// Number of a pair in the former list, or -1. first, second: rows
  SCARP_HOST_DEVICE constexpr int former(int first, int second, int shift) const {
    int const grain = first / parts;
    for (int k = b_.begin[grain]; k < b_.begin[grain + 1]; ++k) {
      int const p = b_.incident[k] / 2;
      if (b_.first[p] == first && b_.second[p] == second && b_.shift[p] == shift) return p;
    }
    return -1;
  }

  /// Calls visit(first row, second row, image, touch, former pair or -1) for the near pairs whose first grain is i.
  template <class Visit>
  SCARP_HOST_DEVICE constexpr void visit_near(int i, Visit const& visit) {
    auto const home = bin_of(i);
    for (int code = 0; code < Types::shifts; ++code) {
      auto const step = Work::shift_of(code);
      Shift shift{};
      int number = 0;
      for (std::size_t a = axes; a-- > 0;) {
        int at = home[a] + step[a];
        shift[a] = at < 0 ? -1 : at >= bins_[a] ? 1 : 0;
        at -= shift[a] * bins_[a];
        number = number * bins_[a] + at;
      }
      int const sign = Work::sign_of(shift);
      if (sign < 0) continue;
      int const image = Work::code_of(shift);
      for (int k = start_of(number); k < w_.grain_count && b_.bin[b_.order[k]] == number; ++k) {
        int const j = b_.order[k];
        if (sign > 0 || j > i) visit_parts(i, j, image, visit);
      }
    }
  }
  template <class Visit>
  SCARP_HOST_DEVICE constexpr void visit_parts(int i, int j, int image, Visit const& visit) {
    auto const branch = w_.template branch<double>(i, j, image);
    double const squared = dot(branch, branch);
    double const reach = w_.skin + w_.reach;
    double const touching = w_.grains.bounding_radius[i] + w_.grains.bounding_radius[j] + reach;
    if (squared > touching * touching) return;
    double const distance = std::sqrt(squared);
    for (int first = i * parts; first < (i + 1) * parts; ++first) {
      for (int second = j * parts; second < (j + 1) * parts; ++second) {
        int const known = former(first, second, image);
        Point<dim, double> start{};
        for (std::size_t a = 0; a < axes; ++a) start[a] = distance > 0.0 ? branch[a] / distance : (a == 0 ? 1.0 : 0.0);
        if (Types::normals > 0 && known >= 0) start = w_.template normal<double>(known);
        auto const converged =
            converged_touch<Shape>(w_.template pose<double>(first), w_.template pose<double>(second), branch, start);
        if (converged.is_certain && converged.touch.overlap < -reach) continue;
        visit(first, second, image, converged, known);
      }
    }
  }

  SCARP_HOST_DEVICE constexpr void count_pairs() {
    bool is_certain = true;
    each(w_.team, w_.grain_count, [&](int i) {
      int found = 0;
      visit_near(i, [&](int, int, int, ConvergedTouch<dim> const& converged, int) {
        ++found;
        is_certain = is_certain && converged.is_certain;
      });
      b_.count[i] = found;
    });
    auto const uncertain = w_.team.largest(std::array{is_certain ? std::uint64_t{0} : std::uint64_t{1}})[0];
    if (uncertain != 0) {
      w_.trouble = Trouble::unconverged_touch;
      return;
    }
    next_count_ = 0;
    for (int k = 0; k < w_.grain_count; ++k) next_count_ += b_.count[k];
    if (next_count_ > b_.pairs) w_.trouble = Trouble::list_full;
  }

  /// Writes the list, sorted by names: it follows from the pairs alone, and with it every sum of forces.
  /// `write_incidence` follows with its barriers.
  SCARP_HOST_DEVICE constexpr void write_pairs() {
    each(w_.team, w_.grain_count, [&](int i) {
      int at = 0;
      for (int k = 0; k < i; ++k) at += b_.count[k];
      int const start = at;
      visit_near(i, [&](int first, int second, int image, ConvergedTouch<dim> const& converged, int known) {
        int to = at++;
        for (; to > start &&
               name(b_.new_first[to - 1], b_.new_second[to - 1], b_.new_shift[to - 1]) > name(first, second, image);
             --to)
          copy_new(to - 1, to);
        b_.new_first[to] = static_cast<std::uint16_t>(first);
        b_.new_second[to] = static_cast<std::uint16_t>(second);
        b_.new_shift[to] = static_cast<std::uint8_t>(image);
        for (int k = 0; k < Types::normals; ++k)
          b_.new_normal(k, to) = static_cast<Scalar>(converged.touch.normal[static_cast<std::size_t>(k)]);
        for (int k = 0; k < Types::memories; ++k) b_.new_memory(k, to) = known >= 0 ? b_.memory(k, known) : Scalar(0);
      });
    });
    w_.team.barrier();
    w_.pair_count = next_count_;
    each(w_.team, w_.pair_count, [&](int p) {
      b_.first[p] = b_.new_first[p];
      b_.second[p] = b_.new_second[p];
      b_.shift[p] = b_.new_shift[p];
      for (int k = 0; k < Types::normals; ++k) b_.normal(k, p) = b_.new_normal(k, p);
      for (int k = 0; k < Types::memories; ++k) b_.memory(k, p) = b_.new_memory(k, p);
    });
  }
  static SCARP_HOST_DEVICE constexpr std::int64_t name(int first, int second, int image) {
    return (static_cast<std::int64_t>(first) << 32) + (second << 8) + image;
  }
  SCARP_HOST_DEVICE constexpr void copy_new(int from, int to) const {
    b_.new_first[to] = b_.new_first[from];
    b_.new_second[to] = b_.new_second[from];
    b_.new_shift[to] = b_.new_shift[from];
    for (int k = 0; k < Types::normals; ++k) b_.new_normal(k, to) = b_.new_normal(k, from);
    for (int k = 0; k < Types::memories; ++k) b_.new_memory(k, to) = b_.new_memory(k, from);
  }

  Work& w_;
  decltype(Work::bench) const& b_;
  detail::SmallTensor<dim> change_{};   // from the reduced cell to the former one
  detail::SmallTensor<dim> inverse_{};  // of the reduced cell
  Shift bins_{};                        // along each base vector
  int next_count_ = 0;
};

}  // namespace scarp
