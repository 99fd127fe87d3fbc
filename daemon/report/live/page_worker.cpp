#include "daemon/report/live/page_worker.hpp"

#include <csignal>
#include <exception>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <utility>

#include "daemon/service/threads/core_gate.hpp"

namespace loopscope::daemon {
namespace {

/// Pages of a few hundred kilobytes each.
constexpr std::size_t kMostPages = 16;

HttpAnswer later() {
  HttpAnswer answer{503, "others are reading: try again\n"};
  answer.headers.emplace("Retry-After", "2");
  return answer;
}

HttpAnswer made(const PageWorker::Make& make, const std::string& key, const std::stop_token& stop) {
  try {
    HttpAnswer answer = make(stop);
    add_gzipped(answer);
    return answer;
  } catch (const std::exception& error) {
    spdlog::error("page {}: {}", key, error.what());
    return HttpAnswer{500, "this failed: the log says why\n"};
  }
}

}  // namespace

PageWorker::PageWorker(Limits limits, std::function<void()> between)
    : limits_(limits), between_(std::move(between)) {
  // Signals are the main thread's.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

const PageWorker::Page* PageWorker::at_hand(const std::string& key) const {
  const auto found = pages_.find(key);
  if (found == pages_.end() || Clock::now() - found->second.made_at > limits_.freshness)
    return nullptr;
  return &found->second;
}

void PageWorker::forget_readers_that_left() {
  std::erase_if(waiting_, [](const Reader& reader) { return !reader.reply.wanted(); });
}

void PageWorker::answer(const std::string& key, const Make& make, const HttpReply& reply) {
  const std::lock_guard lock(mutex_);
  if (const Page* page = at_hand(key)) return reply.send(page->answer);
  if (waiting_.size() >= limits_.most_waiting) forget_readers_that_left();
  if (waiting_.size() >= limits_.most_waiting) return reply.send(later());
  waiting_.push_back({key, make, reply, edition_});
  changed_.notify_one();
}

void PageWorker::forget_pages() {
  const std::lock_guard lock(mutex_);
  pages_.clear();
  ++edition_;
}

void PageWorker::keep(const std::string& key, Answer answer) {
  std::erase_if(pages_, [&](const auto& page) {
    return Clock::now() - page.second.made_at > limits_.freshness;
  });
  if (pages_.size() >= kMostPages) pages_.clear();
  pages_[key] = {std::move(answer), Clock::now()};
}

void PageWorker::hand_out(const std::string& key, const Answer& answer, std::uint64_t edition) {
  std::erase_if(waiting_, [&](const Reader& reader) {
    if (reader.key != key || reader.edition > edition) return false;
    reader.reply.send(answer);
    return true;
  });
}

void PageWorker::make_next(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  forget_readers_that_left();
  if (waiting_.empty()) return;
  const std::string key = waiting_.front().key;
  const Make make = waiting_.front().make;
  const std::uint64_t edition = edition_;
  lock.unlock();
  const auto answer = std::make_shared<const HttpAnswer>(made(make, key, stop));
  lock.lock();
  if (edition == edition_) keep(key, answer);
  hand_out(key, answer, edition);
}

void PageWorker::run(const std::stop_token& stop) {
  yield_to_analysis();
  std::unique_lock lock(mutex_);
  Clock::time_point between_at = Clock::now();
  while (!stop.stop_requested()) {
    const bool somebody_waits =
        changed_.wait_for(lock, stop, limits_.pause, [this] { return !waiting_.empty(); });
    if (somebody_waits) make_next(lock, stop);
    // Also where readers come without a pause, as a display on a wall does.
    const bool is_due = Clock::now() - between_at >= limits_.freshness;
    if (!between_ || stop.stop_requested() || (somebody_waits && !is_due)) continue;
    lock.unlock();
    between_();
    lock.lock();
    between_at = Clock::now();
  }
}

}  // namespace loopscope::daemon
