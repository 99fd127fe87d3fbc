#include "tests/support/pooler.hpp"

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/support/sql_connection.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {
namespace {

// A number of the socket's name only: the folder is the pooler's own.
constexpr const char* kPort = "6432";

std::optional<std::filesystem::path> find_pgbouncer() {
  // On the PATH of an ordinary user /usr/sbin is missing, where Debian installs it.
  for (const std::filesystem::path& folder :
       {source_dir() / "build/tools", std::filesystem::path("/usr/sbin")}) {
    if (access((folder / "pgbouncer").c_str(), X_OK) == 0) return folder / "pgbouncer";
  }
  return std::nullopt;
}

/// host=... port=... of the throw-away server.
std::string server_address() {
  std::istringstream words(test_server().value());
  std::string address;
  for (std::string word; words >> word;) {
    if (word.starts_with("host=") || word.starts_with("port=")) address += " " + word;
  }
  return address;
}

/// The file is there before somebody listens at it.
bool listens(const std::filesystem::path& file) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, file.c_str(), sizeof address.sun_path - 1);
  const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  const bool connected =
      connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(descriptor);
  return connected;
}

}  // namespace

bool has_pooler() {
  return find_pgbouncer().has_value();
}

Pooler::Pooler(const std::string& mode, const std::vector<std::string>& users,
               const std::string& more) {
  write_files(mode, users, more);
  std::vector<std::string> command{find_pgbouncer().value()};
  // It refuses to run as root; the server's own user reaches the server's socket.
  if (geteuid() == 0) command.insert(command.end(), {"-u", "postgres"});
  command.push_back(folder_.path() / "pgbouncer.ini");
  const std::filesystem::path log = folder_.path() / "pgbouncer.log";
  program_.emplace(command, log);
  const std::filesystem::path file =
      folder_.path() / "sockets" / (".s.PGSQL." + std::string(kPort));
  for (int tries = 0; !listens(file); ++tries) {
    if (tries == 500) throw std::runtime_error("no pooler: " + content_of(log));
    usleep(10'000);
  }
}

Pooler::~Pooler() {
  // SIGTERM: at once, whoever is connected.
  program_->send(SIGTERM);
  static_cast<void>(program_->wait(10));
}

void Pooler::write_files(const std::string& mode, const std::vector<std::string>& users,
                         const std::string& more) const {
  const std::filesystem::path sockets = folder_.path() / "sockets";
  std::filesystem::create_directory(sockets);
  // The user postgres passes through the one and writes into the other.
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::others_exec,
                               std::filesystem::perm_options::add);
  std::filesystem::permissions(sockets, std::filesystem::perms::all);
  std::ofstream(folder_.path() / "pgbouncer.ini")
      << "[databases]\n* =" << server_address()
      << "\n[pgbouncer]\nlisten_addr =\nlisten_port = " << kPort
      << "\nunix_socket_dir = " << sockets.string()
      << "\nauth_type = trust\nauth_file = " << (folder_.path() / "users").string()
      << "\npool_mode = " << mode << "\n"
      << more;
  std::ofstream file(folder_.path() / "users");
  for (const std::string& user : users) file << '"' << user << "\" \"\"\n";
}

std::string Pooler::conninfo(const std::string& conninfo) const {
  return with_key(with_key(conninfo, "host", folder_.path() / "sockets"), "port", kPort);
}

}  // namespace loopscope::tests
