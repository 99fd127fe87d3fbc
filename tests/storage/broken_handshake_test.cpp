#include <arpa/inet.h>
#include <array>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

enum class Breaks { at_once, after_offering_tls, in_the_handshake };

/// Accepts connections on a loopback port and ends each as a server that dies does.
class DyingServer {
 public:
  DyingServer(Breaks when, bool by_reset) : when_(when), by_reset_(by_reset) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (listener_ < 0 || bind(listener_, generic, size) != 0 || listen(listener_, 8) != 0 ||
        getsockname(listener_, generic, &size) != 0) {
      throw std::runtime_error("no listening socket");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::jthread([this] { serve(); });
  }
  ~DyingServer() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  DyingServer(const DyingServer&) = delete;
  DyingServer& operator=(const DyingServer&) = delete;

  [[nodiscard]] int port() const { return port_; }

 private:
  void serve() const {
    for (int peer = accept(listener_, nullptr, nullptr); peer >= 0;
         peer = accept(listener_, nullptr, nullptr)) {
      std::array<char, 4096> bytes{};
      // SSLRequest, "S" for yes, ClientHello.
      if (when_ != Breaks::at_once) {
        (void)!read(peer, bytes.data(), bytes.size());
        (void)!write(peer, "S", 1);
      }
      if (when_ == Breaks::in_the_handshake) (void)!read(peer, bytes.data(), bytes.size());
      const linger at_once{1, 0};
      if (by_reset_) setsockopt(peer, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
      close(peer);
    }
  }

  Breaks when_;
  bool by_reset_;
  int listener_ = socket(AF_INET, SOCK_STREAM, 0);
  int port_ = 0;
  std::jthread thread_;
};

/// In libpq's own words, whatever its version: nothing of this may end a worker's patience.
TEST(BrokenHandshake, IsTriedAgainWheneverItBreaks) {
  for (const Breaks when :
       {Breaks::at_once, Breaks::after_offering_tls, Breaks::in_the_handshake}) {
    for (const bool by_reset : {false, true}) {
      const DyingServer server(when, by_reset);
      ConnectionSettings settings;
      settings.conninfo = "host=127.0.0.1 port=" + std::to_string(server.port()) +
                          " user=plant dbname=postgres sslmode=require";
      settings.purpose = "plant";
      for (const bool by_libpqxx : {true, false}) {
        try {
          if (by_libpqxx) {
            const Session session(settings);
          } else {
            const PqConnection connection(settings);
          }
          ADD_FAILURE() << "connected";
        } catch (const DatabaseError& error) {
          EXPECT_EQ(error.remedy(), Remedy::reconnect) << error.what();
          EXPECT_THAT(error.hint(), HasSubstr("a worker tries again")) << error.what();
        }
      }
    }
  }
}

}  // namespace
}  // namespace loopscope::storage
