#include "tests/storage/results/results_fixture.hpp"

#include <functional>

#include "storage/results/catalogue/repair_judgements.hpp"
#include "storage/results/schema/embedded_migrations.hpp"
#include "storage/results/schema/migrate.hpp"

namespace loopscope::storage {
namespace {

/// Other migrations, another template.
std::string template_name(const std::string& kind, std::string contents = "") {
  for (const Migration& migration : embedded_migrations()) contents += migration.sha256;
  return "loopscope_" + kind + "_" + std::to_string(std::hash<std::string>{}(contents));
}

/// The member leaves nothing behind: what it makes is its group's.
void migrate_as_owner(const std::string& conninfo) {
  const tests::SqlConnection database(conninfo);
  database.run(tests::roles_script());
  database.run("DROP ROLE IF EXISTS template_owner");
  database.run("CREATE ROLE template_owner LOGIN IN ROLE loopscope_owner");
  migrate({.conninfo = tests::with_key(conninfo, "user", "template_owner"), .purpose = "results"});
  database.run("REVOKE loopscope_owner FROM template_owner; DROP ROLE template_owner");
}

}  // namespace

std::unique_ptr<tests::TestDatabase> database_of_owner() {
  const tests::TemplateDatabase migrated{template_name("owned", tests::roles_script()),
                                         migrate_as_owner};
  auto database = std::make_unique<tests::TestDatabase>(migrated);
  // Rights to the database itself are not copied.
  database->make_roles();
  return database;
}

ConnectionSettings settings_for(const tests::TestDatabase& database, const std::string& user) {
  ConnectionSettings settings;
  settings.conninfo = database.conninfo(user.empty() ? database.owner() : user);
  settings.purpose = "results";
  return settings;
}

std::int64_t slot(int hours) {
  constexpr std::int64_t kStartUs = 1'767'225'600'000'000;
  return kStartUs + std::int64_t{hours} * 3'600'000'000;
}

CatalogueEntry loop_named(const std::string& name) {
  CatalogueEntry loop;
  loop.name = name;
  loop.pv_tag = name + ".PV";
  return loop;
}

AnalysisRecord record_at(std::int64_t slot_end_us, const std::string& digest) {
  AnalysisRecord record;
  record.slot_end_us = slot_end_us;
  record.window_start_us = slot_end_us - 4095'000'000;
  record.window_end_us = slot_end_us;
  record.samples = 4096;
  record.sample_interval_s = 1.0;
  record.input_digest = digest;
  record.program_version = "0.1.0";
  record.settings_json = R"({"hos": {"segment_length": 64}})";
  record.fetch_ms = 1.5;
  record.analyse_ms = 2.5;
  record.prepare_ms = 0.25;
  record.statistics_ms = 0.5;
  record.model_ms = 1.75;
  core::Evidence& evidence = record.diagnosis.evidence;
  evidence.data_quality.usable = true;
  evidence.data_quality.flags = {"sp_missing", "a \"quoted\", odd {flag}\\"};
  evidence.data_quality.missing_fraction = 0.25;
  evidence.hos.emplace();
  evidence.hos->segments = 127;
  evidence.hos->bifrequencies = 320;
  evidence.hos->ngi = 0.0125;
  evidence.hos->nli = 0.5;
  evidence.hos->coupling = core::hos::Coupling::quadratic;
  evidence.hos->peaks = {{0.125, 0.0625, 0.5, 0.001}, {0.25, 0.125, 0.25, std::nullopt}};
  evidence.oscillation.present = true;
  evidence.oscillation.period_s = 40.0;
  evidence.performance.harris_low = 0.2;
  evidence.performance.harris_high = 0.4;
  evidence.performance.error_std = 2.0;
  evidence.shape.horch_dtau = 0.75;
  record.diagnosis.verdict = {core::diagnosis::VerdictCode::valve_stiction,
                              0.875,
                              "The valve sticks.",
                              {"first, with a comma", "second 'quoted' \"reason\""},
                              "Stroke it."};
  return record;
}

CompletedLoop completed(const ClaimedLoop& claim, std::int64_t slot_end_us,
                        const std::string& digest) {
  return {claim.loop.loop_id, claim.fence, slot_end_us, slot_end_us + 3'600'000'000,
          record_at(slot_end_us, digest)};
}

void explain(AnalysisRecord& record, const std::string& last_error) {
  core::model::Explanation& model = record.diagnosis.evidence.model.emplace();
  model.excited = true;
  model.error_kind = core::model::ErrorKind::simulation;
  model.noise_floor = 0.125;
  model.baseline.holdout_error = 1.0;
  model.unexplained.fraction = 0.0625;
  record.model_json = R"({"excited": true, "baseline": {"description": "first order"},
    "steps": [
      {"effect": "valve_stiction", "parameters": {"S": 4.2, "law": "kano"},
       "intervals": {"S": [4.0, 4.4]}, "holdout_error_before": 1.0,
       "holdout_error_after": 0.30000000000000004, "evidence": 812.5, "p": 1e-300, "margin": 90,
       "simulation_ratio": 0.5, "steadiness": 0.75, "statement": "The valve's \"stem\" sticks.",
       "asked_by": [{"test": "op_direction", "p": 1e-300, "p_after": 0.31,
                     "statement": "Errors \"follow\" op."},
                    {"test": "op_level", "p": 0.004, "p_after": null, "statement": ""}],
       "promise_rank": 1},
      {"effect": "external_oscillation", "parameters": {"period_s": 40.0}, "intervals": {},
       "holdout_error_before": 0.5, "holdout_error_after": )" +
                      last_error + R"(, "evidence": 12, "p": 0.001, "margin": null,
       "simulation_ratio": null, "steadiness": 1.0, "statement": "A sinusoid enters.",
       "asked_by": [], "promise_rank": 0}],
    "asked": [{"effect": "valve_stiction", "test": "op_direction", "p": 1e-300}],
    "unexplained": {"fraction": 0.0625, "whiteness_p": 0.5}, "closed_loop": null})";
}

void ResultsTest::SetUp() {
  if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
  database = database_of_owner();
  database->execute(
      "UPDATE loopscope.parameter SET value = 0.05 WHERE name = 'false_discovery_rate'");
}

void ResultsTest::add_loops(const std::vector<std::string>& names) {
  std::vector<CatalogueEntry> loops;
  for (const std::string& name : names) loops.push_back(loop_named(name));
  Catalogue(settings_for(*database)).save(loops);
}

std::vector<ClaimedLoop> ResultsTest::claim_all(ResultsDatabase& results, double lease_s) {
  return results.claim_due("worker", lease_s, 1000);
}

void judge_due_repairs(const ConnectionSettings& settings) {
  RepairJudgements judgements(settings);
  std::vector<JudgedRepair> judged;
  for (const DueRepair& due : judgements.due(1000))
    judged.push_back({due, core::repair::judge_repair(due.windows)});
  judgements.store(judged);
}

void ResultsTest::judge_repairs() const {
  database->execute("DELETE FROM loopscope.repair_judgement");
  judge_due_repairs(settings_for(*database));
}

}  // namespace loopscope::storage
