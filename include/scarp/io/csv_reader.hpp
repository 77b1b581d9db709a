// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
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
#include "scarp/io/text_lines.hpp"

namespace scarp {

namespace detail {

struct CsvLine {
  std::size_t number;  ///< of the line in its file where the row begins, from 1
  std::vector<std::string> cells;
};

/// Parses a table's text, row by row. Lines of nothing but separators and blanks, as spreadsheets leave them, are
/// skipped. Of commas, semicolons and tabs the one parts the cells that the first two lines have most of; a line `sep=`
/// before them names the separator.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, std::string file) : lines_(text), file_(std::move(file)) {
    auto ahead = lines_;
    auto first = ahead.take();
    if (first.size() == 5 && first.starts_with("sep=")) {
      separator_ = first.back();
      lines_ = ahead;
    } else {
      auto const is_bare = [](std::string_view line) { return line.find_first_not_of(" \t;,") == line.npos; };
      auto const skip_bare = [&](std::string_view line) {
        while (is_bare(line) && !ahead.done()) line = ahead.take();
        return is_bare(line) ? std::string_view() : line;
      };
      first = skip_bare(first);
      // Names may hold commas, as in `q, kPa;p, kPa`; the second line has fewer.
      std::string_view const second = skip_bare({});
      auto const least = [&](char one) {
        return second.empty() ? outside_quotes(first, one)
                              : std::min(outside_quotes(first, one), outside_quotes(second, one));
      };
      for (char const other : {';', '\t'})
        if (least(other) > least(separator_)) separator_ = other;
    }
  }

  /// \return whether there was another row
  /// \throws InputError for quotes that do not close or are followed by text
  bool next(CsvLine& line) {
    char const empty[] = {' ', '\t', separator_};
    while (!lines_.done()) {
      std::string_view text = lines_.take();
      if (text.find_first_not_of({empty, sizeof empty}) == std::string_view::npos) continue;
      line = {lines_.number(), {}};
      while (true) {
        line.cells.push_back(text.starts_with('"') ? quoted_cell(text) : plain_cell(text));
        if (text.empty()) return true;
        text.remove_prefix(1);  // the separator
      }
    }
    return false;
  }

  char separator() const { return separator_; }

 private:
  static std::ptrdiff_t outside_quotes(std::string_view line, char wanted) {
    bool quoted = false;
    return std::count_if(line.begin(), line.end(), [&](char letter) {
      if (letter == '"') quoted = !quoted;
      return letter == wanted && !quoted;
    });
  }

  std::string plain_cell(std::string_view& text) const {
    std::size_t const end = std::min(text.find(separator_), text.size());
    std::string cell(trimmed(text.substr(0, end)));
    text.remove_prefix(end);
    return cell;
  }

  /// The quotes may enclose ends of lines: then `text` continues in a later line.
  std::string quoted_cell(std::string_view& text) {
    std::size_t const opened = lines_.number();
    std::string cell;
    text.remove_prefix(1);
    while (true) {
      std::size_t const end = std::min(text.find('"'), text.size());
      cell += text.substr(0, end);
      text.remove_prefix(end);
      if (text.empty()) {
        if (lines_.done()) reject("line {} of '{}' opens quotes (they never close): close them", opened, file_);
        cell += '\n';
        text = lines_.take();
      } else if (text.starts_with("\"\"")) {
        cell += '"';
        text.remove_prefix(2);
      } else {
        text.remove_prefix(1);
        break;
      }
    }
    if (!text.empty() && !text.starts_with(separator_)) {
      reject("line {} of '{}' has text behind closed quotes (a '{}' must follow): double quotes inside quotes",
             lines_.number(), file_, separator_);
    }
    return cell;
  }

  TextLines lines_;
  std::string file_;
  char separator_ = ',';
};

}  // namespace detail

/// A table of a file, parted by commas (quotes as in RFC 4180), semicolons or tabs: named columns, whose cells become
/// numbers when a column is requested, so that other columns may hold anything. Does not depend on the locale.
class CsvColumns {
 public:
  /// text: content of the file; file: its name in messages
  /// \throws InputError for no header, repeated names and lines with too few or too many cells
  CsvColumns(std::string_view text, std::string file) : file_(std::move(file)) {
    detail::CsvScanner scanner(text, file_);
    if (!scanner.next(header_)) reject("'{}' is empty (a table begins with the names of its columns): add them", file_);
    auto& names = header_.cells;
    for (detail::CsvLine line; scanner.next(line);) {
      while (line.cells.size() > names.size() && line.cells.back().empty()) line.cells.pop_back();
      while (line.cells.size() < names.size() && names[line.cells.size()].empty()) line.cells.emplace_back();
      if (line.cells.size() != names.size()) {
        reject(
            "line {} of '{}' has {} cells (line {} names {} columns, parted by {}): give one cell for each, decimals "
            "with points, "
            "and no lines but the table's",
            line.number, file_, line.cells.size(), header_.number, names.size(),
            scanner.separator() == '\t' ? "tabs" : fmt::format("'{}'", scanner.separator()));
      }
      rows_.push_back(std::move(line));
    }
    for (std::size_t column = names.size(); column-- > 0;) {
      if (names[column].empty()) drop_empty(column);
    }
    for (auto name = names.begin(); name != names.end(); ++name) {
      if (std::find(names.begin(), name, *name) != name) {
        reject("line {} of '{}' names two columns '{}' (they cannot be distinguished): rename one", header_.number,
               file_, *name);
      }
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
    reject("line {} of '{}' has '{}' in column '{}' ({}): {}", line(row), file_,
           shortened(spelt_out(rows_[row].cells[require(name)])), name, why, suggestion);
  }

 private:
  /// A column that has neither a name nor a cell, as spreadsheets add them.
  void drop_empty(std::size_t column) {
    auto const at = static_cast<std::ptrdiff_t>(column);
    for (auto& row : rows_) {
      if (!row.cells[column].empty())
        reject("line {} of '{}' has '{}' in column {}, which line {} does not name: name it", row.number, file_,
               shortened(row.cells[column]), column + 1, header_.number);
      row.cells.erase(row.cells.begin() + at);
    }
    header_.cells.erase(header_.cells.begin() + at);
  }

  std::optional<std::size_t> find(std::string_view name) const {
    auto const found = std::find(header_.cells.begin(), header_.cells.end(), name);
    if (found == header_.cells.end()) return std::nullopt;
    return detail::index(found - header_.cells.begin());
  }

  std::size_t require(std::string_view name) const {
    auto const place = find(name);
    if (!place) {
      reject("'{}' has no column '{}' (line {} names {}): add it or rename one", file_, name, header_.number,
             shortened(listed(header_.cells)));
    }
    return *place;
  }

  template <class Number>
  Number number(std::size_t row, std::size_t place) const {
    Number value{};
    auto const error = read_number(rows_[row].cells[place], value);
    auto const& name = header_.cells[place];
    if (error == std::errc::result_out_of_range) {
      reject_cell(row, name, "its size is beyond what a number here can hold", "check the value and its unit");
    }
    if (error != std::errc()) {
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
inline CsvColumns read_csv(std::filesystem::path const& path) { return CsvColumns(read_file(path), path.string()); }

}  // namespace scarp
