#include "tests/storage/results/views_fixture.hpp"

#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::storage {
namespace {

constexpr double kPrior = 0.2;

core::diagnosis::CauseReport cause_with(core::diagnosis::VerdictCode code, double probability) {
  const double evidence =
      core::diagnosis::log_odds_of(probability) - core::diagnosis::log_odds_of(kPrior);
  return {code, probability, kPrior, {}, {}, evidence};
}

}  // namespace

void ViewsTest::tell(const std::vector<Story>& stories) {
  ResultsDatabase results = connect();
  for (const Story& story : stories) {
    if (!Catalogue(settings_for(*database)).find(story.loop)) add_loops({story.loop});
    database->execute(
        "UPDATE loopscope.schedule SET visible_at = now() - interval '1 hour'"
        " WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = '" +
        story.loop + "')");
    const std::vector<ClaimedLoop> claimed = results.claim_due("teller", 100, 1);
    CompletedLoop loop = completed(claimed.at(0), slot(story.slot_hours), "digest");
    // Not due again while the others are told.
    loop.next_due_us = claimed[0].database_now_us + 3'600'000'000;
    core::Diagnosis& diagnosis = loop.record->diagnosis;
    diagnosis.verdict.code = story.code;
    diagnosis.verdict.confidence = story.confidence;
    diagnosis.verdict.p = story.p;
    diagnosis.evidence.oscillation.p = story.oscillation_p;
    diagnosis.evidence.hos->nonlinear_p = story.nonlinear_p;
    diagnosis.evidence.performance.harris_low = story.harris;
    diagnosis.evidence.performance.harris_high = story.harris;
    diagnosis.evidence.performance.error_std = story.error_std;
    diagnosis.evidence.data_quality.usable = story.usable;
    diagnosis.verdict.priors = {kPrior};
    if (story.fault_probability)
      diagnosis.verdict.causes = {
          cause_with(kHealthy, 1.0 - *story.fault_probability),
          cause_with(core::diagnosis::VerdictCode::process_change, *story.fault_probability)};
    results.finish(std::vector{loop}, {});
  }
}

std::vector<std::string> ViewsTest::column(const std::string& sql) const {
  std::vector<std::string> values;
  for (const auto& row : database->rows(sql)) values.push_back(row.at(0));
  return values;
}

}  // namespace loopscope::storage
