#pragma once

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/results_database.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::storage {

using tests::TextRows;

/// Settings of a connection to a test database; an empty user means TestDatabase::owner().
[[nodiscard]] ConnectionSettings settings_for(const tests::TestDatabase& database,
                                              const std::string& user = "");

/// A database whose schema a login of the owner's group has made, as a site would do it.
[[nodiscard]] std::unique_ptr<tests::TestDatabase> database_of_owner();

/// 2026-01-01 00:00:00 UTC plus so many hours, in microseconds: a slot's end.
[[nodiscard]] std::int64_t slot(int hours);

/// Judges the repairs that are due, as the daemon does.
void judge_due_repairs(const ConnectionSettings& settings);

/// A loop that needs nothing but a name.
[[nodiscard]] CatalogueEntry loop_named(const std::string& name);

/// An analysis with every figure set to something that can be told apart.
[[nodiscard]] AnalysisRecord record_at(std::int64_t slot_end_us, const std::string& digest);

/// A claim brought to its end with such a record.
[[nodiscard]] CompletedLoop completed(const ClaimedLoop& claim, std::int64_t slot_end_us,
                                      const std::string& digest);

/// Lets every lease end now, as if its time had passed.
inline constexpr const char* kEndLeases =
    "UPDATE loopscope.schedule SET visible_at = now() - interval '1 second'";

/// Gives the record a loop model of two steps; `holdout_error_after` of the second as JSON.
void explain(AnalysisRecord& record, const std::string& last_error = "0.25");

/// A migrated database of its own for each test; skipped, visibly, without a server.
class ResultsTest : public testing::Test {
 protected:
  /// A schema that flags at a false share of 5 %, for which the tests' p were chosen.
  void SetUp() override;

  /// Adds enabled loops that are due.
  void add_loops(const std::vector<std::string>& names);
  /// Claims everything that is due.
  std::vector<ClaimedLoop> claim_all(ResultsDatabase& results, double lease_s = 100.0);
  /// Judges all repairs anew, whether they are due or not.
  void judge_repairs() const;
  [[nodiscard]] ResultsDatabase connect() const { return ResultsDatabase(settings_for(*database)); }
  [[nodiscard]] std::string value(const std::string& sql) const { return database->value(sql); }

  std::unique_ptr<tests::TestDatabase> database;
};

}  // namespace loopscope::storage
