#include "daemon/monitor/connection_table.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace loopscope::daemon {
namespace {

using asio::ip::tcp;
using namespace std::chrono_literals;

/// Connections from several addresses of the loopback, accepted and served by hand.
class ConnectionTableTest : public testing::Test {
 protected:
  void SetUp() override {
    site.routes.add_deferred("/slow", [](const HttpRequest&, const HttpReply&) {});
  }

  /// A client of the address that sends these bytes; its end at the server is in the table.
  std::shared_ptr<HttpConnection> connect(const std::string& from, const std::string& bytes = "") {
    tcp::socket client(*io, tcp::v4());
    client.bind({asio::ip::make_address(from), 0});
    client.connect(acceptor.local_endpoint());
    client.send(asio::buffer(bytes));
    const auto connection = std::make_shared<HttpConnection>(io, acceptor.accept(), site);
    clients.push_back(std::move(client));
    connection->start();
    table.add(connection);
    io->poll();
    std::this_thread::sleep_for(1ms);  // the clock tells one from the next
    return connection;
  }

  std::shared_ptr<asio::io_context> io = std::make_shared<asio::io_context>();
  tcp::acceptor acceptor{*io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
  HttpSite site;
  ConnectionTable table{{.all = 4, .of_address = 2}};
  std::vector<tcp::socket> clients;
};

const std::string kSlow = "GET /slow HTTP/1.1\r\nHost: localhost\r\n\r\n";

TEST_F(ConnectionTableTest, WhoComesToAFullTableGetsThePlaceOfTheOneIdleLongest) {
  const auto oldest = connect("127.0.0.1");
  const auto second = connect("127.0.0.2");
  const auto third = connect("127.0.0.3");
  const auto fourth = connect("127.0.0.4");
  EXPECT_EQ(table.size(), 4U);
  const auto newest = connect("127.0.0.5");
  EXPECT_EQ(table.size(), 4U);
  EXPECT_FALSE(oldest->is_open());
  EXPECT_TRUE(second->is_open() && third->is_open() && fourth->is_open() && newest->is_open());
}

TEST_F(ConnectionTableTest, AddressWithManyClosesItsOwn) {
  const auto other = connect("127.0.0.1");
  const auto first = connect("127.0.0.2");
  const auto second = connect("127.0.0.2");
  const auto third = connect("127.0.0.2");
  EXPECT_TRUE(other->is_open() && second->is_open() && third->is_open());
  EXPECT_FALSE(first->is_open());
}

TEST_F(ConnectionTableTest, WhoWaitsForAnAnswerIsNotIdle) {
  const auto waiting = connect("127.0.0.1", kSlow);
  EXPECT_FALSE(waiting->idle_since());
  const auto idle = connect("127.0.0.1");
  const auto newest = connect("127.0.0.1");
  EXPECT_TRUE(waiting->is_open() && newest->is_open());
  EXPECT_FALSE(idle->is_open());
}

TEST_F(ConnectionTableTest, WhereAllWaitTheNewestIsTurnedAway) {
  const auto first = connect("127.0.0.1", kSlow);
  const auto second = connect("127.0.0.1", kSlow);
  const auto third = connect("127.0.0.1");
  EXPECT_TRUE(first->is_open() && second->is_open());
  EXPECT_FALSE(third->is_open());
}

}  // namespace
}  // namespace loopscope::daemon
