#pragma once

#include <vector>

#include "core/hos/kernels/kernels.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::hos::tests {

/// Those that this processor can run, the fastest last; the first runs everywhere.
inline const std::vector<const Kernels*>& runnable_kernels() {
  static const std::vector<const Kernels*> runnable =
      loopscope::tests::on_each_processor([] { return &best_kernels(); });
  return runnable;
}

}  // namespace loopscope::core::hos::tests
