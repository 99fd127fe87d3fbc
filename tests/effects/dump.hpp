#pragma once

#include <ostream>

#include "tests/effects/generator.hpp"

namespace loopscope::tests::effects {

/// t_s,sp,pv,op and, where asked for, mv.
void write_csv(std::ostream& out, const Record& record, bool with_mv);

/// One line per effect, the loop and the floor.
void write_truth(std::ostream& out, const Truth& truth);

}  // namespace loopscope::tests::effects
