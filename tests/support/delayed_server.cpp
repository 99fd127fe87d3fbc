#include "tests/support/delayed_server.hpp"

#include <array>
#include <cstring>
#include <libpq-fe.h>
#include <memory>
#include <poll.h>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <vector>

#include "tests/support/sql_connection.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {
namespace {

constexpr const char* kSocket = ".s.PGSQL.5432";

sockaddr_un address_of(const std::filesystem::path& file) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, file.c_str(), sizeof address.sun_path - 1);
  return address;
}

std::filesystem::path server_folder() {
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
      PQconninfoParse(test_server().value().c_str(), nullptr), PQconninfoFree);
  for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
    if (std::string_view(option->keyword) == "host") return option->val;
  }
  throw std::runtime_error("the test server has no socket");
}

/// False when nothing more will come.
bool pass_on(int from, int to, std::chrono::milliseconds delay) {
  std::array<char, 65536> data{};
  const ssize_t size = read(from, data.data(), data.size());
  if (size <= 0) return false;
  std::this_thread::sleep_for(delay);
  std::string_view rest(data.data(), static_cast<std::size_t>(size));
  while (!rest.empty()) {
    const ssize_t written = send(to, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (written <= 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void relay(int client, int server, std::chrono::milliseconds delay) {
  std::array<pollfd, 2> ends{{{client, POLLIN, 0}, {server, POLLIN, 0}}};
  for (bool open = true; open;) {
    if (poll(ends.data(), ends.size(), -1) < 0) break;
    if (ends[0].revents != 0) open = pass_on(client, server, delay);
    if (open && ends[1].revents != 0) open = pass_on(server, client, delay);
  }
  close(client);
  close(server);
}

}  // namespace

DelayedServer::DelayedServer(std::chrono::milliseconds delay)
    : delay_(delay),
      server_(server_folder() / kSocket),
      listener_(socket(AF_UNIX, SOCK_STREAM, 0)) {
  const sockaddr_un address = address_of(folder_.path() / kSocket);
  if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener_, SOMAXCONN) != 0) {
    throw std::runtime_error("no socket in " + folder_.path().string());
  }
  acceptor_ = std::thread([this] { serve(); });
}

DelayedServer::~DelayedServer() {
  shutdown(listener_, SHUT_RDWR);
  acceptor_.join();
  close(listener_);
}

std::string DelayedServer::conninfo(const std::string& conninfo) const {
  return with_key(with_key(conninfo, "host", folder_.path()), "port", "5432");
}

void DelayedServer::serve() {
  std::vector<std::thread> relays;
  for (int client; (client = accept(listener_, nullptr, nullptr)) >= 0;) {
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    const sockaddr_un address = address_of(server_);
    if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      close(client);
      close(server);
      continue;
    }
    relays.emplace_back(relay, client, server, delay_);
  }
  for (std::thread& one : relays) one.join();
}

}  // namespace loopscope::tests
