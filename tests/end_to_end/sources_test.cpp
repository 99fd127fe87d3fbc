#include <algorithm>
#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// A port that takes connections and never answers: a server that stands still without dying.
class SilentServer {
 public:
  SilentServer() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(socket_, generic, length) != 0 || listen(socket_, 100) != 0) std::abort();
    getsockname(socket_, generic, &length);
    port_ = ntohs(address.sin_port);
  }
  ~SilentServer() { close(socket_); }
  SilentServer(const SilentServer&) = delete;
  SilentServer& operator=(const SilentServer&) = delete;
  [[nodiscard]] std::string conninfo() const {
    return "host=127.0.0.1 dbname=x user=x port=" + std::to_string(port_);
  }

 private:
  int socket_;
  int port_ = 0;
};

std::string historian(const std::string& name, const std::string& connection, int max_connections) {
  return R"({"name": ")" + name + R"(", "connection": ")" + connection +
         R"(", "max_connections": )" + std::to_string(max_connections) + "}";
}

/// A plant whose rows are reached under two names, with a limit each. The readers' roles cannot
/// open more connections than that: the server would refuse them.
class Sources : public testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& role : roles_)
      plant.sql("drop owned by " + role + "; drop role " + role);
  }
  std::string reader(int limit) {
    const std::string role =
        "reader_" + std::to_string(getpid()) + "_" + std::to_string(roles_.size());
    plant.sql("create role " + role + " login connection limit " + std::to_string(limit) +
              "; grant select on history to " + role);
    roles_.push_back(role);
    return plant.connection() + " user=" + role;
  }
  void write_settings(const std::vector<std::string>& historians, int workers) const {
    std::string list;
    for (const std::string& one : historians) list += (list.empty() ? "" : ", ") + one;
    plant.write_settings(R"({"results": {"connection": "@RESULTS@"}, "historians": [)" + list +
                         R"(], "schedule": {"batch_loops": 1, "poll_s": 0.2, "settle_s": 0},
                            "daemon": {"workers": )" +
                         std::to_string(workers) + "}}");
  }
  /// Copies of the loop's catalogue entry.
  void add_copies(const std::string& source, int count) const {
    plant.sql(
        "insert into loopscope.loop (name, source, sp_tag, pv_tag, op_tag, period_s, "
        "interval_s) select '" +
        source + " ' || n, '" + source +
        "', sp_tag, pv_tag, op_tag, period_s, interval_s "
        "from loopscope.loop, generate_series(1, " +
        std::to_string(count) + ") as n where name = 'FIC101'");
  }
  [[nodiscard]] int connections_of(const std::string& source) const {
    return std::stoi(
        plant.sql("select count(*) from pg_stat_activity where datname = current_database() and "
                  "application_name like 'loopscope/historian " +
                  source + "/%'"));
  }
  Plant plant;

 private:
  std::vector<std::string> roles_;
};

TEST_F(Sources, EachHasItsOwnLimitOfConnectionsOverAllWorkers) {
  plant.import_loop("FIC101");
  const std::string one = reader(1), two = reader(2);
  write_settings({historian("plant", one, 1), historian("second", two, 2)}, 6);
  add_copies("plant", 60);
  add_copies("second", 60);
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  int most_of_one = 0;
  int most_of_two = 0;
  // Time, not a number of looks: how fast these are is the machine's.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end) {
    most_of_one = std::max(most_of_one, connections_of("plant"));
    most_of_two = std::max(most_of_two, connections_of("second"));
    if (plant.sql("select count(distinct loop_id) from loopscope.analysis") == "121") break;
  }
  EXPECT_EQ(plant.sql("select count(distinct loop_id) from loopscope.analysis"), "121");
  EXPECT_EQ(plant.sql("select coalesce(max(last_error), 'none') from loopscope.schedule"), "none");
  EXPECT_EQ(most_of_one, 1);
  EXPECT_GE(most_of_two, 1);
  EXPECT_LE(most_of_two, 2);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

TEST_F(Sources, OneThatStandsStillDoesNotHoldUpTheOthers) {
  const SilentServer silent;
  plant.import_loop("FIC101");
  write_settings({historian("plant", "@CONNECTION@", 4), historian("silent", silent.conninfo(), 2)},
                 1);
  add_copies("silent", 30);
  add_copies("plant", 10);
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult pass = plant.loopscope("once");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(pass.exit_code, 4);
  EXPECT_THAT(pass.out, HasSubstr("41 loops: 11 new, 0 revised, 0 unchanged, 30 failed"));
  // One wait of connect_timeout, 5 s, not thirty; the rest is eleven analyses on a busy machine.
  EXPECT_LT(took.count(), 60.0);
  EXPECT_EQ(plant.sql("select count(*) from loopscope.schedule where last_error is not null"),
            "30");
}

TEST_F(Sources, OneThatComesBackIsReadAgain) {
  plant.import_loop("FIC101");
  const std::string connection = reader(0);
  write_settings({historian("plant", connection, 1)}, 2);
  EXPECT_EQ(plant.loopscope("once").exit_code, 4) << "the role may not connect at all";
  plant.sql("alter role " + connection.substr(connection.rfind('=') + 1) + " connection limit 1");
  const ProgramResult pass = plant.loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.out, HasSubstr("1 new"));
}

}  // namespace
}  // namespace loopscope::tests
