#include "daemon/service/observe/work_report.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <utility>

#include "core/text/counted.hpp"
#include "daemon/service/observe/stage_timings.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::chrono::minutes kSayEvery{1};

}  // namespace

void add(storage::WriteCount& sum, const storage::WriteCount& more) {
  sum.inserted += more.inserted;
  sum.revised += more.revised;
  sum.unchanged += more.unchanged;
  sum.failed += more.failed;
  sum.fenced_off += more.fenced_off;
  sum.not_judged += more.not_judged;
  sum.revised_earlier += more.revised_earlier;
}

std::string count_text(const storage::WriteCount& count) {
  const std::size_t all =
      count.inserted + count.revised + count.unchanged + count.failed + count.fenced_off;
  std::string text = fmt::format("{}: {} new, {} revised, {} unchanged, {} failed",
                                 core::text::counted(all, "loop", "loops"), count.inserted,
                                 count.revised, count.unchanged, count.failed);
  if (count.not_judged > 0) {
    text += fmt::format(", {} could not be judged (loopscope.data_problem)", count.not_judged);
  }
  if (count.revised_earlier > 0) {
    text += ", " + core::text::counted(count.revised_earlier, "earlier window", "earlier windows") +
            " revised";
  }
  if (count.fenced_off > 0) text += fmt::format(", {} taken over by others", count.fenced_off);
  return text;
}

void WorkReport::add(const storage::WriteCount& count, const storage::StageCost& cost) {
  daemon::add(count_, count);
  cost_ = cost;
  if (Clock::now() - said_at_ >= kSayEvery) say();
}

void WorkReport::say() {
  said_at_ = Clock::now();
  const storage::StageCost since = difference(cost_, told_);
  // Of loops that were all put off the log knows already why.
  const storage::WriteCount& c = count_;
  if (c.inserted + c.revised + c.unchanged + c.fenced_off == 0) return;
  spdlog::info("{}; {}", count_text(std::exchange(count_, {})), cost_text(since));
  told_ = cost_;
}

}  // namespace loopscope::daemon
