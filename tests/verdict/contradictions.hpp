#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::tests::verdict {

/// A sentence and a figure, or two sentences, that must not stand together.
struct Contradiction {
  std::string_view name;
  bool (*stands)(const core::Evidence&, const core::diagnosis::Verdict&) = nullptr;
  /// Makes a diagnosis that contradicts itself in just this.
  void (*spoil)(core::Evidence&, core::diagnosis::Verdict&) = nullptr;
};

[[nodiscard]] std::span<const Contradiction> contradictions();

/// Names of those that stand in a diagnosis.
[[nodiscard]] std::vector<std::string> contradictions_in(const core::Evidence& evidence,
                                                         const core::diagnosis::Verdict& verdict);

}  // namespace loopscope::tests::verdict
