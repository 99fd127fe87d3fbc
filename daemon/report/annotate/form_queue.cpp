#include "daemon/report/annotate/form_queue.hpp"

#include <algorithm>
#include <csignal>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <utility>

#include "daemon/service/threads/core_gate.hpp"

namespace loopscope::daemon {
namespace {

HttpAnswer refusal(int status, const char* words, bool writes) {
  HttpAnswer answer{status, writes ? std::string("Nothing was entered: ") + words +
                                         "HINT: go back, where what you typed may still stand, and "
                                         "send it again\n"
                                   : words};
  answer.headers.emplace("Retry-After", "2");
  return answer;
}

HttpAnswer made(const std::function<HttpAnswer()>& make) {
  try {
    HttpAnswer answer = make();
    add_gzipped(answer);
    return answer;
  } catch (const std::exception& error) {
    spdlog::error("page {}: {}", "/annotate", error.what());
    return HttpAnswer{500, "this failed: the log says why\n"};
  }
}

}  // namespace

FormQueue::FormQueue() {
  // Signals are the main thread's.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void FormQueue::add(Request request) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const Request& one) { return !one.reply.wanted(); });
  const bool writes = request.writes;
  if (std::ranges::count(waiting_, request.user, &Request::user) >=
      static_cast<std::ptrdiff_t>(kMostOfUser))
    return request.reply.send(
        refusal(429, "others of your requests wait already: try again in a moment\n", writes));
  if (waiting_.size() >= (writes ? kMostWaiting : kMostPagesWaiting))
    return request.reply.send(
        refusal(503, "others are before you: try again in a moment\n", writes));
  waiting_.push_back(std::move(request));
  changed_.notify_one();
}

FormQueue::Request FormQueue::take_next() {
  auto next = std::ranges::find(waiting_, true, &Request::writes);
  if (next == waiting_.end()) next = waiting_.begin();
  Request request = std::move(*next);
  waiting_.erase(next);
  return request;
}

void FormQueue::run(const std::stop_token& stop) {
  yield_to_analysis();
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); }) &&
         !stop.stop_requested()) {
    const Request request = take_next();
    if (!request.reply.wanted()) continue;
    lock.unlock();
    request.reply.send(made(request.make));
    lock.lock();
  }
}

}  // namespace loopscope::daemon
