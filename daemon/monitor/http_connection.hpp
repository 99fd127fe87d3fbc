#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "daemon/monitor/host_names.hpp"
#include "daemon/monitor/http_answer.hpp"
#include "daemon/monitor/http_routes.hpp"

namespace loopscope::daemon {

/// What all connections of a server have in common.
struct HttpSite {
  HttpRoutes routes;
  HostNames names;
};

/// One client, one request, one answer; then it is closed. No thread waits for it: all that
/// happens, happens on the thread of the io_context. Each phase has an end in time, so that a
/// client that sends a byte now and then is closed like one that is silent.
///
///   reading ── whole head, ──► waiting ── reply ──► writing ── all out ──► finishing ──► closed
///              of a form its body
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  using Clock = std::chrono::steady_clock;

  /// The site outlives it.
  HttpConnection(const std::shared_ptr<asio::io_context>& io, asio::ip::tcp::socket socket,
                 const HttpSite& site);

  /// To be called once.
  void start();
  /// At once, whatever was being answered; nothing where it is closed.
  void close();
  /// The server ends: an answer that has begun has a moment still, nothing else begins.
  void hurry();

  [[nodiscard]] bool is_open() const { return phase_ != Phase::closed; }
  [[nodiscard]] const asio::ip::address& from() const { return from_; }
  /// Since when nothing came from, or went to, the client; nullopt while it waits for an answer.
  [[nodiscard]] std::optional<Clock::time_point> idle_since() const;

 private:
  enum class Phase { reading, waiting, writing, finishing, closed };

  void enter(Phase phase, Clock::duration patience);
  void on_deadline();
  void on_head(const std::error_code& error, std::size_t bytes);
  void ask();
  void read_form();
  void go_on();
  void read_rest();
  void answer(Clock::duration patience);
  [[nodiscard]] HttpReply reply();
  void refuse(int status, const std::string& words);
  void write(std::shared_ptr<const HttpAnswer> answer);
  void finish();
  void discard(std::size_t so_far);

  std::weak_ptr<asio::io_context> io_;  ///< whose handlers own this
  asio::ip::tcp::socket socket_;
  asio::steady_timer deadline_;
  const HttpSite& site_;
  asio::ip::address from_;
  Phase phase_ = Phase::reading;
  Clock::time_point moved_at_ = Clock::now();
  std::shared_ptr<std::atomic<bool>> waits_ = std::make_shared<std::atomic<bool>>(false);
  std::string received_;
  HttpRequest request_;
  bool is_of_form_ = false;     ///< GET of a form's page
  std::size_t form_bytes_ = 0;  ///< of the body that is read, or was
  HttpMessage message_;
};

}  // namespace loopscope::daemon
