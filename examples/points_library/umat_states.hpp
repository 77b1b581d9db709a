// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scarp/core/status.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/run/resources.hpp"
#include "umat_components.hpp"

namespace points_library {

/// State of a point between two calls. Never changed once it is made.
struct Snapshot {
  std::string bits;                  ///< of the material's state
  Tensor3 strain = Tensor3::Zero();  ///< total strain by the host
  std::uint64_t hash = 0;            ///< of both

  Snapshot(std::string packed, Tensor3 const& total)
      : bits(std::move(packed)),
        strain(total),
        hash(scarp::detail::hash_of(bits) ^
             scarp::detail::hash_of({reinterpret_cast<char const*>(strain.data()), sizeof strain})) {}
};
using State = std::shared_ptr<Snapshot const>;

/// The latest snapshots of each point, for hosts whose STATEV is too short for a state. A point is named by a key, a
/// snapshot by its generation. The state that a step starts from is in use, so it is never the oldest.
/// Each trial of a first step has a key of its own, which is read once the trial is committed. Of keys that were never
/// read the oldest are dropped.
class Arena {
 public:
  static constexpr std::size_t kept = 4;

  /// most: bytes of snapshots whose keys were never read
  explicit Arena(double most) : most_(most) {}

  std::uint64_t new_key() { return ++last_key_; }

  /// \throws InputError for a snapshot that is not kept
  State find(std::uint64_t key, std::uint64_t generation) {
    if (auto const point = points_.find(key); point != points_.end()) {
      auto& snapshots = point->second;
      auto const found = std::ranges::find(snapshots, generation, &std::pair<std::uint64_t, State>::first);
      if (found != snapshots.end()) {
        if (unread_.erase(key) > 0) unread_bytes_ -= size(*found->second);
        return std::rotate(found, found + 1, snapshots.end()), snapshots.back().second;
      }
    }
    scarp::reject(
        "STATEV names snapshot {} of point {} (the {} that were used last are kept, of first steps as many as fit into "
        "{:.0f} MB): give STATEV room for whole states",
        generation, key, kept, most_ / 1e6);
  }

  /// \return the generation
  std::uint64_t add(std::uint64_t key, State const& state) {
    auto& point = points_[key];
    for (auto const& one : point) {
      if (one.second == state) return one.first;
    }
    if (point.size() == kept) point.erase(point.begin());
    point.emplace_back(++last_generation_, state);
    if (point.size() == 1) add_unread(key, *state);
    return last_generation_;
  }

 private:
  static double size(Snapshot const& state) {
    constexpr double containers = 256.0;  // entries that name it, rounded up
    return containers + static_cast<double>(sizeof(Snapshot) + state.bits.size());
  }

  void add_unread(std::uint64_t key, Snapshot const& state) {
    unread_.insert(key);
    for (unread_bytes_ += size(state); unread_bytes_ > most_ && unread_.size() > 1;) {
      auto const oldest = points_.find(*unread_.begin());
      unread_bytes_ -= size(*oldest->second.front().second);
      points_.erase(oldest);
      unread_.erase(unread_.begin());
    }
  }

  std::map<std::uint64_t, std::vector<std::pair<std::uint64_t, State>>> points_;
  std::set<std::uint64_t> unread_;  ///< keys, which have one snapshot each
  double unread_bytes_ = 0.0;
  double most_;
  std::uint64_t last_key_ = 0;
  std::uint64_t last_generation_ = 0;
};

/// STATEV as states: {1, bytes, hash, hash} and the state, six bytes in each number, or {2, key, generation, session}.
/// All are whole numbers below 2^48: none is a NaN, and text of 15 digits keeps them.
class StateVariables {
 public:
  static constexpr int header = 4;

  /// \throws InputError for numbers that this class did not write
  State read(std::span<double const> statev) {
    require_room(statev.size());
    std::uint64_t const kind = whole_number(statev, 0);
    std::uint64_t const first = whole_number(statev, 1), second = whole_number(statev, 2),
                        third = whole_number(statev, 3);
    if (kind == 0 && first == 0 && second == 0 && third == 0) return nullptr;
    if (kind == whole) return unpacked(statev, first, second + (third << digits));
    if (kind != keyed) scarp::reject("STATEV begins with {} (0, 1 or 2 is expected): start with zeros", kind);
    if (third != session_)
      scarp::reject(
          "STATEV names a snapshot of another run (its states ended with it): give STATEV room for whole "
          "states to resume a run");
    std::lock_guard const lock(mutex_);
    return arena_.find(first, second);
  }

  /// statev: as it was read, with the state that the call began with
  void write(State const& state, std::span<double> statev) {
    scarp::StateWriter writer;
    writer("strain", state->strain);
    writer("bits", state->bits);
    if (numbers_of(writer.bits().size()) > statev.size()) return write_key(state, statev);
    std::array const begin{whole, std::uint64_t{writer.bits().size()}, state->hash & mask, state->hash >> digits};
    std::copy(begin.begin(), begin.end(), statev.begin());
    std::string_view rest = writer.bits();
    for (std::size_t k = header; !rest.empty(); ++k) {
      std::uint64_t number = 0;
      std::size_t const taken = std::min(bytes_each, rest.size());
      std::memcpy(&number, rest.data(), taken);
      statev[k] = static_cast<double>(number);
      rest.remove_prefix(taken);
    }
  }

  /// Length of STATEV for a whole state.
  static std::size_t numbers(Snapshot const& state) {
    scarp::StateWriter writer;
    writer("strain", state.strain);
    writer("bits", state.bits);
    return numbers_of(writer.bits().size());
  }

  static void require_room(std::size_t numbers) {
    if (numbers < header)
      scarp::reject(
          "STATEV has {} numbers (at least {} are expected, for a state that can be saved as many as "
          "scarp_umat_state_numbers returns): make it longer",
          numbers, header);
  }

 private:
  static constexpr std::uint64_t whole = 1, keyed = 2;
  static constexpr int digits = 48;
  static constexpr std::uint64_t mask = (std::uint64_t{1} << digits) - 1;
  static constexpr std::size_t bytes_each = 6;

  static std::size_t numbers_of(std::size_t bytes) { return header + (bytes + bytes_each - 1) / bytes_each; }

  static std::uint64_t whole_number(std::span<double const> statev, std::size_t k) {
    double const value = statev[k];
    if (!(value >= 0.0 && value <= static_cast<double>(mask)) || value != std::floor(value))
      scarp::reject(
          "STATEV({}) is {} (zero at first, then what this routine left is expected): leave it alone, in double "
          "precision",
          k + 1, value);
    return static_cast<std::uint64_t>(value);
  }

  [[noreturn]] static void reject_changed() {
    scarp::reject(
        "STATEV was changed since this routine wrote it (its hash does not fit; single precision changes it): leave it "
        "alone, in double precision");
  }

  static State unpacked(std::span<double const> statev, std::uint64_t length, std::uint64_t hash) {
    if (length > bytes_each * statev.size() || numbers_of(length) > statev.size())
      scarp::reject("STATEV has {} numbers (its state fills {}): pass all of them", statev.size(), numbers_of(length));
    std::string bytes(length, '\0');
    for (std::size_t at = 0, k = header; at < length; at += bytes_each, ++k) {
      std::uint64_t const number = whole_number(statev, k);
      std::memcpy(bytes.data() + at, &number, std::min(bytes_each, length - at));
    }
    Tensor3 strain = Tensor3::Zero();
    std::string bits;
    try {
      scarp::StateReader reader(bytes);
      reader("strain", strain);
      reader("bits", bits);
    } catch (scarp::InputError const&) {
      reject_changed();
    }
    auto state = std::make_shared<Snapshot const>(std::move(bits), strain);
    if (state->hash != hash) reject_changed();
    return state;
  }

  void write_key(State const& state, std::span<double> statev) {
    std::lock_guard const lock(mutex_);
    bool const known = statev[0] == static_cast<double>(keyed);
    std::uint64_t const key = known ? static_cast<std::uint64_t>(statev[1]) : arena_.new_key();
    std::array const numbers{keyed, key, arena_.add(key, state), session_};
    std::copy(numbers.begin(), numbers.end(), statev.begin());
  }

  std::mutex mutex_;
  Arena arena_{scarp::free_memory().bytes / 4.0};
  std::uint64_t session_ = (std::uint64_t{std::random_device{}()} << 16 | std::random_device{}() % 0xffff) & mask;
};

/// Outcome of a call, kept for the next one with the same request.
struct Outcome {
  Tensor3 stress = Tensor3::Zero();                                 ///< [Pa], in the material's axes
  scarp::VoigtTangent<3> tangent = scarp::VoigtTangent<3>::Zero();  ///< in the plane: its components, the others zero
  scarp::Verdict verdict{};
  State after{};
};

/// The latest outcomes by their requests, as many as fit into 256 MB.
class Memory {
 public:
  std::optional<Outcome> find(std::string const& request) {
    std::lock_guard const lock(mutex_);
    auto const found = outcomes_.find(request);
    return found == outcomes_.end() ? std::nullopt : std::optional(found->second);
  }

  void add(std::string const& request, Outcome const& outcome) {
    std::lock_guard const lock(mutex_);
    if (!outcomes_.try_emplace(request, outcome).second) return;
    order_.push_back(request);
    for (bytes_ += size(request, outcome); bytes_ > most && order_.size() > 1; order_.pop_front()) {
      auto const oldest = outcomes_.find(order_.front());
      bytes_ -= size(oldest->first, oldest->second);
      outcomes_.erase(oldest);
    }
  }

 private:
  static constexpr std::size_t most = std::size_t{256} << 20;

  static std::size_t size(std::string const& request, Outcome const& outcome) {
    return 2 * request.size() + sizeof(Outcome) + (outcome.after ? outcome.after->bits.size() : 0);
  }

  std::mutex mutex_;
  std::map<std::string, Outcome> outcomes_;
  std::deque<std::string> order_;
  std::size_t bytes_ = 0;
};

}  // namespace points_library
