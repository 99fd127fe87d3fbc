#pragma once

#include <string>

namespace loopscope::storage {

/// How the historian's time column counts.
enum class TimeKind { timestamptz, timestamp_utc, epoch_s, epoch_s_float, epoch_ms, epoch_us };

/// How a quality code reads as good or bad.
enum class QualityRule {
  none,   ///< no quality column: every finite value is good
  opcda,  ///< (q & 0xC0) = 0xC0
  zero,   ///< 0 is good
};

/// A historian table with one row per tag and time. Names come from the settings: they are
/// checked against the catalogue of the database and quoted.
struct NarrowLayout {
  std::string source = "plant";             ///< the name that loops refer to
  std::string relation = "public.history";  ///< [schema.]table or view, split at the first dot
  std::string tag_column = "tag";
  std::string time_column = "time";
  std::string value_column = "value";
  std::string quality_column = "quality";  ///< empty = none
  TimeKind time_kind = TimeKind::timestamptz;
  QualityRule quality_rule = QualityRule::opcda;
};

}  // namespace loopscope::storage
