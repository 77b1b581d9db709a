// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <string>
#include <vector>

/// Stiff and extreme cases: each states what is expected and says whether it came so.
namespace stability {

/// How much work a case may take: seconds in CI, or as much as its numbers deserve.
enum class Size { quick, full };

struct Outcome {
  bool as_expected = false;
  double worst = 0.0;     ///< value of the measure; one that is no number fails the case
  std::string measure{};  ///< what `worst` is, e.g. "largest drift of the stress ratio"
  std::string remark{};   ///< what else the reader of the page should know
};

/// A case runs in a process of its own, so that nothing it leaves behind reaches another one.
struct Case {
  std::string group{};
  std::string name{};
  std::string expected{};  ///< answer or named status, in words
  std::function<Outcome(Size)> run{};
  double quick_seconds = 20.0;  ///< bound of CPU time; the full form has thirty times as much
};

using Cases = std::vector<Case>;

}  // namespace stability
