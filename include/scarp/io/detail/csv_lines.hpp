// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"

namespace scarp {

/// What stands between the cells of a table.
enum class CsvSeparator {
  comma,  ///< quotes as in RFC 4180
  blanks  ///< any number of blanks and tabs; '#' begins the header and comments
};

namespace detail {

struct CsvLine {
  std::size_t number;  ///< of the line in its file where the row begins, from 1
  std::vector<std::string> cells;
};

/// Takes a table's text apart, row by row. Lines without any character are skipped.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, std::string file, CsvSeparator separator)
      : rest_(text), file_(std::move(file)), separator_(separator) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // byte order mark that spreadsheets write
  }

  /// \return whether there was another row
  /// \throws InputError for quotes that do not close or are followed by text
  bool next(CsvLine& line) { return separator_ == CsvSeparator::comma ? next_of_commas(line) : next_of_blanks(line); }

 private:
  static constexpr std::string_view blanks = " \t";

  static std::string trimmed(std::string_view text) {
    std::size_t const begin = std::min(text.find_first_not_of(blanks), text.size());
    return std::string(text.substr(begin, text.find_last_not_of(blanks) + 1 - begin));
  }

  std::string_view take_line() {
    std::size_t const end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  bool next_of_blanks(CsvLine& line) {
    bool const header = number_ == 0;
    while (!rest_.empty()) {
      std::string_view text = take_line();
      bool const marked = text.starts_with('#');
      if (marked && !header) continue;
      if (marked) text.remove_prefix(1);
      line = {number_, {}};
      while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        if (text.empty()) break;
        std::size_t const end = std::min(text.find_first_of(blanks), text.size());
        line.cells.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
      }
      if (!line.cells.empty()) return true;
    }
    return false;
  }

  bool next_of_commas(CsvLine& line) {
    while (!rest_.empty()) {
      std::string_view text = take_line();
      if (text.empty()) continue;
      line = {number_, {}};
      while (true) {
        line.cells.push_back(text.starts_with('"') ? quoted_cell(text) : plain_cell(text));
        if (text.empty()) return true;
        text.remove_prefix(1);  // the comma
      }
    }
    return false;
  }

  static std::string plain_cell(std::string_view& text) {
    std::size_t const end = std::min(text.find(','), text.size());
    std::string cell = trimmed(text.substr(0, end));
    text.remove_prefix(end);
    return cell;
  }

  /// The quotes may enclose ends of lines: then `text` goes on in a later line.
  std::string quoted_cell(std::string_view& text) {
    std::size_t const opened = number_;
    std::string cell;
    text.remove_prefix(1);
    while (true) {
      std::size_t const end = std::min(text.find('"'), text.size());
      cell += text.substr(0, end);
      text.remove_prefix(end);
      if (text.empty()) {
        if (rest_.empty()) refuse("line {} of '{}' opens quotes (they never close): close them", opened, file_);
        cell += '\n';
        text = take_line();
      } else if (text.starts_with("\"\"")) {
        cell += '"';
        text.remove_prefix(2);
      } else {
        text.remove_prefix(1);
        break;
      }
    }
    if (!text.empty() && !text.starts_with(',')) {
      refuse("line {} of '{}' has text behind closed quotes (a comma must follow): double quotes inside quotes",
             number_, file_);
    }
    return cell;
  }

  std::string_view rest_;
  std::string file_;
  CsvSeparator separator_;
  std::size_t number_ = 0;
};

}  // namespace detail

}  // namespace scarp
