// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"

namespace scarp {

/// A list that only grows, cheap to copy: copies share the rows that they have in common, and none sees what another adds.
/// Different threads may use different lists, whatever these share.
template <class Row>
class SharedHistory {
 public:
  SharedHistory() = default;
  SharedHistory(SharedHistory const&) = default;
  SharedHistory(SharedHistory&&) noexcept = default;
  SharedHistory& operator=(SharedHistory const& other) {
    SharedHistory copy(other);
    std::swap(last_, copy.last_);
    return *this;
  }
  SharedHistory& operator=(SharedHistory&& other) noexcept {
    std::swap(last_, other.last_);
    return *this;
  }

  /// Lets go row by row: nested destructors of a long list would exhaust the stack.
  ~SharedHistory() {
    while (last_ && last_.use_count() == 1) {
      std::atomic_thread_fence(std::memory_order_acquire);
      last_ = std::exchange(last_->before, nullptr);
    }
  }

  bool empty() const { return last_ == nullptr; }
  std::size_t size() const { return last_ ? last_->number : 0; }
  Row const& back() const { return last_->row; }
  void push_back(Row row) { last_ = std::make_shared<Link>(std::move(row), size() + 1, last_); }

  /// In the order in which they came.
  std::vector<Row> rows() const {
    std::vector<Row> rows;
    rows.reserve(size());
    for (Link const* link = last_.get(); link != nullptr; link = link->before.get()) rows.push_back(link->row);
    std::reverse(rows.begin(), rows.end());
    return rows;
  }

  /// Rows that come back are in memory of their own.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(last_);
    std::vector<Row> rows = self.rows();
    visit("rows", rows);
    if constexpr (!std::is_const_v<Self>) {
      self = {};
      for (Row& row : rows) self.push_back(std::move(row));
    }
  }

  /// Whether both are the same rows in the same memory.
  friend bool operator==(SharedHistory const&, SharedHistory const&) = default;

  /// Whether all rows of `earlier` are this list's first ones, in the same memory.
  bool continues(SharedHistory const& earlier) const {
    Link const* link = last_.get();
    while (link != nullptr && link->number > earlier.size()) link = link->before.get();
    return link == earlier.last_.get();
  }

 private:
  struct Link {
    Link(Row added, std::size_t count, std::shared_ptr<Link> former)
        : row(std::move(added)), number(count), before(std::move(former)) {}
    Row row;
    std::size_t number;  ///< of rows up to this one
    std::shared_ptr<Link> before;
  };

  std::shared_ptr<Link> last_;
};

}  // namespace scarp
