#include "daemon/report/annotate/form_queue.hpp"

#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/daemon/monitor/reply_slot.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A queue whose thread is held up until open().
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks): it loses sight of what the queue took over
class HeldQueue {
 public:
  HeldQueue() {
    queue.add({"first", true,
               [this] {
                 begun_.set_value();
                 gate_.get_future().wait();
                 return HttpAnswer{};
               },
               held_.reply()});
    begun_.get_future().wait();
  }
  void add(ReplySlot& slot, const std::string& user, bool writes) {
    queue.add({user, writes,
               [this, user, writes] {
                 order.push_back(user + (writes ? " writes" : " looks"));
                 return HttpAnswer{200, user};
               },
               slot.reply()});
  }
  void open() { gate_.set_value(); }

  std::vector<std::string> order;

 private:
  std::promise<void> begun_, gate_;
  ReplySlot held_;

 public:
  FormQueue queue;  // last: its thread ends first
};
// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks)

TEST(FormQueue, FormsComeBeforePages) {
  HeldQueue held;
  ReplySlot slots[4];
  held.add(slots[0], "anna", false);
  held.add(slots[1], "ben", false);
  held.add(slots[2], "anna", true);
  held.add(slots[3], "ben", true);
  held.open();
  for (ReplySlot& slot : slots) EXPECT_EQ(slot.get().status, 200);
  EXPECT_THAT(held.order, ElementsAre("anna writes", "ben writes", "anna looks", "ben looks"));
}

TEST(FormQueue, AUserHasTwoPlaces) {
  HeldQueue held;
  ReplySlot kept[2], page, form, other;
  for (ReplySlot& slot : kept) held.add(slot, "anna", false);
  held.add(page, "anna", false);
  held.add(form, "anna", true);
  held.add(other, "ben", true);
  const HttpAnswer refused = page.get();
  EXPECT_EQ(refused.status, 429);
  EXPECT_THAT(refused.body, Not(HasSubstr("Nothing was entered")));
  EXPECT_EQ(refused.headers.count("Refresh"), 0U);
  EXPECT_THAT(form.get().body, HasSubstr("Nothing was entered: "));
  held.open();
  EXPECT_EQ(other.get().status, 200);
}

TEST(FormQueue, PagesLeavePlacesToForms) {
  HeldQueue held;
  ReplySlot pages[FormQueue::kMostPagesWaiting], more, form;
  for (ReplySlot& slot : pages) held.add(slot, std::to_string(&slot - pages), false);
  held.add(more, "late", false);
  EXPECT_EQ(more.get().status, 503);
  held.add(form, "late", true);
  for (ReplySlot& slot : pages) slot.leave();
  held.open();
  EXPECT_EQ(form.get().status, 200);
  EXPECT_THAT(held.order, ElementsAre("late writes")) << "whose time is over is not served";
}

TEST(FormQueue, AFullOneSaysThatNothingWasEntered) {
  HeldQueue held;
  ReplySlot forms[FormQueue::kMostWaiting], more;
  for (ReplySlot& slot : forms) held.add(slot, std::to_string(&slot - forms), true);
  held.add(more, "late", true);
  const HttpAnswer refused = more.get();
  EXPECT_EQ(refused.status, 503);
  EXPECT_THAT(refused.body, HasSubstr("Nothing was entered: others are before you"));
  held.open();
}

TEST(FormQueue, WhatIsThrownIsAnAnswer) {
  FormQueue queue;
  ReplySlot slot;
  queue.add(
      {"anna", true, []() -> HttpAnswer { throw std::runtime_error("secret"); }, slot.reply()});
  const HttpAnswer answer = slot.get();
  EXPECT_EQ(answer.status, 500);
  EXPECT_THAT(answer.body, Not(HasSubstr("secret")));
}

}  // namespace
}  // namespace loopscope::daemon
