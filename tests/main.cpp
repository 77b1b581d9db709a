// SPDX-License-Identifier: BSL-1.0
// Both names are needed: doctest.h may already have come in through the precompiled header.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
