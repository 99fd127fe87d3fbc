#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/error.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

class Session;

/// A loop that came onto the list, or was confirmed on it.
struct FlagNotice {
  std::int64_t loop_id = 0;
  std::string loop_name, code;
  double confidence = 0.0;  ///< 0 to 1; this and the next two as FlaggedRow has them
  std::int64_t rank = 0;
  double score = 0.0;
  std::string status;  ///< "watch" or "confirmed"
  std::string summary;
  /// Whether listeners were told: a loop that left the list less than `flag_quiet_hours` ago and
  /// comes back is noted only.
  bool announced = true;
};

/// What changed on the list since the last call, whoever made it.
struct FlagAnnouncement {
  std::vector<FlagNotice> flagged;    ///< new on the list; NOTIFY loopscope_flagged
  std::vector<FlagNotice> confirmed;  ///< confirmed since; NOTIFY loopscope_confirmed
  std::size_t ended = 0;              ///< gone from the list
  /// Channel (without loopscope_) and message of what listeners are to be told.
  std::vector<std::pair<std::string, std::string>> messages = {};
  std::optional<DatabaseError> untold = std::nullopt;  ///< why they were not told
};

/// Compares flagged_loop with the stays that are noted (table flag_notice, one open row per loop,
/// whatever becomes of its verdict), notes what came and what went, in one transaction, and tells
/// listeners in one of its own: anybody who may connect can fill the server's queue of messages,
/// and what was noted must not be lost by that. Several callers at once wait for each other, and
/// each change is told once. `check` is asked first. Throws DatabaseError where nothing was noted;
/// what fails in telling stands in `untold`.
[[nodiscard]] FlagAnnouncement announce_flags(Session& session, const ClockCheck& check);

}  // namespace loopscope::storage
