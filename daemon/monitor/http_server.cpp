#include "daemon/monitor/http_server.hpp"

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/post.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <thread>
#include <utility>

#include "daemon/monitor/connection_table.hpp"
#include "daemon/monitor/http_connection.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using asio::ip::tcp;

/// In the kernel, until they are accepted: as many as a host may open at once by accident.
constexpr int kMostUnaccepted = 512;

/// Throws std::system_error.
void listen_at(tcp::acceptor& acceptor, const config::HttpAddress& address) {
  const tcp::endpoint endpoint(asio::ip::make_address(address.host),
                               static_cast<asio::ip::port_type>(address.port));
  acceptor.open(endpoint.protocol());
  // Not SO_REUSEPORT: a second instance would get some of the requests without a word.
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(endpoint);
  acceptor.listen(kMostUnaccepted);
}

[[noreturn]] void refuse(const config::HttpAddress& address, const std::system_error& error) {
  throw Failure(ExitCode::configuration,
                fmt::format("HTTP: {}, address {} port {}", error.code().message(), address.host,
                            address.port),
                "another instance may listen there, or the address is not one of this host: give "
                "each instance its own /daemon/http_address, or \"\" for no HTTP");
}

}  // namespace

struct HttpServer::Impl {
  Impl(config::HttpAddress where, std::vector<std::string> names)
      : address(std::move(where)), site{{}, HostNames(std::move(names))} {}

  void run();
  void accept();
  void on_accept(const std::error_code& error, tcp::socket socket);
  void listen_later();
  void listen_again();
  void shut();

  config::HttpAddress address;
  HttpSite site;
  /// Shared with replies that are under way when the server ends.
  std::shared_ptr<asio::io_context> io = std::make_shared<asio::io_context>(1);
  tcp::acceptor acceptor{*io};
  asio::steady_timer pause{*io};
  ConnectionTable connections;
  bool stopping = false;  ///< the thread's own: nothing waits for it, what is pending is cancelled
  std::thread thread;
};

/// Until shut(). What a handler throws, out of memory that is, costs one client its answer.
void HttpServer::Impl::run() {
  for (;;) {
    try {
      io->run();
      return;
    } catch (const std::exception& error) {
      spdlog::error("HTTP: a request was dropped: {}", error.what());
    }
  }
}

void HttpServer::Impl::accept() {
  acceptor.async_accept([this](const std::error_code& error, tcp::socket socket) {
    on_accept(error, std::move(socket));
  });
}

void HttpServer::Impl::on_accept(const std::error_code& error, tcp::socket socket) {
  if (stopping) return;
  if (error) {
    spdlog::warn("HTTP: stopped listening, begins again: {}", error.message());
    return listen_later();
  }
  accept();  // first, since what follows may throw
  const auto connection = std::make_shared<HttpConnection>(io, std::move(socket), site);
  connection->start();
  connections.add(connection);
}

/// Errors of accepting pass by themselves (ENFILE, ENOBUFS): a daemon without supervision has to
/// begin again.
void HttpServer::Impl::listen_later() {
  constexpr std::chrono::milliseconds kPause{500};
  std::error_code ignored;
  acceptor.close(ignored);
  pause.expires_after(kPause);
  pause.async_wait([this](const std::error_code&) {
    if (!stopping) listen_again();
  });
}

void HttpServer::Impl::listen_again() {
  try {
    listen_at(acceptor, address);
    accept();
  } catch (const std::system_error&) {
    listen_later();
  }
}

void HttpServer::Impl::shut() {
  stopping = true;
  pause.cancel();
  std::error_code ignored;
  acceptor.close(ignored);
  connections.hurry_all();
}

HttpServer::HttpServer(config::HttpAddress address, std::vector<std::string> names)
    : impl_(std::make_unique<Impl>(std::move(address), std::move(names))) {}

HttpServer::~HttpServer() {
  stop();
}

void HttpServer::handle(const std::string& path, HttpHandler handler) {
  impl_->site.routes.add(path, std::move(handler));
}

void HttpServer::handle_deferred(const std::string& path, DeferredHandler handler) {
  impl_->site.routes.add_deferred(path, std::move(handler));
}

void HttpServer::handle_form(const std::string& path, FormRoute form) {
  impl_->site.routes.add_form(path, std::move(form));
}

void HttpServer::start() {
  try {
    listen_at(impl_->acceptor, impl_->address);
  } catch (const std::system_error& error) {
    refuse(impl_->address, error);
  }
  impl_->address.port = impl_->acceptor.local_endpoint().port();
  impl_->accept();
  // Signals are the main thread's: none shall end a wait of this one. It inherits the mask.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void HttpServer::use_names(std::vector<std::string> names) {
  asio::post(*impl_->io, [impl = impl_.get(), names = HostNames(std::move(names))] {
    impl->site.names = names;
  });
}

void HttpServer::stop() {
  if (!impl_->thread.joinable()) return;
  asio::post(*impl_->io, [impl = impl_.get()] { impl->shut(); });
  impl_->thread.join();
}

int HttpServer::port() const {
  return impl_->address.port;
}

}  // namespace loopscope::daemon
