#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "tests/support/sql_connection.hpp"

namespace loopscope::tests {

/// One connection for many statements, each of which finds it as if it were new: a server starts a
/// process for each connection, which takes longer than most statements of a test. What ALTER
/// DATABASE or ALTER ROLE has set holds from the next connection on: close() first, or use an
/// SqlConnection. Of statements that run at the same time each has a connection of its own.
class ReusedConnection {
 public:
  /// Connects with the first statement.
  explicit ReusedConnection(std::string conninfo) : conninfo_(std::move(conninfo)) {}

  /// As SqlConnection::run; what it sets or leaves open does not outlast it.
  // NOLINTNEXTLINE(modernize-use-nodiscard): of most commands no rows are expected
  TextRows run(const std::string& sql, const std::string& null_text = "NULL") const;
  /// The next statement connects anew.
  void close() const { (void)take(); }

 private:
  std::unique_ptr<SqlConnection> take() const;
  void put_back(std::unique_ptr<SqlConnection> connection) const;

  std::string conninfo_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<SqlConnection> idle_;
};

}  // namespace loopscope::tests
