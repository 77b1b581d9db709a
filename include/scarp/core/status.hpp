// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <string_view>

#include "scarp/core/described.hpp"
#include "scarp/core/one_version.hpp"

namespace scarp {

/// How a response was reached. Anything but `ok` and `fluid` must not be committed.
enum class Status : std::uint8_t {
  ok,             ///< the response meets the tolerances
  fluid,          ///< no contacts carry force: stress and tangent are zero, legitimately
  not_converged,  ///< bounded work was spent without reaching the accuracy
  failed          ///< no meaningful response exists (NaN, exploded, impossible input)
};

/// Why a status is not `ok`. Checkpoints hold the numbers.
enum class Reason : std::uint8_t {
  none,                ///< the status is ok
  no_contacts,         ///< no contact carries force
  unbalanced,          ///< the packing did not come to rest within the tolerance on the unbalanced ratio
  unreachable,         ///< a servo target was not reached within the allowed work
  not_finite,          ///< NaN or infinity in state or response
  unconverged_normal,  ///< the search for a contact's normal did not come to its end
  too_deep,            ///< grains overlap more deeply than their curvature allows
  cell_collapsed,      ///< the periodic cell is inverted or thinner than a grain's diameter and the skin
  lost_grain,          ///< a grain lies so many cells away that its place in the cell is round-off
  element_inverted,    ///< an element's Jacobian is not positive
  no_return = 11,      ///< no admissible stress was found for a trial stress
  iterations_spent,    ///< the iteration limit was reached above the tolerance
  singular_system,     ///< the linear system could not be factorised
  step_too_small,      ///< cutting the load step went below its smallest size
  interrupted,         ///< stopped from outside
  too_few_steps,       ///< one DEM step strains beyond its limit: the plan, or the most steps, are too few
  time_error           ///< the estimated error of a time step is larger than allowed
};

/// A status and its reason.
struct [[nodiscard]] Verdict {
  Status status = Status::ok;    ///< how the response was reached
  Reason reason = Reason::none;  ///< why the status is not `ok`

  /// Whether a response with this verdict may be committed.
  constexpr bool acceptable() const { return status == Status::ok || status == Status::fluid; }

  SCARP_MEMBERS(status, reason)

  friend constexpr bool operator==(Verdict const&, Verdict const&) = default;
};

/// Name of the enumerator, "unknown" for any other number.
constexpr std::string_view name(Status status) {
  switch (status) {
    case Status::ok: return "ok";
    case Status::fluid: return "fluid";
    case Status::not_converged: return "not_converged";
    case Status::failed: return "failed";
  }
  return "unknown";
}

/// Name of the enumerator, "unknown" for any other number.
constexpr std::string_view name(Reason reason) {
  switch (reason) {
    case Reason::none: return "none";
    case Reason::no_contacts: return "no_contacts";
    case Reason::unbalanced: return "unbalanced";
    case Reason::unreachable: return "unreachable";
    case Reason::not_finite: return "not_finite";
    case Reason::unconverged_normal: return "unconverged_normal";
    case Reason::too_deep: return "too_deep";
    case Reason::cell_collapsed: return "cell_collapsed";
    case Reason::lost_grain: return "lost_grain";
    case Reason::element_inverted: return "element_inverted";
    case Reason::no_return: return "no_return";
    case Reason::iterations_spent: return "iterations_spent";
    case Reason::singular_system: return "singular_system";
    case Reason::step_too_small: return "step_too_small";
    case Reason::interrupted: return "interrupted";
    case Reason::too_few_steps: return "too_few_steps";
    case Reason::time_error: return "time_error";
  }
  return "unknown";
}

}  // namespace scarp
