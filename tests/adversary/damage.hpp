// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/core/random.hpp"

namespace adversary {

inline std::size_t below(scarp::Random& random, std::size_t limit) { return limit == 0 ? 0 : random.next() % limit; }

template <class T>
T const& one_of(scarp::Random& random, std::vector<T> const& choices) {
  return choices[below(random, choices.size())];
}

/// Does to a valid file what accidents, other programs and foes do: bits, bytes, pieces, lines, columns, numbers as
/// text and as bytes. What is drawn depends on the random numbers alone.
class Damage {
 public:
  /// samples: valid files
  Damage(std::vector<std::string> const& samples, scarp::Random& random) : samples_(samples), random_(random) {}

  /// Mostly a few changes, now and then none or many.
  std::string file() {
    std::string bytes = one_of(random_, samples_);
    std::size_t changes = below(random_, 4);
    if (below(random_, 20) == 0) changes += below(random_, 30);
    for (; changes > 0; --changes) change(bytes);
    if (bytes.size() > longest) bytes.resize(longest);
    return bytes;
  }

 private:
  static constexpr std::size_t longest = 1 << 18;

  void change(std::string& bytes) {
    switch (below(random_, 14)) {
      case 0:
        if (auto* byte = any(bytes)) *byte = static_cast<char>(*byte ^ (1 << below(random_, 8)));
        break;
      case 1:
        if (auto* byte = any(bytes)) *byte = static_cast<char>(below(random_, 256));
        break;
      case 2: bytes.erase(place(bytes), 1 + below(random_, 16)); break;
      case 3: bytes.resize(place(bytes)); break;
      case 4: splice(bytes); break;
      case 5: repeat(bytes); break;
      case 6: number_as_bytes(bytes); break;
      case 7:
      case 8:
      case 9: number_as_text(bytes); break;
      case 10:
      case 11: lines(bytes); break;
      case 12: columns(bytes); break;
      default: bytes.insert(place(bytes), one_of(random_, snags())); break;
    }
  }

  std::size_t place(std::string const& bytes) { return below(random_, bytes.size() + 1); }
  char* any(std::string& bytes) { return bytes.empty() ? nullptr : &bytes[below(random_, bytes.size())]; }

  /// A piece of this or another file, in the place of nothing or of as much.
  void splice(std::string& bytes) {
    std::string const& other = one_of(random_, samples_);
    std::string const piece = other.substr(place(other), 1 + below(random_, 200));
    bytes.replace(place(bytes), below(random_, 2) * piece.size(), piece);
  }

  void repeat(std::string& bytes) {
    std::size_t const at = place(bytes);
    std::string const piece = bytes.substr(at, 1 + below(random_, 30));
    std::string many;
    for (std::size_t k = 1 + below(random_, 200); k > 0; --k) many += piece;
    bytes.insert(at, many);
  }

  void number_as_bytes(std::string& bytes) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::array numbers{nan, infinity, -infinity, 1e308, -1e308, 1e-320, 0.0, -0.0, -1.0, 1e18, 1e7};
    static constexpr std::array<std::uint64_t, 16> wholes{
        0,           1,          2,          3,          7,          255,        65535,     1U << 30U,
        0x7fffffffU, 1ULL << 31, 0xffffffff, 1ULL << 32, 1ULL << 62, 1ULL << 63, ~0ULL - 1, ~0ULL};
    std::array<char, 8> raw{};
    std::size_t length = 8;
    if (below(random_, 2) == 0) {
      std::memcpy(raw.data(), &numbers[below(random_, numbers.size())], 8);
    } else {
      std::memcpy(raw.data(), &wholes[below(random_, wholes.size())], 8);
      length = std::array<std::size_t, 3>{1, 4, 8}[below(random_, 3)];
    }
    std::size_t at = place(bytes);
    if (below(random_, 2) == 0) at -= at % 4;
    for (std::size_t k = 0; k < length && at + k < bytes.size(); ++k) bytes[at + k] = raw[k];
  }

  static bool is_of_number(char letter) {
    return (letter >= '0' && letter <= '9') || letter == '.' || letter == '-' || letter == '+' || letter == 'e';
  }

  /// Another one in the place of a number.
  void number_as_text(std::string& bytes) {
    std::size_t begin = place(bytes);
    while (begin < bytes.size() && !is_of_number(bytes[begin])) ++begin;
    while (begin > 0 && begin <= bytes.size() && is_of_number(bytes[begin - 1])) --begin;
    std::size_t end = begin;
    while (end < bytes.size() && is_of_number(bytes[end])) ++end;
    bytes.replace(begin, end - begin, one_of(random_, texts()));
  }

  void lines(std::string& bytes) {
    auto const [begin, end] = line_at(bytes, place(bytes));
    std::string const line = bytes.substr(begin, end - begin);
    auto const choice = below(random_, 3);
    if (choice != 1) bytes.erase(begin, end - begin);
    if (choice != 0) bytes.insert(line_at(bytes, place(bytes)).first, line);
  }

  static std::pair<std::size_t, std::size_t> line_at(std::string const& bytes, std::size_t at) {
    std::size_t const before = at == 0 ? std::string::npos : bytes.rfind('\n', at - 1);
    std::size_t const after = bytes.find('\n', at);
    return {before == std::string::npos ? 0 : before + 1, after == std::string::npos ? bytes.size() : after + 1};
  }

  /// Takes a column out of every line, doubles it or gives it another one's place.
  void columns(std::string& bytes) {
    char const separator = bytes.find(',') != std::string::npos ? ',' : ' ';
    std::size_t const column = below(random_, 8);
    std::size_t const other = below(random_, 8);
    auto const choice = below(random_, 3);
    std::string changed;
    for (std::size_t at = 0; at < bytes.size();) {
      std::size_t const end = std::min(bytes.find('\n', at), bytes.size());
      std::vector<std::string> cells(1);
      for (char const letter : std::string_view(bytes).substr(at, end - at)) {
        if (letter == separator) {
          cells.emplace_back();
        } else {
          cells.back() += letter;
        }
      }
      if (column < cells.size() && other < cells.size()) {
        auto const chosen = cells.begin() + static_cast<std::ptrdiff_t>(column);
        if (choice == 0)
          cells.erase(chosen);
        else if (choice == 1)
          cells.insert(chosen, std::string(*chosen));
        else
          std::swap(cells[column], cells[other]);
      }
      for (std::size_t k = 0; k < cells.size(); ++k) changed += (k == 0 ? "" : std::string(1, separator)) + cells[k];
      if (end < bytes.size()) changed += '\n';
      at = end + 1;
    }
    bytes = std::move(changed);
  }

  static std::vector<std::string> const& texts() {
    static std::vector<std::string> const all{
        "nan",
        "inf",
        "-inf",
        "-1",
        "0",
        "-0",
        "1",
        "2",
        "3",
        "2147483647",
        "2147483648",
        "-2147483648",
        "4294967295",
        "4294967296",
        "9223372036854775807",
        "9223372036854775808",
        "-9223372036854775808",
        "18446744073709551615",
        "18446744073709551616",
        "1e308",
        "-1e308",
        "1e309",
        "1e-320",
        "1e154",
        "1e-160",
        "1e18",
        "1e7",
        "1e-7",
        "0.5",
        "0x10",
        "1,5",
        "1e",
        "",
        "+",
        "-",
        "--1",
        "1.2.3",
        "00000000000000000000000001",
        "0.1000000000000000055511151231257827021181583404541015625000000000000000001"};
    return all;
  }

  /// What formats are made of, where it does not belong.
  static std::vector<std::string> const& snags() {
    static std::vector<std::string> const all{"\"",
                                              "\"\"",
                                              ",",
                                              "\n",
                                              "\r\n",
                                              "\r",
                                              "\t",
                                              " ",
                                              "#",
                                              "$",
                                              "$End",
                                              "$Nodes\n",
                                              "$Elements\n",
                                              "{",
                                              "}",
                                              "[",
                                              "]",
                                              ":",
                                              "\\",
                                              "\\u12",
                                              "\\",
                                              std::string(1, '\0'),
                                              "\xEF\xBB\xBF",
                                              "\xff\xfe",
                                              "=",
                                              ";",
                                              "%",
                                              "{}",
                                              "é",
                                              "[shear]\n",
                                              "../",
                                              std::string(300, 'x'),
                                              std::string(5000, '{'),
                                              std::string(5000, '['),
                                              std::string(2000, ','),
                                              std::string(2000, '"')};
    return all;
  }

  std::vector<std::string> const& samples_;
  scarp::Random& random_;
};

}  // namespace adversary
