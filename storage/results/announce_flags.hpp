#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace loopscope::storage {

class Transaction;

/// A loop that came onto the list, or was confirmed on it.
struct FlagNotice {
  std::int64_t loop_id = 0;
  std::string loop_name, code;
  double confidence = 0.0;
  std::int64_t rank = 0;
  double score = 0.0;
  std::string status;  ///< "watch" or "confirmed"
  std::string summary;
  /// Whether listeners were told: a loop that left the list less than `flag_quiet_hours` ago and
  /// comes back with the same verdict is noted only.
  bool announced = true;
};

/// What changed on the list since the last call, whoever made it.
struct FlagAnnouncement {
  std::vector<FlagNotice> flagged;    ///< new on the list; NOTIFY loopscope_flagged
  std::vector<FlagNotice> confirmed;  ///< confirmed since; NOTIFY loopscope_confirmed
  std::size_t ended = 0;              ///< gone from the list
};

/// Compares flagged_loop with the notices that stand (table flag_notice), notes what came and what
/// went, and tells listeners, in the transaction given: who listens hears it when that is
/// committed. Several callers at once wait for each other, and each change is told once.
[[nodiscard]] FlagAnnouncement announce_flags(Transaction& transaction);

}  // namespace loopscope::storage
