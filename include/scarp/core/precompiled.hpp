// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace scarp {

/// Whether a part is one of those that the library `scarp::precompiled` is compiled with. A function of such parts
/// alone is called there; with any other part, or in a program that does not link the library, it is compiled on the
/// spot.
template <class Part>
inline constexpr bool is_precompiled = false;

namespace detail {

#ifdef SCARP_PRECOMPILED
inline constexpr bool has_library = true;
#else
inline constexpr bool has_library = false;
#endif

}  // namespace detail

}  // namespace scarp

/// Before definitions of functions that are no templates, which are seen only where this is defined: `inline` in
/// programs without the library, nothing in the one source of the library that has them.
#ifndef SCARP_PRECOMPILED
#define SCARP_DEFINITIONS inline
#endif

/// Before definitions that the library exports where it is a shared one. In other programs they are hidden where their
/// flags hide symbols, so that libraries of different flags or versions keep theirs apart.
#if defined(SCARP_SHARED) && defined(__GNUC__)
#define SCARP_EXPORT [[gnu::visibility("default")]]
#else
#define SCARP_EXPORT
#endif
