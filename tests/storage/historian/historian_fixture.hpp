#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "storage/historian/historian_reader.hpp"
#include "storage/historian/historian_writer.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::storage {

/// 2026-01-01 00:00:00 UTC plus so many seconds, in microseconds.
[[nodiscard]] std::int64_t second(std::int64_t seconds);

/// Everything of a tag between two times of second(), oldest first.
[[nodiscard]] TagRequest request(const std::string& tag, std::int64_t from_s, std::int64_t to_s,
                                 std::int64_t max_rows = 1000);

/// Rows at seconds 0, 1, 2, ...
[[nodiscard]] TagRows rows_of(const std::string& tag, const std::vector<double>& values);

/// The rows of a single request.
[[nodiscard]] core::signal::RawSeries read_one(HistorianReader& reader, const TagRequest& wanted);

/// A database with an empty table public.history for each test; skipped, visibly, without a server.
class HistorianTest : public testing::Test {
 protected:
  void SetUp() override;
  [[nodiscard]] ConnectionSettings settings(const std::string& user = "") const;
  [[nodiscard]] HistorianReader reader() const { return HistorianReader(settings(), layout); }
  /// Inserts a row: tag, time as text, value and quality as SQL.
  void insert(const std::string& tag, const std::string& time, const std::string& value,
              const std::string& quality = "192");

  std::unique_ptr<tests::TestDatabase> database;
  SourceLayout layout;
};

}  // namespace loopscope::storage
