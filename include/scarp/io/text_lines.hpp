// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace scarp {

/// The lines of a text one by one, without what ends them: line feed, carriage return or both. A byte order mark is
/// dropped.
class TextLines {
 public:
  /// text: outlives this object
  explicit TextLines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  bool done() const { return rest_.empty(); }     ///< Whether all lines were taken.
  std::size_t number() const { return number_; }  ///< Number of the line that was taken last, from 1.

  /// The next line, a part of the text.
  std::string_view take() {
    std::size_t const end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    std::string_view const line = rest_.substr(0, end);
    rest_.remove_prefix(end + (rest_.substr(end).starts_with("\r\n") ? 2 : end < rest_.size() ? 1 : 0));
    ++number_;
    return line;
  }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// A text without blanks, tabs and no-break blanks (U+00A0, as spreadsheets write them) at its ends.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks[] = {" ", "\t", "\xC2\xA0"};
  for (bool more = true; more;) {
    more = false;
    for (auto const blank : blanks) {
      bool const first = text.starts_with(blank);
      if (first) text.remove_prefix(blank.size());
      bool const last = text.ends_with(blank);
      if (last) text.remove_suffix(blank.size());
      more = more || first || last;
    }
  }
  return text;
}

/// Reads a number with a decimal point, whatever the locale is; a plus may stand before it.
/// \return no error where all of the text is a number, which may be infinite; `value` is then set
template <class Number>
std::errc read_number(std::string_view text, Number& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars accepts no plus
  Number read{};
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error != std::errc{}) return error;
  if (end != text.data() + text.size()) return std::errc::invalid_argument;
  value = read;
  return {};
}

/// At most the first 200 bytes of a text, for messages.
inline std::string shortened(std::string_view text) {
  constexpr std::size_t most = 200;
  return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + "...";
}

/// A text whose characters beyond ASCII, of which some are invisible or look like others, are written as <U+00A0>.
inline std::string spelt_out(std::string_view text) {
  std::string shown;
  for (std::size_t k = 0; k < text.size();) {
    auto const byte = static_cast<unsigned char>(text[k]);
    std::size_t const length = byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
    if (length == 1 || k + length > text.size()) {
      shown += text[k++];
      continue;
    }
    unsigned code = byte & (0xFFU >> (length + 1));
    for (std::size_t more = 1; more < length; ++more)
      code = code << 6U | (static_cast<unsigned char>(text[k + more]) & 0x3FU);
    shown += fmt::format("<U+{:04X}>", code);
    k += length;
  }
  return shown;
}

}  // namespace scarp
