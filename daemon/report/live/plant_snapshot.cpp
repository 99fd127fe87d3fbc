#include "daemon/report/live/plant_snapshot.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "daemon/report/read_plant_facts.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {
namespace {

/// What is new on a page without a beginning of its own.
constexpr std::int64_t kNewWithinUs = std::int64_t{7} * 86'400 * 1'000'000;

}  // namespace

const storage::FlaggedRow* PlantSnapshot::flagged(const std::string& loop_name) const {
  const auto found = std::ranges::find(facts.flagged, loop_name, &storage::FlaggedRow::loop_name);
  return found == facts.flagged.end() ? nullptr : &*found;
}

std::vector<storage::HiddenRow> PlantSnapshot::hidden_by(std::int64_t loop_id) const {
  const auto found = hidden.find(loop_id);
  return found == hidden.end() ? std::vector<storage::HiddenRow>() : found->second;
}

PlantSnapshot read_plant(const config::Settings& settings) {
  PlantSnapshot snapshot;
  snapshot.read_at = PlantSnapshot::Clock::now();
  storage::ReportDatabase database(results_connection(settings));
  snapshot.facts = read_plant_facts(database, settings, database.now_us() - kNewWithinUs);
  for (storage::HiddenLoopRow& row : database.hidden())
    snapshot.hidden[row.loop_id].push_back(std::move(row.said));
  snapshot.took = PlantSnapshot::Clock::now() - snapshot.read_at;
  return snapshot;
}

}  // namespace loopscope::daemon
