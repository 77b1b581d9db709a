// SPDX-License-Identifier: BSL-1.0
/// \file
/// What saves a run and what stops it: its folder, checkpoints that go on with the same bits, signals, a time limit.
/// `checkpointed_run.hpp` stands around a run's stages and its observers.
/// `run_folder.hpp` gives a run its output folder and refuses that of another one.
/// `first_rank.hpp` says what only the first of several processes does.
/// `visit_point.hpp` shows a point's state wherever it lives.
/// Nothing here knows a scene.
#pragma once

#include "scarp/run/checkpointed_run.hpp"
#include "scarp/run/first_rank.hpp"
#include "scarp/run/run_folder.hpp"
#include "scarp/run/stop_signal.hpp"
#include "scarp/run/time_limit.hpp"
#include "scarp/run/visit_point.hpp"
