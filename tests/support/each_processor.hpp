#pragma once

#include <algorithm>
#include <hwy/highway.h>
#include <vector>

namespace loopscope::tests {

/// What `best` gives on each kind of processor that this one can be taken for, the least first.
template <typename Best>
auto on_each_processor(const Best& best) {
  std::vector<decltype(best())> found;
  const auto choose = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  };
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    choose(target);
    found.push_back(best());
  }
  choose(0);  // all of them
  std::ranges::reverse(found);
  return found;
}

}  // namespace loopscope::tests
