#include "tests/support/reused_connection.hpp"

namespace loopscope::tests {

TextRows ReusedConnection::run(const std::string& sql, const std::string& null_text) const {
  std::unique_ptr<SqlConnection> connection = take();
  if (!connection || !connection->is_idle()) {
    connection = std::make_unique<SqlConnection>(conninfo_);
  }
  // A statement that fails, or leaves a transaction open, has had the connection for the last time.
  TextRows rows = connection->run(sql, null_text);
  if (!connection->is_idle()) return rows;
  connection->run("DISCARD ALL");
  put_back(std::move(connection));
  return rows;
}

std::unique_ptr<SqlConnection> ReusedConnection::take() const {
  const std::lock_guard lock(mutex_);
  return std::move(idle_);
}

void ReusedConnection::put_back(std::unique_ptr<SqlConnection> connection) const {
  const std::lock_guard lock(mutex_);
  idle_ = std::move(connection);
}

}  // namespace loopscope::tests
