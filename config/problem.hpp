#pragma once

#include <string>

namespace loopscope::config {

/// One problem of a settings file.
struct Problem {
  std::string path;     ///< JSON path, e.g. "/schedule/poll_s"; "line 3, column 7" for bad syntax
  std::string message;  ///< what is wrong, with the range and the unit
  std::string hint;     ///< how to mend it; may be empty
};

}  // namespace loopscope::config
