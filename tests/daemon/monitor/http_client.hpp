#pragma once

#include <chrono>
#include <string>

#include "config/http_address.hpp"

namespace loopscope::daemon {

/// One of this host that is free.
inline const config::HttpAddress kAnyPort{"127.0.0.1", 0, true};

/// A client that sends what it likes: one connection to a port of this host. Throws
/// std::runtime_error when it cannot connect.
class HttpClient {
 public:
  explicit HttpClient(int port, const std::string& host = "127.0.0.1");
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Whether the other side still takes it.
  bool send(const std::string& bytes) const;
  /// All that comes until the other side closes, or until `patience` is over.
  [[nodiscard]] std::string receive(
      std::chrono::milliseconds patience = std::chrono::seconds(10)) const;

 private:
  int descriptor_;
};

/// The whole answer, head and body, to one request; "" = none.
[[nodiscard]] std::string answer_to(int port, const std::string& request);
/// The same to GET of the path.
[[nodiscard]] std::string http_get(int port, const std::string& path);
/// What stands after the head.
[[nodiscard]] std::string body_of(const std::string& answer);

/// Shuts the socket of this process that listens on the port, as if the system had taken it away;
/// false = there is none.
bool shut_listening_socket(int port);

}  // namespace loopscope::daemon
