// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace scarp {

enum class GmshVersion { v2_2, v4_1 };
enum class GmshEncoding { text, binary };

/// The form of a Gmsh file.
struct GmshFormat {
  GmshVersion version = GmshVersion::v4_1;
  GmshEncoding encoding = GmshEncoding::binary;
};

namespace detail {

/// Collects the content of a Gmsh file: numbers as words or as bytes of this machine's order.
class GmshSink {
 public:
  explicit GmshSink(bool binary) : binary_(binary) {}

  bool binary() const { return binary_; }
  std::string const& content() const { return content_; }

  /// Text in both forms.
  void text(std::string_view text) { content_ += text; }

  /// As words in the shortest form that reads back to the same bits.
  template <class... Numbers>
  void values(Numbers const&... numbers) {
    (value(numbers), ...);
  }

  void end_line() {
    if (!binary_) content_.back() = '\n';
  }

  /// Behind the bytes of a section.
  void end_section(std::string_view name) {
    if (binary_) content_ += '\n';
    content_ += fmt::format("$End{}\n", name);
  }

 private:
  template <class Number>
  void value(Number number) {
    if (binary_) {
      content_.append(reinterpret_cast<char const*>(&number), sizeof(number));
    } else {
      fmt::format_to(std::back_inserter(content_), "{} ", number);
    }
  }

  bool binary_;
  std::string content_;
};

}  // namespace detail

}  // namespace scarp
