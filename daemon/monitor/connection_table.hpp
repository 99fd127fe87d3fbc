#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "daemon/monitor/http_connection.hpp"

namespace loopscope::daemon {

/// The connections of a server, with a limit. Whoever comes when it is reached gets the place of
/// the one that has been idle longest: of the same address where that one alone has too many, so
/// that who opens connections by the hundred closes his own. For one thread at a time.
class ConnectionTable {
 public:
  struct Limits {
    std::size_t all = 512;         ///< half of the 1024 descriptors that a process usually has
    std::size_t of_address = 256;  ///< a proxy and all its readers, or half of the places
  };

  ConnectionTable() : ConnectionTable(Limits{}) {}
  explicit ConnectionTable(Limits limits) : limits_(limits) {}

  /// Takes it and makes room for it. Where everybody else waits for an answer, it is closed itself.
  void add(std::shared_ptr<HttpConnection> connection);
  /// HttpConnection::hurry() of each.
  void hurry_all();

  /// Those that are open.
  [[nodiscard]] std::size_t size();

 private:
  void forget_closed();
  [[nodiscard]] HttpConnection* idle_longest(const asio::ip::address* from) const;

  Limits limits_;
  std::vector<std::shared_ptr<HttpConnection>> connections_;
};

}  // namespace loopscope::daemon
