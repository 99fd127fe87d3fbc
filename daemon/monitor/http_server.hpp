#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/http_address.hpp"
#include "daemon/monitor/http_routes.hpp"

namespace loopscope::daemon {

/// Answers by its routes, on one thread that waits for nobody: clients that are slow, silent or
/// many hold a place in a table and nothing else (HttpConnection, ConnectionTable).
///
///   HttpServer server(address);
///   server.handle("/livez", [&](const HttpRequest&) { ... });
///   server.start();
class HttpServer {
 public:
  /// `names`: what it may be called beside addresses and localhost (HostNames).
  explicit HttpServer(config::HttpAddress address, std::vector<std::string> names = {});
  ~HttpServer();  ///< stops
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// See HttpRoutes; all before start().
  void handle(const std::string& path, HttpHandler handler);
  void handle_deferred(const std::string& path, DeferredHandler handler);
  void handle_form(const std::string& path, FormRoute form);

  /// Listens from now on. Throws Failure (configuration) when the address cannot be had.
  void start();
  /// Other names from now on. Thread-safe.
  void use_names(std::vector<std::string> names);
  /// Answers nobody from now on; returns when the last answer that had begun is out, within a
  /// moment. Not to be called by a handler.
  void stop();
  /// The port that is listened on, after start(): the one of the address, or the one that was free.
  [[nodiscard]] int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::daemon
