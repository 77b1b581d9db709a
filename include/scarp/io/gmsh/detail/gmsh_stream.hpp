// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/io/text_lines.hpp"

namespace scarp::detail {

/// Reads a Gmsh file from front to back: its numbers stand there as words or, where `be_binary` was called, as bytes.
/// Every call throws InputError naming the line, or byte in binary files, where something else stands.
class GmshStream {
 public:
  /// content: of the file; file: its name in messages
  GmshStream(std::string content, std::string file) : content_(std::move(content)), file_(std::move(file)) {
    if (content_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark that editors write
  }

  std::string const& file() const { return file_; }
  bool binary() const { return binary_; }

  /// swapped: the bytes of a number run the other way than on this machine
  void be_binary(bool swapped) {
    binary_ = true;
    swapped_ = swapped;
  }

  /// Where the last value began, such as "line 12 of 'a.msh'".
  std::string place() const {
    if (binary_) return fmt::format("byte {} of '{}'", last_, file_);
    auto const begin = content_.begin();
    auto const lines = std::count(begin, begin + static_cast<std::ptrdiff_t>(last_), '\n');
    return fmt::format("line {} of '{}'", lines + 1, file_);
  }

  /// Name of the section that begins here, without its '$'; empty at the end of the file.
  /// Before the first section stands what scripts put there; later only comments, which begin with // or #.
  std::string next_section() {
    skip_blanks();
    if (!at_section_) skip_preface();
    while (content_.compare(at_, 2, "//") == 0 || content_.compare(at_, 1, "#") == 0) {
      to_next_line();
      skip_blanks();
    }
    last_ = at_;
    if (at_ == content_.size()) return {};
    if (content_[at_] != '$') {
      reject("{} has '{}' (a section such as $Nodes must begin): {}", place(), shown(peek_word()),
             at_section_ ? "check the counts of the section before it"
                         : "give a mesh of Gmsh, which begins with $MeshFormat");
    }
    at_section_ = true;
    std::string name(next_word("the name of a section").substr(1));
    to_next_line();
    return name;
  }

  void end_section(std::string_view name) {
    auto const word = next_word("the end of a section");
    if (word != fmt::format("$End{}", name)) {
      reject("{} has '{}' ($End{} must follow): check the counts of the section", place(), shown(word), name);
    }
  }

  /// Goes behind a section whose content does not matter.
  void skip_section(std::string_view name) {
    auto const end = fmt::format("$End{}", name);
    auto const found = content_.find(end, at_);
    if (found == std::string::npos) {
      reject("{} begins the section ${} (the file ends before {}): write it again", place(), shown(name), shown(end));
    }
    at_ = found + end.size();
  }

  /// Whether a text stands in the next lines.
  bool mentions(std::string_view text) const {
    constexpr std::size_t near = 100;
    return std::string_view(content_).substr(at_, near).find(text) != std::string_view::npos;
  }

  /// A number in whatever form the file has.
  template <class Number>
  Number value(std::string_view what) {
    return binary_ ? bytes<Number>(what) : text<Number>(what);
  }

  /// A number that stands as a word in binary files too.
  template <class Number>
  Number text(std::string_view what) {
    auto const whole = next_word(what);
    auto word = whole;
    std::string fortran;
    if (auto const at = whole.find_first_of("Dd"); std::floating_point<Number> && at != std::string_view::npos) {
      fortran = whole;
      fortran[at] = 'e';
      word = fortran;
    }
    Number number{};
    if (read_number(word, number) != std::errc{}) {
      reject("{} has '{}' for {} (it is no {}): check the line and the counts of its section", place(), shown(whole),
             what, std::floating_point<Number> ? "number" : "whole number that can stand here");
    }
    return number;
  }

  /// How many entries of at least `numbers` numbers each follow; rejected where the file is too short for them, so that
  /// nobody makes room for a damaged count.
  std::size_t count(std::string_view what, std::size_t numbers) {
    return checked_count(value<std::uint64_t>(what), what, numbers);
  }
  std::size_t text_count(std::string_view what, std::size_t numbers) {
    return checked_count(text<std::uint64_t>(what), what, numbers);
  }
  std::size_t checked_count(std::uint64_t entries, std::string_view what, std::size_t numbers) {
    std::size_t const least = 2 * std::max<std::size_t>(numbers, 1);  // a digit and a blank
    if (entries > (content_.size() - at_) / least + 1 || entries > std::numeric_limits<int>::max()) {
      reject("{} says {} for {} (only {} bytes follow): the file is cut off or damaged, write it again", place(),
             entries, what, content_.size() - at_);
    }
    return static_cast<std::size_t>(entries);
  }

  /// What stands between the first and the last quotes of this line.
  std::string quoted(std::string_view what) {
    skip_blanks();
    last_ = at_;
    std::size_t const end = std::min(content_.find('\n', at_), content_.size());
    auto const line = std::string_view(content_).substr(at_, end - at_);
    auto const open = line.find('"');
    auto const close = line.rfind('"');
    if (open == std::string_view::npos || open == close) {
      reject("{} has '{}' for {} (it must stand in quotes): write it again", place(), shown(line), what);
    }
    at_ = end;
    return std::string(line.substr(open + 1, close - open - 1));
  }

  /// Goes behind the end of the line, where the bytes of a binary section begin.
  void to_next_line() {
    std::size_t const end = content_.find('\n', at_);
    at_ = end == std::string::npos ? content_.size() : end + 1;
  }

 private:
  static constexpr std::string_view blanks = " \t\r\n\f\v";

  static std::string shown(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    for (char& letter : text) {
      if (letter < ' ' || letter > '~') letter = '?';
    }
    return word.size() > longest ? text + "..." : text;
  }

  /// Goes to the line that names the format, if there is one.
  void skip_preface() {
    auto const found = content_.find("\n$MeshFormat", at_);
    if (content_.compare(at_, 11, "$MeshFormat") != 0 && found != std::string::npos) at_ = found + 1;
  }

  void skip_blanks() { at_ = std::min(content_.find_first_not_of(blanks, at_), content_.size()); }

  std::string_view peek_word() const {
    std::size_t const end = std::min(content_.find_first_of(blanks, at_), content_.size());
    return std::string_view(content_).substr(at_, end - at_);
  }

  std::string_view next_word(std::string_view what) {
    skip_blanks();
    last_ = at_;
    auto const word = peek_word();
    if (word.empty()) reject_end(what);
    at_ += word.size();
    return word;
  }

  template <class Number>
  Number bytes(std::string_view what) {
    last_ = at_;
    if (content_.size() - at_ < sizeof(Number)) reject_end(what);
    std::array<char, sizeof(Number)> raw;
    std::copy_n(content_.begin() + static_cast<std::ptrdiff_t>(at_), sizeof(Number), raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    Number number;
    std::memcpy(&number, raw.data(), sizeof(Number));
    at_ += sizeof(Number);
    return number;
  }

  [[noreturn]] void reject_end(std::string_view what) const {
    reject("'{}' ends at {} where {} is expected (it is cut off): write or copy it again", file_,
           binary_ ? fmt::format("byte {}", last_)
                   : fmt::format("line {}", std::count(content_.begin(), content_.end(), '\n') + 1),
           what);
  }

  std::string content_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t last_ = 0;
  bool at_section_ = false;  ///< one has begun
  bool binary_ = false;
  bool swapped_ = false;
};

}  // namespace scarp::detail
