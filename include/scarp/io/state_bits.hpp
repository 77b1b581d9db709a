// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/simd/soa_array.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

namespace detail {

template <class T>
struct IsFlat : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <class T, std::size_t Count>
struct IsFlat<std::array<T, Count>> : IsFlat<T> {};
template <class T, int Rows, int Columns>
struct IsFlat<Eigen::Matrix<T, Rows, Columns>>
    : std::bool_constant<(Rows > 0 && Columns > 0) && sizeof(Eigen::Matrix<T, Rows, Columns>) ==
                                                          sizeof(T) * static_cast<std::size_t>(Rows* Columns)> {};

/// Numbers without gaps between them: their bytes are their value.
template <class T>
concept Flat = IsFlat<T>::value;

inline constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

}  // namespace detail

/// Appends the bits of all members that a described type names. In front of each stands its name with the bytes of one
/// element, arrays follow behind their length; what several members share is stored once.
class StateWriter {
 public:
  /// Appends bytes without a name.
  void put(void const* values, std::size_t bytes) {
    if (bytes > 0) bits_.append(static_cast<char const*>(values), bytes);
  }

  /// Number, enumeration or array of fixed size: its bytes.
  template <detail::Flat T>
  void operator()(std::string_view name, T const& value) {
    label(name, sizeof(T));
    put(&value, sizeof(T));
  }
  /// Text: its length, then its bytes.
  void operator()(std::string_view name, std::string const& text) { list(name, std::span<char const>(text)); }
  /// List: its length, then the elements.
  template <class T, class Allocator>
  void operator()(std::string_view name, std::vector<T, Allocator> const& values) {
    list(name, std::span<T const>(values));
  }
  /// List: its length, then the elements.
  template <class T>
  void operator()(std::string_view name, std::span<T> values) {
    list(name, std::span<T const>(values));
  }
  /// Length, then all columns with their padding.
  template <class Scalar, int Count>
  void operator()(std::string_view name, SoaArray<Scalar, Count> const& columns) {
    if constexpr (Count > 0) {
      label(name, sizeof(Scalar) * Count);
      put_length(columns.rows());
      // All values, the padding too: it takes part in comparisons.
      put(columns.column(0), columns.padded_rows() * Count * sizeof(Scalar));
    }
  }
  /// Number of a shared part; its members follow where it is met for the first time. Null has a number of its own.
  template <class T>
  void operator()(std::string_view name, std::shared_ptr<T const> const& shared) {
    if (!shared) return (*this)(name, detail::no_number);
    auto const [known, is_new] = numbers_.try_emplace(shared.get(), static_cast<std::uint32_t>(numbers_.size()));
    (*this)(name, known->second);
    if (is_new) T::members(*shared, *this);
  }
  /// Both parts as "first" and "second".
  template <class First, class Second>
  void operator()(std::string_view, std::pair<First, Second> const& both) {
    (*this)("first", both.first);
    (*this)("second", both.second);
  }
  /// Members of a described type; its own name is not stored.
  template <Described T>
  void operator()(std::string_view, T const& value) {
    T::members(value, *this);
  }

  std::string const& bits() const { return bits_; }  ///< What has been written so far.
  std::string& bits() { return bits_; }              ///< What has been written so far, to be moved out.

 private:
  void put_length(std::size_t length) {
    auto const stored = static_cast<std::uint64_t>(length);
    put(&stored, sizeof(stored));
  }

  void label(std::string_view name, std::size_t element) {
    auto const letters = static_cast<std::uint8_t>(name.size());
    auto const bytes = static_cast<std::uint32_t>(element);
    put(&letters, sizeof(letters));
    put(name.data(), letters);
    put(&bytes, sizeof(bytes));
  }

  template <class T>
  void list(std::string_view name, std::span<T const> values) {
    constexpr bool flat = detail::Flat<T>;
    label(name, flat ? sizeof(T) : 0);
    put_length(values.size());
    if constexpr (flat) {
      put(values.data(), values.size_bytes());
    } else {
      for (T const& value : values) (*this)(name, value);
    }
  }

  std::string bits_;
  std::map<void const*, std::uint32_t> numbers_;
};

/// Shared parts that readers have met, so that what several bits share is shared again by the states made from them. Of
/// parts that hold no shared parts themselves.
using SharedParts = std::map<std::pair<std::type_index, std::string>, std::weak_ptr<void const>>;

/// Reads members from bits in the order of the writer.
/// \throws InputError naming the member where the bits end too early, are another member's or have another length
class StateReader {
 public:
  /// known: parts that replace equal ones; new ones are added
  explicit StateReader(std::string_view bits, SharedParts* known = nullptr) : rest_(bits), known_(known) {}

  bool at_end() const { return rest_.empty(); }  ///< Whether all bits have been read.

  /// count values of the given bytes each, in any memory
  void take(std::string_view name, void* values, std::size_t bytes, std::size_t count = 1) {
    if (count > rest_.size() / bytes) {
      reject("it ends inside '{}' (for {} numbers of {} bytes only {} bytes are left): save it again", name, count,
             bytes, rest_.size());
    }
    if (count > 0) std::memcpy(values, rest_.data(), count * bytes);
    rest_.remove_prefix(count * bytes);
  }

  /// Number, enumeration or array of fixed size, from its bytes.
  template <detail::Flat T>
  void operator()(std::string_view name, T& value) {
    expect(name, sizeof(T));
    take(name, &value, sizeof(T));
  }
  /// \throws InputError for a byte that is neither 0 nor 1
  void operator()(std::string_view name, bool& value) {
    std::uint8_t stored = 0;
    expect(name, sizeof(value));
    take(name, &stored, sizeof(stored));
    if (stored > 1) reject("'{}' is {} (it can be 0 or 1): save it again", name, stored);
    value = stored == 1;
  }
  /// Text of the stored length.
  void operator()(std::string_view name, std::string& text) {
    expect(name, sizeof(char));
    text.resize(take_length(name, sizeof(char)));
    take(name, text.data(), sizeof(char), text.size());
  }
  /// List of the stored length; existing elements are overwritten.
  template <class T, class Allocator>
  void operator()(std::string_view name, std::vector<T, Allocator>& values) {
    expect_list<T>(name);
    std::size_t const length = take_length(name, element_bytes<T>());
    if constexpr (detail::Flat<T>) {
      values.resize(length);
      elements(name, std::span<T>(values));
    } else {
      // One by one: what a false length promises is never made room for.
      values.resize(std::min(length, values.size()));
      for (std::size_t k = 0; k < length; ++k) {
        if (k == values.size()) values.emplace_back();
        (*this)(name, values[k]);
      }
    }
  }
  /// As many as there are: they belong to a scene with their number.
  template <class T>
  void operator()(std::string_view name, std::span<T> values) {
    expect_list<T>(name);
    std::size_t const length = take_length(name, element_bytes<T>());
    if (length != values.size())
      reject("it has {} '{}' (the scene has {}): load it into the scene that was saved", length, name, values.size());
    elements(name, values);
  }
  /// Resized to the stored length; columns with their padding.
  template <class Scalar, int Count>
  void operator()(std::string_view name, SoaArray<Scalar, Count>& columns) {
    if constexpr (Count > 0) {
      expect(name, sizeof(Scalar) * Count);
      columns.resize(take_length(name, sizeof(Scalar)));
      take(name, columns.column(0), sizeof(Scalar), columns.padded_rows() * Count);
    }
  }
  /// T::restored(reader) makes the shared object from its members.
  template <class T>
  void operator()(std::string_view name, std::shared_ptr<T const>& shared) {
    std::uint32_t number = 0;
    (*this)(name, number);
    shared.reset();
    if (number == detail::no_number) return;
    if (number == shared_.size()) {
      shared_.emplace_back(typeid(T), nullptr);  // its parts have higher numbers, as they had for the writer
      std::string_view const from = rest_;
      shared_[number].second = T::restored(*this);
      if (known_) intern(shared_[number], from.substr(0, from.size() - rest_.size()));
    }
    if (number >= shared_.size() || shared_[number].first != typeid(T) || !shared_[number].second) {
      reject("'{}' is number {} of the shared parts (there is none of this kind): save it again", name, number);
    }
    shared = std::static_pointer_cast<T const>(shared_[number].second);
  }
  /// Both parts from "first" and "second".
  template <class First, class Second>
  void operator()(std::string_view, std::pair<First, Second>& both) {
    (*this)("first", both.first);
    (*this)("second", both.second);
  }
  /// Members of a described type; then after_loading(), where the type has it.
  template <Described T>
  void operator()(std::string_view, T& value) {
    T::members(value, *this);
    if constexpr (requires { value.after_loading(); }) value.after_loading();
  }

 private:
  template <class T>
  static constexpr std::size_t element_bytes() {
    return detail::Flat<T> ? sizeof(T) : 1;
  }

  template <class T>
  void expect_list(std::string_view name) {
    expect(name, detail::Flat<T> ? sizeof(T) : 0);
  }

  template <class T>
  void elements(std::string_view name, std::span<T> values) {
    if constexpr (detail::Flat<T>) {
      take(name, values.data(), sizeof(T), values.size());
    } else {
      for (T& value : values) (*this)(name, value);
    }
  }

  void expect(std::string_view name, std::size_t element) {
    std::uint8_t letters = 0;
    std::uint32_t bytes = 0;
    take(name, &letters, sizeof(letters));
    std::string saved(letters, '\0');
    take(name, saved.data(), sizeof(char), letters);
    take(name, &bytes, sizeof(bytes));
    if (saved != name || bytes != element) {
      std::ranges::replace_if(
          saved, [](unsigned char letter) { return letter < ' ' || letter > '~'; }, '?');
      reject("it has '{}' of {} bytes where '{}' of {} bytes should be: load it as the type that was saved", saved,
             bytes, name, element);
    }
  }

  /// A length that the rest has room for, so that no damaged file requests endless memory.
  std::size_t take_length(std::string_view name, std::size_t bytes) {
    std::uint64_t length = 0;
    take(name, &length, sizeof(length));
    if (length > rest_.size() / bytes)
      reject("'{}' has a length of {} (only {} bytes follow): save it again", name, length, rest_.size());
    return static_cast<std::size_t>(length);
  }

  void intern(std::pair<std::type_index, std::shared_ptr<void const>>& part, std::string_view bits) {
    std::erase_if(*known_, [](auto const& one) { return one.second.expired(); });
    auto& known = (*known_)[{part.first, std::string(bits)}];
    if (auto const same = known.lock()) part.second = same;
    known = part.second;
  }

  std::string_view rest_;
  SharedParts* known_;
  std::vector<std::pair<std::type_index, std::shared_ptr<void const>>> shared_;
};

}  // namespace scarp
