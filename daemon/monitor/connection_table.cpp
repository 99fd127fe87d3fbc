#include "daemon/monitor/connection_table.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::daemon {

void ConnectionTable::forget_closed() {
  std::erase_if(connections_, [](const auto& one) { return !one->is_open(); });
}

std::size_t ConnectionTable::size() {
  forget_closed();
  return connections_.size();
}

/// Of one address, or (nullptr) of all.
HttpConnection* ConnectionTable::idle_longest(const asio::ip::address* from) const {
  HttpConnection* longest = nullptr;
  for (const auto& one : connections_) {
    if ((from != nullptr && one->from() != *from) || !one->idle_since()) continue;
    if (longest == nullptr || *one->idle_since() < *longest->idle_since()) longest = one.get();
  }
  return longest;
}

void ConnectionTable::add(std::shared_ptr<HttpConnection> connection) {
  forget_closed();
  const asio::ip::address from = connection->from();
  connections_.push_back(std::move(connection));
  const auto of_address =
      std::ranges::count_if(connections_, [&](const auto& one) { return one->from() == from; });
  const bool address_full = static_cast<std::size_t>(of_address) > limits_.of_address;
  if (!address_full && connections_.size() <= limits_.all) return;
  // There is one: the newest itself is idle.
  if (HttpConnection* one = idle_longest(address_full ? &from : nullptr)) one->close();
}

void ConnectionTable::hurry_all() {
  for (const auto& one : connections_) one->hurry();
}

}  // namespace loopscope::daemon
