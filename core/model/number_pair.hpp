#pragma once

namespace loopscope::core::model {

/// Two numbers that every processor adds, compares and chooses (`condition ? a : b`) as one: what
/// compilers make of longer ones and of loops over lanes is slower than plain code.
typedef double NumberPair __attribute__((vector_size(2 * sizeof(double))));

}  // namespace loopscope::core::model
