#include "daemon/monitor/http_connection.hpp"

#include <array>
#include <asio/buffer.hpp>
#include <asio/dispatch.hpp>
#include <asio/read.hpp>
#include <asio/read_until.hpp>
#include <asio/write.hpp>
#include <utility>
#include <variant>

#include "daemon/monitor/form_head.hpp"

namespace loopscope::daemon {
namespace {

using std::chrono::milliseconds;

/// A head is one packet, or a few; so is the body of a form.
constexpr milliseconds kRequestPatience{5'000};
/// Of a reader whose page is being made.
constexpr milliseconds kPagePatience{4'000};
/// Of who has sent a form, or asks for its page, which is made for him alone: a database that is
/// slow to answer shall say what it did.
constexpr milliseconds kFormPatience{20'000};
/// A page of megabytes over a slow line; it holds nothing but a place in the table.
constexpr milliseconds kAnswerPatience{60'000};
/// For what the client still sends after its answer.
constexpr milliseconds kFinishingPatience{250};
constexpr std::size_t kMostDiscarded = std::size_t{64} * 1024;
/// In the kernel of an answer that is not taken; without a limit it holds megabytes for each
/// client.
constexpr int kSendBufferBytes = 128 * 1024;
/// Of an answer at a time, so that a large one does not hold up the others.
constexpr std::size_t kSlice = std::size_t{64} * 1024;

constexpr int kMisdirected = 421;
constexpr int kHeadTooLong = 431;

HttpAnswer not_yet() {
  HttpAnswer answer{503, "the page is still being made: a browser asks again by itself\n"};
  answer.headers.emplace("Retry-After", "2");
  answer.headers.emplace("Refresh", "2");  // browsers look at this one
  return answer;
}

/// Of what a browser must not ask for again by itself: each request is work for the database.
HttpAnswer too_long() {
  return {503, "this takes too long: the database is slow to answer\nHINT: load the page again\n"};
}

HttpAnswer not_known() {
  return {503,
          "this takes too long: whether it was done is not known\n"
          "HINT: go back and load the page again: it says what holds\n"};
}

}  // namespace

HttpConnection::HttpConnection(const std::shared_ptr<asio::io_context>& io,
                               asio::ip::tcp::socket socket, const HttpSite& site)
    : io_(io), socket_(std::move(socket)), deadline_(*io), site_(site) {
  std::error_code gone;  // a client that has gone already comes from nowhere, and is soon closed
  from_ = socket_.remote_endpoint(gone).address();
  socket_.set_option(asio::socket_base::send_buffer_size(kSendBufferBytes), gone);
}

std::optional<HttpConnection::Clock::time_point> HttpConnection::idle_since() const {
  return phase_ == Phase::waiting ? std::nullopt : std::optional(moved_at_);
}

void HttpConnection::enter(Phase phase, Clock::duration patience) {
  phase_ = phase;
  *waits_ = phase == Phase::waiting;
  moved_at_ = Clock::now();
  deadline_.expires_after(patience);
  deadline_.async_wait([self = shared_from_this()](const std::error_code& error) {
    // The deadline may have been moved while this call was on its way.
    if (!error && self->deadline_.expiry() <= Clock::now()) self->on_deadline();
  });
}

void HttpConnection::on_deadline() {
  if (phase_ != Phase::waiting) return close();
  const bool form = request_.method == "POST";
  HttpAnswer answer = form ? not_known() : is_of_form_ ? too_long() : not_yet();
  write(std::make_shared<const HttpAnswer>(std::move(answer)));
}

void HttpConnection::close() {
  if (!is_open()) return;
  phase_ = Phase::closed;
  *waits_ = false;
  deadline_.cancel();
  std::error_code ignored;
  socket_.close(ignored);
}

void HttpConnection::hurry() {
  if (phase_ != Phase::writing && phase_ != Phase::finishing) return close();
  enter(phase_, kFinishingPatience);
}

void HttpConnection::start() {
  enter(Phase::reading, kRequestPatience);
  asio::async_read_until(
      socket_, asio::dynamic_buffer(received_, kMostHeadBytes), "\r\n\r\n",
      [self = shared_from_this()](const std::error_code& error, std::size_t bytes) {
        if (self->phase_ == Phase::reading) self->on_head(error, bytes);
      });
}

void HttpConnection::on_head(const std::error_code& error, std::size_t bytes) {
  if (error == asio::error::not_found) {
    const bool no_line = received_.find('\n') == std::string::npos;
    return refuse(no_line ? kTargetTooLong : kHeadTooLong, "the request is too long\n");
  }
  if (error) return close();
  auto parsed = parse_request(std::string_view(received_).substr(0, bytes));
  if (const auto* status = std::get_if<HttpRefusal>(&parsed))
    return refuse(*status, "this is not a request that can be answered\n");
  request_ = std::get<HttpRequest>(std::move(parsed));
  request_.from = from_.to_string();
  received_.erase(0, bytes);
  ask();
}

void HttpConnection::ask() {
  if (request_.host && !site_.names.contain(*request_.host)) {
    return refuse(kMisdirected,
                  "nobody here is called what the header Host says\n"
                  "HINT: ask by address, or add the name to /daemon/http_names\n");
  }
  if (auto refusal = site_.routes.refusal(request_))
    return write(std::make_shared<const HttpAnswer>(*std::move(refusal)));
  if (site_.routes.takes_form(request_)) return read_form();
  is_of_form_ = site_.routes.is_of_form(request_);
  answer(is_of_form_ ? kFormPatience : kPagePatience);
}

void HttpConnection::read_form() {
  auto head = read_form_head(request_);
  if (auto* refusal = std::get_if<HttpAnswer>(&head))
    return write(std::make_shared<const HttpAnswer>(std::move(*refusal)));
  form_bytes_ = std::get<FormHead>(head).bytes;
  enter(Phase::reading, kRequestPatience);
  const bool has_begun = !received_.empty();
  std::get<FormHead>(head).asks_to_go_on && !has_begun ? go_on() : read_rest();
}

void HttpConnection::go_on() {
  static constexpr std::string_view kGoOn = "HTTP/1.1 100 Continue\r\n\r\n";
  asio::async_write(socket_, asio::buffer(kGoOn),
                    [self = shared_from_this()](const std::error_code& error, std::size_t) {
                      if (self->phase_ != Phase::reading) return;
                      error ? self->close() : self->read_rest();
                    });
}

/// What stands behind the announced length is left: nothing is answered twice.
void HttpConnection::read_rest() {
  const std::size_t so_far = received_.size();
  if (so_far >= form_bytes_) {
    request_.body = received_.substr(0, form_bytes_);
    return answer(kFormPatience);
  }
  received_.resize(form_bytes_);
  asio::async_read(socket_, asio::buffer(received_.data() + so_far, form_bytes_ - so_far),
                   [self = shared_from_this()](const std::error_code& error, std::size_t) {
                     if (self->phase_ != Phase::reading) return;
                     error ? self->close() : self->read_rest();
                   });
}

void HttpConnection::answer(Clock::duration patience) {
  enter(Phase::waiting, patience);
  site_.routes.answer(request_, reply());
}

HttpReply HttpConnection::reply() {
  auto send = [io = io_.lock(), weak = weak_from_this()](std::shared_ptr<const HttpAnswer> answer) {
    asio::dispatch(*io, [weak, answer = std::move(answer)] {
      const auto self = weak.lock();
      if (self && self->phase_ == Phase::waiting) self->write(answer);
    });
  };
  return {std::move(send), waits_};
}

void HttpConnection::refuse(int status, const std::string& words) {
  write(std::make_shared<const HttpAnswer>(HttpAnswer{status, words}));
}

void HttpConnection::write(std::shared_ptr<const HttpAnswer> answer) {
  message_ = make_message(std::move(answer), request_);
  enter(Phase::writing, kAnswerPatience);
  const std::array<asio::const_buffer, 2> buffers = {asio::buffer(message_.head),
                                                     asio::buffer(*message_.body)};
  const auto self = shared_from_this();
  asio::async_write(
      socket_, buffers,
      [self](const std::error_code& error, std::size_t) {
        self->moved_at_ = Clock::now();
        return error ? 0 : kSlice;
      },
      [self](const std::error_code& error, std::size_t) {
        self->message_ = {};
        if (self->phase_ != Phase::writing) return;
        error ? self->close() : self->finish();
      });
}

/// Closing at once would reset the connection of a client that still sends, and it might lose the
/// answer.
void HttpConnection::finish() {
  enter(Phase::finishing, kFinishingPatience);
  std::error_code ignored;
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  received_.assign(std::size_t{4} * 1024, '\0');
  discard(0);
}

void HttpConnection::discard(std::size_t so_far) {
  socket_.async_read_some(
      asio::buffer(received_),
      [self = shared_from_this(), so_far](const std::error_code& error, std::size_t bytes) {
        if (self->phase_ != Phase::finishing) return;
        const std::size_t all = so_far + bytes;
        error || all > kMostDiscarded ? self->close() : self->discard(all);
      });
}

}  // namespace loopscope::daemon
