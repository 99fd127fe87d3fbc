#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <variant>

#include "config/settings.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "storage/catalogue_entry.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// Reads windows of stored slots again, as the service read them: one connection to each historian,
/// made when it is first needed, and again when it was lost since. A historian that is away is not
/// asked again for half a minute; the loops of the others are read all the same. For one thread at
/// a time.
class WindowSource {
 public:
  explicit WindowSource(const config::Settings& settings) : settings_(settings) {}

  /// What was read, or why not in a sentence, in place of DatabaseError and Failure.
  using Reading = std::variant<LoopInput, std::string>;

  /// The window of the slot that ends at `slot_end_us` (microseconds UTC since 1970), with the
  /// longer span where it is wanted.
  [[nodiscard]] Reading read(const storage::CatalogueEntry& loop, std::int64_t slot_end_us);

 private:
  using Clock = std::chrono::steady_clock;
  struct Away {
    std::string words;
    Clock::time_point since;
  };

  storage::HistorianReader& historian_of(const std::string& source);
  Reading try_once(const storage::CatalogueEntry& loop, std::int64_t slot_end_us);

  const config::Settings& settings_;
  std::map<std::string, storage::HistorianReader> historians_;
  std::map<std::string, Away> away_;  ///< by source: what it said
};

}  // namespace loopscope::daemon
