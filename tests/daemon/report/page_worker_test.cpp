#include "daemon/report/page_worker.hpp"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

PageWorker::Limits quick() {
  return {.patience = 100ms, .freshness = 10s, .most_waiting = 2};
}

PageWorker::Make saying(std::string words) {
  return [words](const std::stop_token&) { return HttpAnswer{200, words}; };
}

/// Makes a page once the gate is open.
PageWorker::Make behind(std::shared_future<void> gate) {
  return [gate](const std::stop_token&) {
    gate.wait();
    return HttpAnswer{200, "at last"};
  };
}

TEST(PageWorker, MakesAPageOnceAndHandsItOutAgain) {
  PageWorker worker;
  std::atomic<int> made = 0;
  const auto make = [&](const std::stop_token&) {
    ++made;
    return HttpAnswer{200, "page"};
  };
  EXPECT_EQ(worker.answer("/", make).body, "page");
  EXPECT_EQ(worker.answer("/", make).body, "page");
  EXPECT_EQ(made, 1);
  EXPECT_EQ(worker.answer("/other", saying("other")).body, "other");
}

TEST(PageWorker, WhoComesWhileAnotherPageIsMadeIsToldToComeAgain) {
  std::promise<void> open;
  PageWorker worker(quick());
  const auto gate = open.get_future().share();
  const HttpAnswer slow = worker.answer("slow", behind(gate));
  EXPECT_EQ(slow.status, 503);
  EXPECT_EQ(slow.headers.count("Retry-After"), 1U);
  EXPECT_EQ(worker.answer("other", saying("other")).status, 503);
  open.set_value();
  // It was finished all the same.
  for (int k = 0; k < 100 && worker.answer("slow", saying("again")).status != 200; ++k) {
  }
  EXPECT_EQ(worker.answer("slow", saying("again")).body, "at last");
}

TEST(PageWorker, HoldsAFewReadersOnly) {
  std::promise<void> open;
  PageWorker worker({.patience = 30s, .freshness = 10s, .most_waiting = 1});
  const auto gate = open.get_future().share();
  std::promise<void> begun;
  auto first = std::async(std::launch::async, [&] {
    return worker.answer("slow", [&, gate](const std::stop_token&) {
      begun.set_value();
      gate.wait();
      return HttpAnswer{200, "at last"};
    });
  });
  begun.get_future().wait();
  EXPECT_EQ(worker.answer("slow", saying("never")).status, 503);  // at once
  open.set_value();
  EXPECT_EQ(first.get().body, "at last");
}

TEST(PageWorker, AFailureIsAnAnswerWithoutItsWords) {
  PageWorker worker;
  const HttpAnswer answer = worker.answer(
      "/", [](const std::stop_token&) -> HttpAnswer { throw std::runtime_error("secret"); });
  EXPECT_EQ(answer.status, 500);
  EXPECT_EQ(answer.body.find("secret"), std::string::npos);
  EXPECT_EQ(worker.answer("/b", saying("well")).body, "well");
}

TEST(PageWorker, TellsWhatIsBeingMadeToStop) {
  std::atomic<bool> stopped = false;
  {
    PageWorker worker(quick());
    EXPECT_EQ(worker
                  .answer("slow",
                          [&](const std::stop_token& stop) {
                            while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
                            stopped = true;
                            return HttpAnswer{};
                          })
                  .status,
              503);
  }
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace loopscope::daemon
