// SPDX-License-Identifier: BSL-1.0
/// \file
/// Error against run time: a subject is run over its settings, errors against a reference and CPU time are tabulated.
/// `sweep.hpp` varies the settings and finds the front and observed orders.
/// `cpu_time.hpp` reads the clock of the process, `processor.hpp` names the machine.
/// `memory.hpp` says how much memory is left and refuses what takes more.
/// Stands aside: only benchmarks and studies include it.
/// docs/error-against-time.md shows how.
#pragma once

#include "scarp/measure/cpu_time.hpp"
#include "scarp/measure/measured.hpp"
#include "scarp/measure/memory.hpp"
#include "scarp/measure/processor.hpp"
#include "scarp/measure/sweep.hpp"
