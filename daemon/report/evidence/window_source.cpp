#include "daemon/report/evidence/window_source.hpp"

#include <string>
#include <utility>

#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

const std::string kTrouble = "the window could not be read again: ";
constexpr std::chrono::seconds kPause{30};

}  // namespace

storage::HistorianReader& WindowSource::historian_of(const std::string& source) {
  const auto known = historians_.find(source);
  if (known != historians_.end()) return known->second;
  const config::HistorianSettings& settings = find_historian(settings_, source);
  storage::HistorianReader reader(historian_connection(settings, settings_.schedule.hold_s()),
                                  historian_layout(settings));
  return historians_.emplace(source, std::move(reader)).first->second;
}

WindowSource::Reading WindowSource::try_once(const storage::CatalogueEntry& loop,
                                             std::int64_t slot_end_us) {
  LoopInput input =
      read_input(historian_of(loop.source), past_slot(loop, slot_end_us), settings_.analysis);
  if (input.at_slot.window.size() > 0) return input;
  return "the historian holds no row of the loop's pv tag in that window any more.";
}

WindowSource::Reading WindowSource::read(const storage::CatalogueEntry& loop,
                                         std::int64_t slot_end_us) {
  const auto away = away_.find(loop.source);
  if (away != away_.end() && Clock::now() - away->second.since < kPause) return away->second.words;
  const bool was_connected = historians_.contains(loop.source);
  try {
    return try_once(loop, slot_end_us);
  } catch (const storage::DatabaseError& error) {
    historians_.erase(loop.source);
    // A connection that died idle says nothing about its server.
    if (was_connected && error.remedy() == storage::Remedy::reconnect)
      return read(loop, slot_end_us);
    const std::string words = kTrouble + error.what();
    if (error.remedy() == storage::Remedy::reconnect) away_[loop.source] = {words, Clock::now()};
    return words;
  } catch (const std::exception& error) {  // a setting that is gone, or a window that throws
    return kTrouble + error.what();
  }
}

}  // namespace loopscope::daemon
