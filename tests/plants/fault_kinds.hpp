#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace loopscope::tests::plants {

/// One kind of fault that a plant has: the verdict of the contract, and the records of
/// tests/effects that show it, one of which is drawn.
struct FaultKind {
  std::string_view verdict;
  std::vector<std::string_view> records;
};

/// The eight, in the order of the contract.
[[nodiscard]] std::span<const FaultKind> fault_kinds();

}  // namespace loopscope::tests::plants
