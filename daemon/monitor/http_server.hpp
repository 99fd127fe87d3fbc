#pragma once

#include <memory>
#include <string>

#include "config/http_address.hpp"
#include "daemon/monitor/http_routes.hpp"

namespace loopscope::daemon {

/// Answers by its routes. Answers are never stored by anybody (Cache-Control: no-store) nor guessed
/// at (nosniff). A few threads serve; whoever is slow loses his place to those who wait, so that no
/// client can starve the others.
///
///   HttpServer server(address);
///   server.handle("/livez", [&](const HttpRequest&) { ... });
///   server.start();
class HttpServer {
 public:
  explicit HttpServer(config::HttpAddress address);
  ~HttpServer();  ///< stops
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// See HttpRoutes; both before start(). A handler should take milliseconds: it holds one of the
  /// few threads.
  void handle(const std::string& path, HttpHandler handler);
  void handle_below(const std::string& prefix, HttpHandler handler);

  /// Listens from now on. Throws Failure (configuration) when the address cannot be had.
  void start();
  /// Answers nobody from now on; returns when the last answer that had begun is out, within a
  /// moment.
  void stop();
  /// The port that is listened on, after start(): the one of the address, or the one that was free.
  [[nodiscard]] int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::daemon
