#include "daemon/report/live/live_pages.hpp"

#include <charconv>
#include <cstdint>
#include <exception>
#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "daemon/report/page/page_answer.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/loop_request.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

/// Which server, and what it said, is the log's to tell: a page may be read by many.
HttpAnswer away() {
  HttpAnswer answer = page_answer(503, page({"Loopscope", {"the results database does not answer"}},
                                            {render("results_away", {})}));
  answer.headers.emplace("Retry-After", "10");
  return answer;
}

template <typename Read>
HttpAnswer read_page(const Read& read) {
  try {
    LivePage page = read();
    return page_answer(page.found ? 200 : 404, std::move(page.html));
  } catch (const storage::DatabaseError&) {
    return away();
  }
}

std::string value_of(const HttpRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

/// 0 for what is none.
std::int64_t whole_number(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

}  // namespace

LivePages::LivePages(std::function<std::shared_ptr<const config::Settings>()> settings,
                     std::function<bool()> rests)
    : settings_(settings),
      rests_(std::move(rests)),
      worker_({}, [this] { keep_ready(); }),
      annotate_(std::move(settings), [this] { show_changes(); }) {}

void LivePages::keep_ready() {
  if (rests_()) return;
  try {
    reader().keep_ready();
  } catch (const std::exception&) {
    // Whoever asks for a page is told; a database that is away the log has from those who work.
  }
}

void LivePages::show_changes() {
  changed_ = true;
  worker_.forget_pages();
}

LiveReader& LivePages::reader() {
  const std::shared_ptr<const config::Settings> now_in_force = settings_();
  if (!reader_ || read_with_ != now_in_force) {
    read_with_ = now_in_force;
    reader_ = std::make_unique<LiveReader>(now_in_force);
  }
  if (changed_.exchange(false)) reader_->forget_plant();
  return *reader_;
}

void LivePages::add_to(HttpServer& server) {
  annotate_.add_to(server);
  server.handle_deferred("/", [this](const HttpRequest&, const HttpReply& reply) {
    worker_.answer(
        "/", [this](const std::stop_token&) { return read_page([&] { return reader().plant(); }); },
        reply);
  });
  server.handle_deferred("/oscillation",
                         [this](const HttpRequest& request, const HttpReply& reply) {
                           const std::int64_t number = whole_number(value_of(request, "number"));
                           const auto make = [this, number](const std::stop_token& stop) {
                             return read_page([&] { return reader().oscillation(number, stop); });
                           };
                           worker_.answer(fmt::format("/oscillation {}", number), make, reply);
                         });
  server.handle_deferred("/loops", [this](const HttpRequest& request, const HttpReply& reply) {
    const LoopQuery query = loop_query(request.query);
    const auto make = [this, query](const std::stop_token&) {
      return read_page([&] { return reader().loops(query); });
    };
    worker_.answer(loops_address(query), make, reply);
  });
  server.handle_deferred("/loop", [this](const HttpRequest& request, const HttpReply& reply) {
    const std::string name = value_of(request, "name");
    const auto make = [this, name](const std::stop_token& stop) {
      return read_page([&] { return reader().loop(name, stop); });
    };
    worker_.answer("/loop " + name, make, reply);
  });
}

}  // namespace loopscope::daemon
