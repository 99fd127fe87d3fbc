#pragma once

#include <string>
#include <vector>

namespace loopscope::tests::model {

/// A labelled recording of a plant.
struct FieldRecording {
  std::string name;
  std::string loop;
  std::string type;                ///< flow, level, ...
  std::string label;               ///< stiction, no_stiction, unknown
  std::vector<double> sp, pv, op;  ///< NaN = missing
};

/// Those that a manifest lists (columns file, loop, type, interval, samples, label), files beside
/// it.
/// @throws std::invalid_argument the manifest or a file of it cannot be read, or holds no samples
[[nodiscard]] std::vector<FieldRecording> recordings_of(const std::string& manifest);

/// Those of the folder that the environment names in LOOPSCOPE_RECORDINGS, in the order of its
/// manifest.csv; none when it is not set.
[[nodiscard]] std::vector<FieldRecording> field_recordings();

}  // namespace loopscope::tests::model
