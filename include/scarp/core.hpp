// SPDX-License-Identifier: BSL-1.0
/// \file
/// Small tensors and their Voigt form, geometry of strains, random numbers and fields, errors and verdicts.
/// Everything else stands on this room; it knows neither grains nor elements.
/// A verdict (`status.hpp`) is a value that every level passes up; wrong input throws `InputError` (`error.hpp`).
/// `select.hpp` and `pack.hpp` (namespace `lanes`) let laws and shapes work on several pairs at once: numbers side by side,
/// their functions (`pack_math.hpp`) and conditions (`mask.hpp`). `index.hpp` numbers containers.
/// Units are SI everywhere, stress is Cauchy and positive in tension.
#pragma once

#include "scarp/core/build_info.hpp"
#include "scarp/core/correlated_field.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/geo.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/logarithm.hpp"
#include "scarp/core/polar.hpp"
#include "scarp/core/principal.hpp"
#include "scarp/core/random.hpp"
#include "scarp/core/status.hpp"
#include "scarp/core/tensor.hpp"
#include "scarp/core/version.hpp"
#include "scarp/core/voigt.hpp"
