#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "storage/historian/setup/historian_survey.hpp"

namespace loopscope::daemon {

/// A setting that was read off the rows, and a word for whoever reviews it; empty = it is certain.
struct QualityGuess {
  std::string rule;
  std::vector<std::string> good_codes, uncertain_codes, bad_codes;
  std::string note;
};

/// What quality codes mean, by the type of their column and those that were seen: OPC DA (192, 64,
/// 0), OPC UA (status codes), OPC HDA, zero or true for good, words. Where they look like none of
/// these the commonest counts as good, and the note says so.
[[nodiscard]] QualityGuess guess_quality(const storage::SeenColumn& column,
                                         const storage::CountedTexts& codes);

struct TimeGuess {
  std::string kind;
  std::string note;  ///< empty = it is certain
};

/// The unit of times that are numbers, by their size.
[[nodiscard]] TimeGuess guess_epoch(const storage::CountedTexts& times);

/// Whether times without a zone are UTC, by how far (seconds) the newest lies behind UTC: local
/// times east of Greenwich lie ahead of it. nullopt = nobody knows.
[[nodiscard]] TimeGuess guess_zone(std::optional<double> behind_utc_s);

}  // namespace loopscope::daemon
