#pragma once

#include <stdexcept>
#include <vector>

#include "tests/core/model/field_recordings.hpp"

namespace loopscope::tables {

/// Those of the folder LOOPSCOPE_RECORDINGS (manifest.csv and loops/).
/// @throws std::invalid_argument there are none
[[nodiscard]] inline std::vector<tests::model::FieldRecording> recordings() {
  auto found = tests::model::field_recordings();
  if (found.empty()) {
    throw std::invalid_argument("LOOPSCOPE_RECORDINGS names no folder of recordings");
  }
  return found;
}

}  // namespace loopscope::tables
