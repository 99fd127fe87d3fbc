#include "daemon/report/page_worker.hpp"

#include <csignal>
#include <exception>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <utility>

#include "daemon/report/thread_priority.hpp"

namespace loopscope::daemon {
namespace {

/// Pages of a few hundred kilobytes each.
constexpr std::size_t kMostPages = 16;

HttpAnswer later(const std::string& words) {
  HttpAnswer answer{503, words};
  answer.headers.emplace("Retry-After", "2");
  return answer;
}

HttpAnswer made(const PageWorker::Make& make, const std::string& key, const std::stop_token& stop) {
  try {
    return make(stop);
  } catch (const std::exception& error) {
    spdlog::error("page {}: {}", key, error.what());
    return {500, "this failed: the log says why\n"};
  }
}

}  // namespace

PageWorker::PageWorker(Limits limits) : limits_(limits) {
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

void PageWorker::keep(const std::string& key, HttpAnswer answer) {
  std::erase_if(pages_, [&](const auto& page) {
    return Clock::now() - page.second.made_at > limits_.freshness;
  });
  if (pages_.size() >= kMostPages) pages_.clear();
  pages_[key] = {std::move(answer), Clock::now()};
}

HttpAnswer PageWorker::answer(const std::string& key, const Make& make) {
  const Clock::time_point deadline = Clock::now() + limits_.patience;
  std::unique_lock lock(mutex_);
  if (const Page* page = at_hand(key)) return page->answer;
  if (waiting_ >= limits_.most_waiting) return later("others are reading: try again\n");
  ++waiting_;
  const auto ready = [&] { return !job_ || at_hand(key) != nullptr; };
  while (at_hand(key) == nullptr) {
    if (!job_) {
      job_ = Job{key, make};
      changed_.notify_all();
    }
    if (!changed_.wait_until(lock, deadline, ready)) break;
  }
  --waiting_;
  if (const Page* page = at_hand(key)) return page->answer;
  return later("the page is being made: try again\n");
}

void PageWorker::run(const std::stop_token& stop) {
  yield_to_analysis();
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return job_.has_value(); })) {
    const Job job = *job_;
    lock.unlock();
    HttpAnswer answer = made(job.make, job.key, stop);
    lock.lock();
    keep(job.key, std::move(answer));
    job_.reset();
    changed_.notify_all();
  }
}

}  // namespace loopscope::daemon
