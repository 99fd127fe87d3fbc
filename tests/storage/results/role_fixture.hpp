#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/login_session.hpp"

namespace loopscope::storage {

inline constexpr const char* kRefused = "42501";
/// What a view says before rights are looked at.
inline constexpr const char* kNotUpdatable = "55000";

/// A schema made by a login of the owner's group, beside a site's own tables, and a login for each
/// of the five groups and one of none. Every role tries everything: the objects come from the
/// catalogue, so that a new one is tried too.
class RoleTest : public testing::Test {
 protected:
  void SetUp() override;

  [[nodiscard]] tests::LoginSession log_in(const std::string& user) const {
    return tests::LoginSession(database->conninfo(user));
  }
  /// Tries a command; allowed means that whatever it fails by, it is not for want of rights.
  static void expect_state(const tests::LoginSession& session, const std::string& command,
                           bool allowed);
  /// Tables, views and partitions of a schema: name, whether a view, whether a partition.
  [[nodiscard]] tests::TextRows relations(const std::string& schema) const;
  [[nodiscard]] std::vector<std::string> columns(const std::string& relation) const;

  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader, engineer, historian, stranger;
};

/// Commands that change what a table or view is; nobody but its owner may.
[[nodiscard]] std::vector<std::string> ddl_on(const std::string& relation, bool view);

}  // namespace loopscope::storage
