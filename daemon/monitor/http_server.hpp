#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "config/http_address.hpp"

namespace loopscope::daemon {

struct HttpRequest {
  std::string path;  ///< decoded
  std::multimap<std::string, std::string> query;
};

struct HttpAnswer {
  int status = 200;
  std::string body;
  std::string content_type = "text/plain; charset=utf-8";
  std::multimap<std::string, std::string> headers = {};  ///< more of them, never out of a request
};

/// Reads only: GET and HEAD, everything else is 405. Answers are never stored by anybody
/// (Cache-Control: no-store) nor guessed at (nosniff). A few threads serve; whoever is slow loses
/// his place to those who wait, so that no client can starve the others.
///
///   HttpServer server(address);
///   server.handle("/livez", [&](const HttpRequest&) { ... });
///   server.start();
class HttpServer {
 public:
  /// Called from several threads at once. An exception becomes 500 without its words. It should
  /// take milliseconds: it holds one of the few threads.
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  explicit HttpServer(config::HttpAddress address);
  ~HttpServer();  ///< stops
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// The handler of exactly this path. Before start().
  void handle(const std::string& path, Handler handler);
  /// The handler of every path that begins with `prefix` and has none of its own; of several the
  /// longest prefix counts. Before start().
  void handle_below(const std::string& prefix, Handler handler);

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
