#pragma once

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "daemon/service/historians/storage_settings.hpp"
#include "storage/historian/historian_reader.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {

inline constexpr int kRows = 20;

/// One vendor's tables with 20 rows of one loop, spoilt as each test says.
class Trap : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    database.emplace();
    truth.emplace(*database, 1, kRows);
  }

  void use(const std::string& name, const std::string& spoil = "") {
    chosen = &vendor(name);
    database->execute(chosen->tables);
    if (!spoil.empty()) database->execute(spoil);
    settings = settings_of(*chosen, database->conninfo());
  }

  storage::HistorianReader reader() const {
    return {daemon::historian_connection(settings), daemon::historian_layout(settings)};
  }

  core::signal::RawSeries read(storage::HistorianReader& historian, const std::string& role,
                               int first = 0, int last = kRows - 1,
                               storage::RowBefore before = storage::RowBefore::no) const {
    return historian
        .read(std::vector{storage::TagRequest{tag_of(*chosen, 1, role), Truth::time_us(first),
                                              Truth::time_us(last), 1000, before}})
        .at(0);
  }
  core::signal::RawSeries read(const std::string& role) const {
    storage::HistorianReader historian = reader();
    return read(historian, role);
  }
  double value(const std::string& role, int k) const { return truth->rows(1, role, k, k)[0].value; }

  std::optional<TestDatabase> database;
  std::optional<Truth> truth;
  const Vendor* chosen = nullptr;
  config::HistorianSettings settings;
};

}  // namespace loopscope::tests
