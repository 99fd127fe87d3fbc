#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "storage/results/schema/superseded_migrations.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {

/// A schema of the former chain, in use: what is taken over has rows, partitions and rights.
class UpgradeTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
    owner = database->make_login("loopscope_owner");
    worker = database->make_login("loopscope_worker");
    reader = database->make_login("loopscope_reader");
    make_former_schema(*database, "loopscope_owner");
    database->execute(kRows);
    for (const char* table :
         {"loop", "schedule", "analysis", "verdict", "annotation", "plant_round", "parameter",
          "explanation_step", "flag_notice", "standing_problem", "task_lease"})
      selects.push_back(database->value(
          std::string(
              "SELECT 'SELECT row(' || string_agg(attname, ', ' ORDER BY attnum) || ')::text"
              " FROM ' || attrelid::regclass || ' ORDER BY 1' FROM pg_attribute WHERE"
              " attnum > 0 AND attrelid = 'loopscope.") +
          table + "'::regclass GROUP BY attrelid"));
    before = contents();
  }

  /// As `migrate` of that version left it; the last one where none is given.
  static void make_former_schema(const tests::TestDatabase& made, const std::string& by,
                                 std::size_t version = superseded_migrations().size()) {
    made.execute("SET ROLE " + by + ";" + former_script(0, version) +
                 "SELECT loopscope.make_partitions(now(), 4); SELECT loopscope.grant_rights();"
                 // By `maintain`, which grants nothing.
                 "SELECT loopscope.make_partitions('2026-01-01', 1)");
  }

  /// The same with kRows, and the login that migrates it.
  static std::string fill_former_schema(tests::TestDatabase& made,
                                        std::size_t version = superseded_migrations().size()) {
    made.make_roles();
    make_former_schema(made, "loopscope_owner", version);
    made.execute(kRows);
    return made.make_login("loopscope_owner");
  }

  /// The migrations of the chain after `from` up to `to`, as the programs of then ran them.
  [[nodiscard]] static std::string former_script(std::size_t from, std::size_t to) {
    std::string script;
    for (std::size_t i = from; i < to; ++i) {
      const SupersededMigration& migration = superseded_migrations()[i];
      script += tests::content_of(tests::source_dir() / "tests/storage/results/former_schema" /
                                  (std::string(migration.name) + ".sql"));
      script += "INSERT INTO loopscope.schema_migration VALUES (" + std::to_string(i + 1) + ", '" +
                migration.name + "', '" + migration.sha256 + "');";
    }
    return script;
  }

  /// Two loops, one held by a worker, with a verdict, and an annotation of each state.
  static constexpr const char* kRows = R"(
    SET ROLE loopscope_owner;
    INSERT INTO loopscope.loop (name, source, pv_tag, period_s, enabled)
      VALUES ('a', 'plant', 'a.PV', 3600, true), ('b', 'plant', 'b.PV', 3600, true),
             ('off', 'plant', 'off.PV', 3600, false);
    INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, analysis_id, fence,
        program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,
        samples, interval_s, usable, flags, oscillating)
      SELECT loop_id, '2026-01-01 01:00:00+00', 1, nextval('loopscope.analysis_id'), 1, '0.1.0', '{}',
             'd', 1, 1, '2026-01-01 00:00:00+00', '2026-01-01 01:00:00+00', 4096, 1, true, '{}', false
      FROM loopscope.loop WHERE enabled;
    INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision, analysis_id,
        code, confidence, summary, reasons, action)
      SELECT loop_id, slot_end, 1, 1, analysis_id, 'valve_stiction', 0.9, 'sticks', '{}', 'stroke it'
      FROM loopscope.analysis;
    INSERT INTO loopscope.explanation_step (loop_id, slot_end, algorithm_revision, input_revision,
        step, effect, parameters, intervals, holdout_error_before, holdout_error_after, statement)
      SELECT loop_id, slot_end, 1, 1, number, 'valve_stiction', '{"S": 4.2}', '{}', 1, 0.25, 'It sticks.'
      FROM loopscope.analysis CROSS JOIN generate_series(1, 2) AS number;
    UPDATE loopscope.schedule SET owner = 'host/1/0', fence = 1, attempts = 2, lost_leases = 1,
        visible_at = now() - interval '1 s', last_slot_end = '2026-01-01 01:00:00+00',
        result_slot_end = '2026-01-01 01:00:00+00'
      WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'a');
    INSERT INTO loopscope.annotation (loop_id, kind, withdrawn_at)
      SELECT loop_id, 'acknowledged', CASE name WHEN 'a' THEN now() END FROM loopscope.loop
      WHERE enabled;
    INSERT INTO loopscope.plant_round VALUES ('2026-01-01 01:00:00+00', 1, 2, 0, 0, now());
    UPDATE loopscope.parameter SET value = 0.4 WHERE name = 'min_confidence')";

  /// Loop a is on the list, loop b would be.
  static constexpr const char* kStay = R"(
    UPDATE loopscope.annotation SET withdrawn_at = now() WHERE withdrawn_at IS NULL;
    UPDATE loopscope.schedule SET result_slot_end = '2026-01-01 01:00:00+00';
    INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since, status, confidence, rank, score, summary)
      SELECT loop_id, code, true, slot_end, slot_end, 'watch', 0.9, 1, 0.5, 'sticks' FROM loopscope.verdict
      WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'a'))";

  /// Every column.
  [[nodiscard]] TextRows contents() const {
    TextRows rows;
    for (const std::string& select : selects) {
      for (const auto& row : database->rows(select)) rows.push_back(row);
    }
    return rows;
  }

  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader;
  std::vector<std::string> selects;
  TextRows before;
};

}  // namespace loopscope::storage
