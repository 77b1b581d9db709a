// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "scarp/core/version.hpp"

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "scarp: with -ffast-math, -Ofast or -ffinite-math-only no check finds a NaN: add -fno-finite-math-only"
#endif

/// Two versions of scarp in one program must not share functions in silence, nor must sources compiled for registers of
/// different width or with other containers, in whose types members stand elsewhere: functions of the same name but
/// different body are merged by the linker, and by the loader between shared libraries, without a word. Every source
/// that includes scarp checks at the start of the program whether that has happened to it. Names and meaning in this
/// header stay the same for ever.
namespace scarp::detail {

/// Major and minor number as one; versions that differ in the last number alone have the same layouts and may meet.
consteval int version_number(std::string_view text = version) {
  int parts[2] = {0, 0};
  int dots = 0;
  for (char const letter : text) {
    if (letter == '.') {
      if (++dots == 2) break;
    } else {
      parts[dots] = 10 * parts[dots] + (letter - '0');
    }
  }
  return 1000 * parts[0] + parts[1];
}

/// Bytes of one vector register of the instruction set that a source is compiled for. Without such registers, or with
/// none that this header lists, compilers take a vector of 16 bytes apart.
consteval int bytes_of_register() {
#if defined(__AVX512F__)
  return 64;
#elif defined(__AVX__)
  return 32;
#else
  return 16;
#endif
}

/// Version of the headers from which the linked functions come, if several have been merged. Read at run time, so that
/// no compiler evaluates it.
[[gnu::noinline]] inline int version_of_functions() {
  int volatile number = version_number();
  return number;
}

[[gnu::noinline]] inline int register_of_functions() {
  int volatile bytes = bytes_of_register();
  return bytes;
}

/// Size of a container, which those with checks (_GLIBCXX_DEBUG) do not share.
consteval int bytes_of_container() { return static_cast<int>(sizeof(std::vector<int>)); }

[[gnu::noinline]] inline int container_of_functions() {
  int volatile bytes = bytes_of_container();
  return bytes;
}

#ifdef SCARP_PRECOMPILED
/// Version of the headers that `scarp::precompiled` was compiled with.
int version_of_library();
/// Bytes of a container there.
int container_of_library();
#endif

struct OneVersion {
  OneVersion(int own, int own_register) {
    if (version_of_functions() != own) reject(own, version_of_functions(), "functions of the same names");
#ifdef SCARP_PRECOMPILED
    if (version_of_library() != own) reject(own, version_of_library(), "scarp::precompiled");
#endif
    if (register_of_functions() != own_register) {
      std::fprintf(
          stderr,
          "scarp: a source compiled for vector registers of %d bytes meets one for %d bytes: compile the whole "
          "program with one -march, or hide the symbols of its libraries (-fvisibility=hidden "
          "-fvisibility-inlines-hidden)\n",
          own_register, register_of_functions());
      std::abort();
    }
    require_same_containers(container_of_functions());
#ifdef SCARP_PRECOMPILED
    require_same_containers(container_of_library());
#endif
  }

  static void require_same_containers(int other) {
    if (other == bytes_of_container()) return;
    std::fprintf(
        stderr,
        "scarp: a source whose std::vector has %d bytes meets one where it has %d: compile the whole program, and "
        "scarp::precompiled, with _GLIBCXX_DEBUG or without\n",
        bytes_of_container(), other);
    std::abort();
  }

  [[noreturn]] static void reject(int own, int other, char const* what) {
    std::fprintf(
        stderr,
        "scarp: a source compiled with version %d.%d meets version %d.%d (%s): compile the whole program with one "
        "version, or hide the symbols of its libraries (-fvisibility=hidden -fvisibility-inlines-hidden)\n",
        own / 1000, own % 1000, other / 1000, other % 1000, what);
    std::abort();
  }
};

namespace {
[[maybe_unused]] OneVersion const one_version(version_number(), bytes_of_register());
}

}  // namespace scarp::detail
