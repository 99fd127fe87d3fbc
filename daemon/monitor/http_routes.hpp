#pragma once

#include <functional>
#include <map>
#include <string>

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

/// Called from several threads at once.
using HttpHandler = std::function<HttpAnswer(const HttpRequest&)>;

/// Which handler answers which path. Reading only: GET and HEAD, everything else is 405.
class HttpRoutes {
 public:
  /// The handler of exactly this path.
  void add(const std::string& path, HttpHandler handler);
  /// The handler of every path that begins with `prefix` and has none of its own; of several the
  /// longest prefix counts.
  void add_below(const std::string& prefix, HttpHandler handler);

  /// Never throws for a handler's sake: what one throws goes to the log, its words not to the
  /// client, who gets 500.
  [[nodiscard]] HttpAnswer answer(const std::string& method, const HttpRequest& request) const;

 private:
  [[nodiscard]] const HttpHandler* handler_of(const std::string& path) const;

  std::map<std::string, HttpHandler> exact_;
  std::map<std::string, HttpHandler> below_;
};

}  // namespace loopscope::daemon
