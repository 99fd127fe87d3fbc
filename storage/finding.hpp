#pragma once

#include <string>

namespace loopscope::storage {

/// One thing that check-config found.
struct Finding {
  bool ok = false;
  std::string what;      ///< what was checked, or "what, where" of the problem
  std::string hint;      ///< how to mend it; empty when ok without a warning
  bool warning = false;  ///< ok, but better changed: `hint` says how
};

}  // namespace loopscope::storage
