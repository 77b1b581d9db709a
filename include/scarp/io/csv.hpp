// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <concepts>
#include <filesystem>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/appended_file.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/io/text_lines.hpp"

namespace scarp {

namespace detail {

/// Numbers in the shortest form that reads back to the same bits; text in quotes where RFC 4180 requires it, or blanks
/// at its ends would be lost.
template <class Value>
std::string csv_cell(Value const& value) {
  if constexpr (std::convertible_to<Value const&, std::string_view>) {
    std::string_view const text = value;
    if (trimmed(text).size() == text.size() && text.find_first_of(",\"\r\n") == std::string_view::npos) {
      return std::string(text);
    }
    std::string quoted = "\"";
    for (char const letter : text) {
      quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    }
    return quoted + "\"";
  } else {
    return fmt::format("{}", value);
  }
}

/// What one cell is written from.
template <class Value>
concept CsvValue = std::is_arithmetic_v<Value> || std::convertible_to<Value const&, std::string_view>;

/// The header line and the width of a table; every row is checked against it.
class CsvFormat {
 public:
  explicit CsvFormat(std::vector<std::string> const& columns) : width_(columns.size()) {
    if (columns.empty()) {
      reject("the table has no columns (a row could hold nothing): name at least one");
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      auto const& name = columns[k];
      if (name.empty() || name.find_first_of("\r\n") != std::string::npos) {
        reject("column {} of the table is named '{}' (a name is one line of text): give it a name", k, name);
      }
      if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(k), name) !=
          columns.begin() + static_cast<std::ptrdiff_t>(k)) {
        reject("two columns of the table are named '{}' (a reader could not distinguish them): rename one", name);
      }
      header_ += csv_cell(name);
      header_ += k + 1 < columns.size() ? ',' : '\n';
    }
  }

  std::string const& header() const { return header_; }

  template <CsvValue... Values>
  std::string row(Values const&... values) const {
    require_width(sizeof...(values));
    std::string line;
    ((line += csv_cell(values), line += ','), ...);
    line.back() = '\n';
    return line;
  }

  template <std::ranges::sized_range Cells>
    requires(!CsvValue<Cells>)
  std::string row(Cells const& cells)
  const {
    require_width(cells.size());
    std::string line;
    for (auto const& cell : cells) line += csv_cell(cell) + ",";
    line.back() = '\n';
    return line;
  }

 private:
  void require_width(std::size_t cells) const {
    if (cells != width_) {
      reject("a row of {} cells is given (the table has {} columns): give one cell for each column", cells, width_);
    }
  }

  std::size_t width_;
  std::string header_;
};

}  // namespace detail

/// A table that is collected and then written as a whole; column names carry the unit, such as "throw [m]".
class CsvTable {
 public:
  /// \throws InputError for no columns and for empty or repeated names
  explicit CsvTable(std::vector<std::string> const& columns) : format_(columns), text_(format_.header()) {}

  /// One cell per column: numbers or text, or a range of these.
  /// \throws InputError for a row of the wrong width
  template <class... Values>
  void add(Values const&... values) {
    text_ += format_.row(values...);
  }

  std::string const& text() const { return text_; }  ///< Header and rows so far, each with its end of line.

  /// \throws FileError when the file cannot be written; an older file of this name is then untouched
  void write(std::filesystem::path const& path) const { write_file(path, text_); }

 private:
  detail::CsvFormat format_;
  std::string text_;
};

/// What a log does with a file that is already there.
enum class CsvStart {
  anew,    ///< replace it
  resumed  ///< add rows behind the old ones; the first replaces a last line that an interruption cut off
};

/// A table on disk that grows row by row; every row is handed to the operating system at once.
class CsvLog {
 public:
  /// \throws InputError for wrong columns, also when an old file that is to be continued has other ones
  /// \throws FileError when the file cannot be opened
  CsvLog(std::filesystem::path const& path, std::vector<std::string> const& columns, CsvStart start = CsvStart::anew)
      : format_(columns), file_(checked(path, format_, start), format_.header(), start == CsvStart::resumed) {}

  /// \throws InputError for a row of the wrong width, FileError when it cannot be written
  template <class... Values>
  void add(Values const&... values) {
    file_.add(format_.row(values...));
  }

  SCARP_MEMBERS_EXCEPT((format_), file_)

 private:
  static std::filesystem::path const& checked(std::filesystem::path const& path, detail::CsvFormat const& format,
                                              CsvStart start) {
    std::error_code none;
    bool const continues = start == CsvStart::resumed && std::filesystem::exists(path, none);
    if (continues && !read_file(path).starts_with(format.header())) {
      reject("'{}' cannot be continued (its columns are not '{}'): start another file", path.string(),
             std::string_view(format.header()).substr(0, format.header().size() - 1));
    }
    return path;
  }

  detail::CsvFormat format_;
  AppendedFile file_;
};

}  // namespace scarp
