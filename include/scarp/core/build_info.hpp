// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <string_view>

#include "scarp/core/one_version.hpp"

namespace scarp {

/// How a source was compiled. Flags decide more than anything else about the speed of the kernels (`docs/compile.md`).
struct BuildInfo {
  std::string_view compiler = {};          ///< clang++, g++, or that it is unknown
  std::string_view compiler_version = {};  ///< as the compiler reports it
  std::string_view instruction_set = {};   ///< a level of x86-64, or the architecture
  std::string_view beyond = {};            ///< instructions that the level does not promise, or nothing
  int lanes = 1;                           ///< double-precision numbers in one pack of the kernels
  bool optimised = false;                  ///< whether the compiler optimises, at any level
  bool checked_containers = false;         ///< whether those of the standard library check their use (_GLIBCXX_DEBUG)
};

/// Build of the source that calls: sources of one program may have different flags. For sources that link
/// `scarp::precompiled` see also `library_build`.
consteval BuildInfo build_info() {
  BuildInfo info{};
#if defined(__clang__)
  info.compiler = "clang++";
  info.compiler_version = __clang_version__;
#elif defined(__GNUC__)
  info.compiler = "g++";
  info.compiler_version = __VERSION__;
#else
  info.compiler = "a compiler that scarp does not know";
#endif
  while (info.compiler_version.ends_with(' ')) info.compiler_version.remove_suffix(1);

  info.lanes = detail::bytes_of_register() / static_cast<int>(sizeof(double));

  // The levels of the System V ABI, as far as compilers define macros for their instructions.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && \
    defined(__AVX512VL__)
  info.instruction_set = "x86-64-v4";
#elif defined(__AVX2__) && defined(__BMI__) && defined(__BMI2__) && defined(__F16C__) && defined(__FMA__) && \
    defined(__LZCNT__) && defined(__MOVBE__)
  info.instruction_set = "x86-64-v3";
  if (info.lanes > 4) info.beyond = "AVX-512";
#elif defined(__SSE4_2__) && defined(__SSSE3__) && defined(__POPCNT__)
  info.instruction_set = "x86-64-v2";
  if (info.lanes > 2) info.beyond = info.lanes > 4 ? "AVX-512" : "AVX";
#elif defined(__x86_64__)
  info.instruction_set = "x86-64";
#elif defined(__aarch64__)
  info.instruction_set = "aarch64";
#else
  info.instruction_set = "an architecture that scarp does not know";
#endif

#if defined(__OPTIMIZE__)
  info.optimised = true;
#endif
#if defined(_GLIBCXX_DEBUG)
  info.checked_containers = true;
#endif
  return info;
}

#ifdef SCARP_PRECOMPILED
/// Build of the kernels in `scarp::precompiled`; that of the copy that the loader has chosen, where there are several.
BuildInfo library_build();
#endif

/// One line, for example "g++ 12.2.0, optimised, x86-64-v3, 4 lanes in a pack".
inline std::string described(BuildInfo const& info) {
  std::string text(info.compiler);
  if (!info.compiler_version.empty()) text.append(" ").append(info.compiler_version);
  text.append(info.optimised ? ", optimised, " : ", NOT optimised, ").append(info.instruction_set);
  if (!info.beyond.empty()) text.append(" with ").append(info.beyond);
  return text.append(", ")
      .append(std::to_string(info.lanes))
      .append(info.lanes == 1 ? " lane" : " lanes")
      .append(" in a pack")
      .append(info.checked_containers ? ", checked containers" : "");
}

/// Note for whoever starts a program that was compiled so, or nothing.
constexpr std::string_view slow_build_note(BuildInfo const& info) {
  return info.optimised
             ? ""
             : "compiled without optimisation: the kernels are about a hundred times slower, times mean nothing"
               " (configure with -D CMAKE_BUILD_TYPE=Release)";
}

}  // namespace scarp
