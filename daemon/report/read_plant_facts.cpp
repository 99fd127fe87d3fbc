#include "daemon/report/read_plant_facts.hpp"

namespace loopscope::daemon {

PlantFacts read_plant_facts(storage::ReportDatabase& database, const config::Settings& settings,
                            std::int64_t since_us) {
  PlantFacts facts{settings.report.plant,
                   since_us,
                   database.counts(since_us),
                   database.flagged(),
                   database.plant_oscillations(),
                   database.repairs(since_us),
                   database.loops()};
  facts.zone = TimeZone(settings.plant.time_zone);
  return facts;
}

}  // namespace loopscope::daemon
