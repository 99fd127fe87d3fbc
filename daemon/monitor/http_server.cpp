#include "daemon/monitor/http_server.hpp"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <httplib.h>
#include <optional>
#include <spdlog/spdlog.h>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "daemon/failure.hpp"
#include "daemon/monitor/connection_queue.hpp"
#include "daemon/monitor/patient_socket.hpp"

namespace loopscope::daemon {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kThreads = 4;
constexpr int kMostWaiting = 64;
constexpr std::size_t kMostRequestBytes = std::size_t{32} * 1024;
/// For the whole request, and for the whole answer, of a client that nobody else waits behind.
constexpr milliseconds kPatience{5000};
/// The same while others wait for a thread.
constexpr milliseconds kPatienceInCrowd{250};

/// What httplib reads a request from and writes its answer to.
class Stream : public httplib::Stream {
 public:
  explicit Stream(PatientSocket& socket) : socket_(socket) {}

  [[nodiscard]] bool is_readable() const override { return true; }
  [[nodiscard]] bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override {
    return static_cast<ssize_t>(socket_.read(to, size));
  }
  ssize_t write(const char* from, std::size_t size) override {
    return socket_.write({from, size}) ? static_cast<ssize_t>(size) : -1;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  /// Asked for only to refuse descriptors that select() cannot take; PatientSocket polls.
  [[nodiscard]] socket_t socket() const override { return 0; }

 private:
  PatientSocket& socket_;
};

/// httplib's protocol over connections of ours: one request each.
class Protocol : public httplib::Server {
 public:
  Protocol() {
    new_task_queue = [this] { return new Queue(*this); };
    // The library's own choice, SO_REUSEPORT, would let a second instance listen on the same port
    // without a word, and each of them would get some of the requests.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
  }

  /// The port, or nullopt with errno.
  std::optional<int> bind(const config::HttpAddress& address) {
    errno = 0;
    int port = address.port;
    if (port == 0) {
      port = bind_to_any_port(address.host, AI_NUMERICHOST);
      if (port <= 0) return std::nullopt;
    } else if (!bind_to_port(address.host, port, AI_NUMERICHOST)) {
      return std::nullopt;
    }
    // Of the library's own queue of five every sixth client at a time waits a second to try again.
    ::listen(svr_sock_, kMostWaiting);
    return port;
  }

  /// Lets listen_after_bind() return, whether it has begun or not: to be called until it has.
  void stop_listening() {
    closing_ = true;
    if (is_running() && svr_sock_ != INVALID_SOCKET) stop();
  }

 private:
  class Queue : public httplib::TaskQueue {
   public:
    explicit Queue(Protocol& protocol) : protocol_(protocol), connections_(kThreads, kMostWaiting) {
      protocol_.connections_ = &connections_;
    }
    void enqueue(std::function<void()> serve) override { connections_.push(std::move(serve)); }
    void shutdown() override { connections_.shut_down(); }

   private:
    Protocol& protocol_;
    ConnectionQueue connections_;
  };

  [[nodiscard]] milliseconds patience() const {
    if (closing_) return milliseconds(0);
    return connections_->crowded() ? kPatienceInCrowd : kPatience;
  }

  bool process_and_close_socket(socket_t descriptor) override {
    PatientSocket socket(
        descriptor, [this] { return patience(); }, kMostRequestBytes);
    Stream stream(socket);
    bool closed = false;
    // A page asked for in a thousand overlapping ranges would be sent a thousand times.
    const auto forget_ranges = [](httplib::Request& request) { request.ranges.clear(); };
    try {
      process_request(stream, true, closed, forget_ranges);
      socket.finish();
    } catch (const std::exception& error) {  // out of memory, and whatever the library throws
      spdlog::error("HTTP: a request was dropped: {}", error.what());
    }
    return true;
  }

  std::atomic<bool> closing_ = false;
  ConnectionQueue* connections_ = nullptr;  ///< while listening
};

}  // namespace

struct HttpServer::Impl {
  explicit Impl(config::HttpAddress where) : address(std::move(where)) {}

  [[noreturn]] void refuse() const {
    const int error = errno;
    const std::string why =
        error == 0 ? "cannot be listened on" : std::generic_category().message(error);
    throw Failure(ExitCode::configuration,
                  fmt::format("HTTP: {}, address {} port {}", why, address.host, address.port),
                  "another instance may listen there, or the address is none of this host: give "
                  "each instance its own /daemon/http_address, or \"\" for no HTTP");
  }

  /// Until stop(). The library gives up listening after a few errors that pass by themselves
  /// (ECONNABORTED, ENFILE, ENOBUFS): a daemon without supervision has to begin again.
  void serve() {
    constexpr milliseconds kPause{500};
    while (!protocol.listen_after_bind() && !stopping) {
      spdlog::warn("HTTP: stopped listening, begins again");
      do {
        std::this_thread::sleep_for(kPause);
      } while (!stopping && !protocol.bind(address));
    }
    finished = true;
  }

  config::HttpAddress address;
  HttpRoutes routes;
  Protocol protocol;
  std::atomic<bool> stopping = false;
  std::atomic<bool> finished = false;
  std::thread thread;
};

HttpServer::HttpServer(config::HttpAddress address)
    : impl_(std::make_unique<Impl>(std::move(address))) {
  impl_->protocol.set_pre_routing_handler([impl = impl_.get()](const httplib::Request& request,
                                                               httplib::Response& response) {
    const HttpAnswer answer = impl->routes.answer(request.method, {request.path, request.params});
    response.status = answer.status;
    for (const auto& [name, value] : answer.headers) response.set_header(name, value);
    response.set_content(answer.body, answer.content_type);
    return httplib::Server::HandlerResponse::Handled;
  });
}

HttpServer::~HttpServer() {
  stop();
}

void HttpServer::handle(const std::string& path, HttpHandler handler) {
  impl_->routes.add(path, std::move(handler));
}

void HttpServer::handle_below(const std::string& prefix, HttpHandler handler) {
  impl_->routes.add_below(prefix, std::move(handler));
}

void HttpServer::start() {
  const std::optional<int> port = impl_->protocol.bind(impl_->address);
  if (!port) impl_->refuse();
  impl_->address.port = *port;
  // Signals are the main thread's: none shall end a wait of these threads. They inherit the mask.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  impl_->thread = std::thread([this] { impl_->serve(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void HttpServer::stop() {
  impl_->stopping = true;
  if (!impl_->thread.joinable()) return;
  while (!impl_->finished) {
    impl_->protocol.stop_listening();
    std::this_thread::sleep_for(milliseconds(1));
  }
  impl_->thread.join();
}

int HttpServer::port() const {
  return impl_->address.port;
}

}  // namespace loopscope::daemon
