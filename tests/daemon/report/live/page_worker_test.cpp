#include "daemon/report/live/page_worker.hpp"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/daemon/monitor/gunzip.hpp"
#include "tests/daemon/monitor/reply_slot.hpp"

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

PageWorker::Make saying(std::string words) {
  return [words](const std::stop_token&) { return HttpAnswer{200, words}; };
}

HttpAnswer answer(PageWorker& worker, const std::string& key, const PageWorker::Make& make) {
  ReplySlot slot;
  worker.answer(key, make, slot.reply());
  return slot.get();
}

/// A page that is begun, and ready once the gate is open.
class SlowPage {
 public:
  PageWorker::Make make() {
    return [this](const std::stop_token&) {
      begun_.set_value();
      open_.get_future().wait();
      return HttpAnswer{200, "at last"};
    };
  }
  void await_begin() { begun_.get_future().wait(); }
  void open() { open_.set_value(); }

 private:
  std::promise<void> begun_;
  std::promise<void> open_;
};

TEST(PageWorker, MakesAPageOnceAndHandsItOutAgain) {
  PageWorker worker;
  std::atomic<int> made = 0;
  const auto make = [&](const std::stop_token&) {
    ++made;
    return HttpAnswer{200, "page"};
  };
  EXPECT_EQ(answer(worker, "/", make).body, "page");
  EXPECT_EQ(answer(worker, "/", make).body, "page");
  EXPECT_EQ(made, 1);
  EXPECT_EQ(answer(worker, "/other", saying("other")).body, "other");
}

TEST(PageWorker, ForgottenPagesAreMadeAnewAlsoWhereOneIsOnItsWay) {
  PageWorker worker;
  EXPECT_EQ(answer(worker, "/", saying("before")).body, "before");
  worker.forget_pages();
  EXPECT_EQ(answer(worker, "/", saying("after")).body, "after");
  SlowPage slow;
  ReplySlot early, late;
  worker.answer("/slow", slow.make(), early.reply());
  slow.await_begin();
  worker.forget_pages();
  worker.answer("/slow", saying("begun after it"), late.reply());
  slow.open();
  EXPECT_EQ(early.get().body, "at last");
  EXPECT_EQ(late.get().body, "begun after it");
}

TEST(PageWorker, OneThatIsNoLongerFreshIsMadeAnew) {
  PageWorker worker({.freshness = 0s});
  EXPECT_EQ(answer(worker, "/", saying("old")).body, "old");
  EXPECT_EQ(answer(worker, "/", saying("new")).body, "new");
}

TEST(PageWorker, CompressesOnceForAllReaders) {
  PageWorker worker;
  const std::string page(100'000, 'x');
  ReplySlot first, second;
  worker.answer("/", saying(page), first.reply());
  worker.answer("/", saying(page), second.reply());
  EXPECT_EQ(gunzip(first.get().gzipped), page);
  EXPECT_EQ(gunzip(second.get().gzipped), page);
}

TEST(PageWorker, AllWhoWaitForAPageGetItAtOnceAndOthersAfterIt) {
  PageWorker worker;
  SlowPage slow;
  ReplySlot first, other, second;
  worker.answer("slow", slow.make(), first.reply());
  slow.await_begin();
  worker.answer("other", saying("other"), other.reply());
  worker.answer("slow", saying("never"), second.reply());
  EXPECT_FALSE(first.answered_within(10ms) || other.answered_within(10ms));
  slow.open();
  EXPECT_EQ(first.get().body, "at last");
  EXPECT_EQ(second.get().body, "at last");
  EXPECT_EQ(other.get().body, "other");
}

TEST(PageWorker, PageWhoseReaderHasLeftIsFinishedIfBegunAndElseLeftOut) {
  PageWorker worker;
  SlowPage slow;
  ReplySlot first, second;
  worker.answer("slow", slow.make(), first.reply());
  slow.await_begin();
  std::atomic<bool> made = false;
  worker.answer(
      "unwanted",
      [&](const std::stop_token&) {
        made = true;
        return HttpAnswer{};
      },
      second.reply());
  first.leave();
  second.leave();
  slow.open();
  EXPECT_EQ(answer(worker, "slow", saying("again")).body, "at last");
  EXPECT_EQ(answer(worker, "other", saying("other")).body, "other");
  EXPECT_FALSE(made);
}

TEST(PageWorker, HoldsAFewReadersOnly) {
  PageWorker worker({.most_waiting = 1});
  SlowPage slow;
  ReplySlot first;
  worker.answer("slow", slow.make(), first.reply());
  slow.await_begin();
  const HttpAnswer refusal = answer(worker, "slow", saying("never"));  // at once
  EXPECT_EQ(refusal.status, 503);
  EXPECT_EQ(refusal.headers.count("Retry-After"), 1U);
  first.leave();
  ReplySlot second;
  worker.answer("slow", saying("never"), second.reply());
  slow.open();
  EXPECT_EQ(second.get().body, "at last");
}

TEST(PageWorker, AFailureIsAnAnswerWithoutItsWords) {
  PageWorker worker;
  const HttpAnswer failure = answer(worker, "/", [](const std::stop_token&) -> HttpAnswer {
    throw std::runtime_error("secret");
  });
  EXPECT_EQ(failure.status, 500);
  EXPECT_EQ(failure.body.find("secret"), std::string::npos);
  EXPECT_EQ(answer(worker, "/b", saying("well")).body, "well");
}

TEST(PageWorker, HasSomethingToDoWhileNobodyWaits) {
  std::atomic<int> times = 0;
  PageWorker worker({.pause = 1ms}, [&times] { ++times; });
  while (times < 3) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(answer(worker, "/", saying("well")).body, "well");
}

TEST(PageWorker, DoesItAlsoWhereReadersComeWithoutAPause) {
  std::atomic<int> times = 0;
  PageWorker worker({.freshness = 1ms}, [&times] { ++times; });  // the pause is a second
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; times < 2 && k < 1000; ++k) {
    static_cast<void>(answer(worker, std::to_string(k), saying("well")));
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(times, 2);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 900ms);
}

TEST(PageWorker, TellsWhatIsBeingMadeToStop) {
  std::atomic<bool> stopped = false;
  ReplySlot slot;
  {
    std::promise<void> begun;
    PageWorker worker;
    worker.answer(
        "slow",
        [&](const std::stop_token& stop) {
          begun.set_value();
          while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
          stopped = true;
          return HttpAnswer{};
        },
        slot.reply());
    begun.get_future().wait();
  }
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace loopscope::daemon
