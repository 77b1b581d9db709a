// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/io/read_file.hpp"

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

/// Parses a table's text, row by row. Lines without any character are skipped.
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

  /// The quotes may enclose ends of lines: then `text` continues in a later line.
  std::string quoted_cell(std::string_view& text) {
    std::size_t const opened = number_;
    std::string cell;
    text.remove_prefix(1);
    while (true) {
      std::size_t const end = std::min(text.find('"'), text.size());
      cell += text.substr(0, end);
      text.remove_prefix(end);
      if (text.empty()) {
        if (rest_.empty()) reject("line {} of '{}' opens quotes (they never close): close them", opened, file_);
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
      reject("line {} of '{}' has text behind closed quotes (a comma must follow): double quotes inside quotes",
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

/// A table of a file: named columns, whose cells become numbers when a column is requested, so that other columns may
/// hold anything. Does not depend on the locale.
class CsvColumns {
 public:
  /// text: content of the file; file: its name in messages
  /// \throws InputError for no header, repeated names and lines with too few or too many cells
  CsvColumns(std::string_view text, std::string file, CsvSeparator separator = CsvSeparator::comma)
      : file_(std::move(file)) {
    detail::CsvScanner scanner(text, file_, separator);
    if (!scanner.next(header_)) reject("'{}' is empty (a table begins with the names of its columns): add them", file_);
    for (auto name = header_.cells.begin(); name != header_.cells.end(); ++name) {
      if (std::find(header_.cells.begin(), name, *name) != name) {
        reject("line {} of '{}' names two columns '{}' (they cannot be distinguished): rename one", header_.number,
               file_, *name);
      }
    }
    for (detail::CsvLine line; scanner.next(line);) {
      if (line.cells.size() != header_.cells.size()) {
        reject("line {} of '{}' has {} cells (the header names {} columns): give one cell for each", line.number, file_,
               line.cells.size(), header_.cells.size());
      }
      rows_.push_back(std::move(line));
    }
  }

  /// rows: as many cells as the header has names
  CsvColumns(std::string file, detail::CsvLine header, std::vector<detail::CsvLine> rows)
      : file_(std::move(file)), header_(std::move(header)), rows_(std::move(rows)) {}

  std::string const& file() const { return file_; }  ///< Name of the file in messages.
  /// Names of the columns, from left to right.
  std::vector<std::string> const& names() const { return header_.cells; }
  std::size_t rows() const { return rows_.size(); }  ///< Number of rows, the header not counted.
  /// Number of the line where a row begins, from 1.
  std::size_t line(std::size_t row) const { return rows_[row].number; }
  /// Whether there is a column of this name.
  bool has(std::string_view name) const { return find(name).has_value(); }

  /// \throws InputError for a missing column and a cell that is no finite number, or no whole one where these are
  /// wanted
  template <class Number = double>
  std::vector<Number> column(std::string_view name) const {
    std::size_t const place = require(name);
    std::vector<Number> numbers;
    numbers.reserve(rows());
    for (std::size_t row = 0; row < rows(); ++row) numbers.push_back(number<Number>(row, place));
    return numbers;
  }

  /// The cells of a column as they stand. \throws InputError for a missing column
  std::vector<std::string> texts(std::string_view name) const {
    std::size_t const place = require(name);
    std::vector<std::string> found;
    for (auto const& row : rows_) found.push_back(row.cells[place]);
    return found;
  }

  /// Rejects the value in one cell, naming file, line and column.
  [[noreturn]] void reject_cell(std::size_t row, std::string_view name, std::string_view why,
                                std::string_view suggestion) const {
    reject("line {} of '{}' has '{}' in column '{}' ({}): {}", line(row), file_, rows_[row].cells[require(name)], name,
           why, suggestion);
  }

 private:
  std::optional<std::size_t> find(std::string_view name) const {
    auto const found = std::find(header_.cells.begin(), header_.cells.end(), name);
    if (found == header_.cells.end()) return std::nullopt;
    return detail::index(found - header_.cells.begin());
  }

  std::size_t require(std::string_view name) const {
    auto const place = find(name);
    if (!place) {
      reject("'{}' has no column '{}' (line {} names {}): add it or rename one", file_, name, header_.number,
             listed(header_.cells));
    }
    return *place;
  }

  template <class Number>
  Number number(std::size_t row, std::size_t place) const {
    std::string_view text = rows_[row].cells[place];
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars accepts no plus
    Number value{};
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    auto const& name = header_.cells[place];
    if (error == std::errc::result_out_of_range) {
      reject_cell(row, name, "its size is beyond what a number here can hold", "check the value and its unit");
    }
    if (error != std::errc() || end != text.data() + text.size()) {
      if constexpr (std::integral<Number>) reject_cell(row, name, "it is no whole number", "write digits only");
      reject_cell(row, name, "it is no number", "write a decimal number with a point, such as 2.5e-3");
    }
    if constexpr (std::floating_point<Number>) {
      if (!std::isfinite(value)) reject_cell(row, name, "it is not finite", "give an ordinary number");
    }
    return value;
  }

  std::string file_;
  detail::CsvLine header_;
  std::vector<detail::CsvLine> rows_;
};

/// \throws InputError for a file that cannot be read and those of CsvColumns
inline CsvColumns read_csv(std::filesystem::path const& path, CsvSeparator separator = CsvSeparator::comma) {
  return CsvColumns(read_file(path), path.string(), separator);
}

}  // namespace scarp
