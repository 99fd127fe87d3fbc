#pragma once

#include <cstddef>
#include <functional>

#include "tests/core/model/field_bases.hpp"

namespace loopscope::tests::model {

/// The valve cycles at least six times without a rest longer than a fifth of the record,
/// noise and load on top notwithstanding: an engineer could see it.
[[nodiscard]] bool cycles_visibly(const FieldLoop& loop, const FieldSettings& settings);

/// Slip jump by stickband; 0 = play.
struct JumpShares {
  double least = 0.0, most = 1.0;
};

/// A loop that cycles about the band of its valve, at least six times in `samples` and with at
/// least six samples a cycle; noise and load on top.
[[nodiscard]] FieldSettings hunting(Loop base, Friction friction, JumpShares jumps,
                                    std::size_t samples, Draw& draw);

/// A loop whose valve sticks so that it cycles, at least six times in `samples` and with at least
/// six samples a cycle; noise and load on top.
[[nodiscard]] FieldSettings sticking(Loop base, Friction friction, std::size_t samples, Draw& draw);

/// What makes a family of its own: settings changed at will, given the samples of the record.
using Change = std::function<void(FieldSettings&, std::size_t samples)>;

/// A sticking loop changed by `change`, drawn again until the valve visibly cycles.
[[nodiscard]] FieldLoop visible_stiction(Loop base, Friction friction, Draw& draw,
                                         const Change& change, Length length = record_length);

}  // namespace loopscope::tests::model
