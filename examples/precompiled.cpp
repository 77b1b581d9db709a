// SPDX-License-Identifier: BSL-1.0
// The examples share the precompiled headers of this empty source.
