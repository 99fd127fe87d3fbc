#pragma once

#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "core/signal/raw_series.hpp"
#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"
#include "storage/historian/tag_request.hpp"
#include "tests/support/mariadb.hpp"
#include "tests/support/mariadb_tables.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {

inline constexpr std::int64_t kSecond_us = 1'000'000;
// 2026-03-30 00:00 UTC: the clocks of Berlin were put forward the day before.
inline constexpr std::int64_t kEnd_us = 1'774'828'800'000'000;

/// Bit for bit.
void expect_same(const core::signal::RawSeries& read, const core::signal::RawSeries& expected,
                 const storage::TagRequest& request);

/// A database and a MariaDB for each test; skipped, visibly, without them.
class Foreign : public testing::Test {
 protected:
  void SetUp() override;
  /// Two tables of one content: native, in PostgreSQL, and the foreign table elsewhere.
  void make_history();
  /// A foreign table of (tag, time, value, quality) over one of MariaDB, with more options of it.
  void make_foreign(const std::string& name, const std::string& remote,
                    const std::string& options = "") const;
  [[nodiscard]] storage::ConnectionSettings connection() const;
  [[nodiscard]] static storage::SourceLayout layout_of(const std::string& table,
                                                       storage::TimeKind kind);

  std::optional<TestDatabase> database;
  std::optional<MariaDb> mariadb;
};

}  // namespace loopscope::tests
