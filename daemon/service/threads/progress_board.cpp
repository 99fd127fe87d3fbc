#include "daemon/service/threads/progress_board.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace loopscope::daemon {

void ProgressBoard::Entry::hold(const std::vector<storage::ClaimedLoop>& claims) {
  const std::lock_guard lock(board_.mutex_);
  claims_ = claims;
  lost_.clear();
  last_step_ = Clock::now();
}

void ProgressBoard::Entry::drop() {
  const std::lock_guard lock(board_.mutex_);
  claims_.clear();
  lost_.clear();
}

void ProgressBoard::Entry::done(std::span<const std::int64_t> loop_ids) {
  const std::lock_guard lock(board_.mutex_);
  std::erase_if(claims_, [&](const storage::ClaimedLoop& claim) {
    return std::ranges::find(loop_ids, claim.loop.loop_id) != loop_ids.end();
  });
}

std::vector<storage::ClaimedLoop> ProgressBoard::Entry::held() {
  const std::lock_guard lock(board_.mutex_);
  std::vector<storage::ClaimedLoop> held;
  std::ranges::copy_if(claims_, std::back_inserter(held),
                       [this](const auto& claim) { return !lost_.contains(claim.loop.loop_id); });
  return held;
}

void ProgressBoard::Entry::step() {
  const std::lock_guard lock(board_.mutex_);
  last_step_ = Clock::now();
}

bool ProgressBoard::Entry::lost(std::int64_t loop_id) {
  const std::lock_guard lock(board_.mutex_);
  return lost_.contains(loop_id);
}

void ProgressBoard::Entry::wait(bool waiting) {
  const std::lock_guard lock(board_.mutex_);
  waiting_ = waiting;
  last_step_ = Clock::now();
}

ProgressBoard::Entry& ProgressBoard::entry() {
  const std::lock_guard lock(mutex_);
  return entries_.emplace_back(*this);
}

std::vector<storage::ClaimedLoop> ProgressBoard::proven_claims() {
  const std::lock_guard lock(mutex_);
  const auto got_on = [this](const Entry& progress) { return progress.last_step_ > renewed_; };
  const bool any = std::ranges::any_of(entries_, [&](const Entry& progress) {
    return got_on(progress) && !progress.waiting_ && !progress.claims_.empty();
  });
  std::vector<storage::ClaimedLoop> proven;
  for (const Entry& progress : entries_) {
    if (!got_on(progress) && !(progress.waiting_ && any)) continue;
    std::ranges::copy_if(progress.claims_, std::back_inserter(proven), [&](const auto& claim) {
      return !progress.lost_.contains(claim.loop.loop_id);
    });
  }
  return proven;
}

void ProgressBoard::renewed(Clock::time_point seen) {
  const std::lock_guard lock(mutex_);
  renewed_ = std::max(renewed_, seen);
}

std::size_t ProgressBoard::lose(std::span<const storage::ClaimKey> claims) {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (Entry& progress : entries_) {
    for (const storage::ClaimedLoop& claim : progress.claims_) {
      const storage::ClaimKey key{claim.loop.loop_id, claim.fence};
      if (std::ranges::find(claims, key) == claims.end()) continue;
      if (progress.lost_.insert(key.loop_id).second) ++count;
    }
  }
  return count;
}

std::size_t ProgressBoard::held_loops() {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const Entry& progress : entries_) count += progress.claims_.size();
  return count;
}

std::optional<std::string> ProgressBoard::standstill(Clock::duration limit, Clock::time_point now) {
  const Clock::duration silence = longest_silence(now);
  if (silence <= limit) return std::nullopt;
  return fmt::format("a batch of loops has made no progress for {:.0f} s",
                     std::chrono::duration<double>(silence).count());
}

ProgressBoard::Clock::duration ProgressBoard::longest_silence(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  Clock::duration longest{0};
  for (const Entry& progress : entries_) {
    if (!progress.claims_.empty() && !progress.waiting_)
      longest = std::max(longest, now - progress.last_step_);
  }
  return longest;
}

}  // namespace loopscope::daemon
