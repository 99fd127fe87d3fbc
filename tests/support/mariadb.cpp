#include "tests/support/mariadb.hpp"

#include <arpa/inet.h>
#include <csignal>
#include <fstream>
#include <netinet/in.h>
#include <sstream>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace loopscope::tests {
namespace {

constexpr const char* kServer = "/usr/sbin/mariadbd";
constexpr const char* kClient = "/usr/bin/mariadb";
constexpr const char* kWrapper = "/usr/lib/postgresql/15/lib/mysql_fdw.so";

/// A port of the loopback interface that nobody listens at: mysql_fdw knows no other sockets.
std::string free_port() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  const bool bound =
      bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(descriptor);
  if (!bound) throw std::runtime_error("no port of the loopback interface is free");
  return std::to_string(ntohs(address.sin_port));
}

}  // namespace

bool has_mariadb() {
  return access(kServer, X_OK) == 0 && access(kWrapper, R_OK) == 0;
}

// Without tables of users there is nothing to install: it starts in a quarter of a second.
MariaDb::MariaDb() : port_(free_port()) {
  const std::filesystem::path data = folder_.path() / "data";
  std::filesystem::create_directory(data);
  const std::string place = folder_.path();
  std::vector<std::string> command{kServer,
                                   "--no-defaults",
                                   "--skip-grant-tables",
                                   "--datadir=" + data.string(),
                                   "--socket=" + place + "/socket",
                                   "--bind-address=127.0.0.1",
                                   "--port=" + port_,
                                   "--innodb-log-file-size=8M",
                                   "--innodb-buffer-pool-size=64M",
                                   "--innodb-flush-method=nosync",
                                   "--innodb-doublewrite=0",
                                   "--innodb-fast-shutdown=2",
                                   "--general-log=1",
                                   "--general-log-file=" + place + "/general.log"};
  // It refuses to run as root without being told to.
  if (geteuid() == 0) command.emplace_back("--user=root");
  const std::string log = place + "/log";
  program_.emplace(command, log);
  for (int tries = 0; !answers(); ++tries) {
    if (tries == 300) throw std::runtime_error("no MariaDB: " + content_of(log));
    usleep(50'000);
  }
}

MariaDb::~MariaDb() {
  program_->send(SIGTERM);
  static_cast<void>(program_->wait(10));
}

bool MariaDb::answers() const {
  const std::vector<std::string> make{kClient, "--no-defaults",
                                      "--socket=" + (folder_.path() / "socket").string(), "-e",
                                      "CREATE DATABASE IF NOT EXISTS plant"};
  return run_program(make).exit_code == 0;
}

std::string MariaDb::execute(const std::string& sql) const {
  const std::filesystem::path file = folder_.path() / "statements.sql";
  std::ofstream(file) << sql;
  const ProgramResult result =
      run_program({kClient, "--no-defaults", "--socket=" + (folder_.path() / "socket").string(),
                   "--skip-column-names", "plant", "-e", "source " + file.string()});
  if (result.exit_code != 0) throw std::runtime_error("MariaDB: " + result.err);
  return result.out;
}

std::string MariaDb::server_sql() const {
  return "CREATE EXTENSION IF NOT EXISTS mysql_fdw;"
         "CREATE SERVER mariadb FOREIGN DATA WRAPPER mysql_fdw"
         " OPTIONS (host '127.0.0.1', port '" +
         port_ + "'); CREATE USER MAPPING FOR PUBLIC SERVER mariadb;";
}

std::string MariaDb::statements() {
  std::istringstream log(content_of(folder_.path() / "general.log").substr(told_));
  std::string statements;
  for (std::string line; std::getline(log, line);) {
    told_ += line.size() + 1;
    const std::size_t at = line.find(" Execute\t");
    if (at != std::string::npos) statements += line.substr(at + 9) + "\n";
  }
  return statements;
}

}  // namespace loopscope::tests
