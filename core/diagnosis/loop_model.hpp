#pragma once

#include <optional>

#include "core/diagnosis/first_look.hpp"
#include "core/diagnosis/loop_facts.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core {

/// What the loop model (core/model) makes of a window that was judged usable; nullopt = no model
/// was fitted. A pure function of the window, the settings behind `first` and the facts.
[[nodiscard]] std::optional<model::Explanation> explain_loop(const FirstLook& first,
                                                             const LoopFacts& facts);

}  // namespace loopscope::core
