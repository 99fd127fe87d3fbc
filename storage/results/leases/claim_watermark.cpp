#include "storage/results/leases/claim_watermark.hpp"

#include <algorithm>

namespace loopscope::storage {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;
/// Statement time-outs and the imports of catalogues are shorter.
constexpr std::int64_t kNearest_us = 60 * kSecond_us;
/// Of two transactions of different connections the later one may come here first.
constexpr std::int64_t kOverlap_us = 2 * kSecond_us;
/// Dead entries are passed at some million a second: a slice of these times holds thousands of
/// them, and is not felt beside the rest of a look.
constexpr double kQuick_s = 0.004;
constexpr double kSlow_s = 0.008;
/// From a minute to the beginning of time in sixteen slices where nothing is dead.
constexpr std::int64_t kGrowth = 4;

}  // namespace

ClaimWatermark::Start ClaimWatermark::start(std::int64_t now_us) {
  const std::lock_guard lock(mutex_);
  if (!place_ || place_->due_us > now_us + kOverlap_us) {
    place_ = behind(now_us);
    looked_down_to_us_.reset();
    ++lowered_;
  }
  return {*place_, lowered_};
}

void ClaimWatermark::passed(const Start& start, DuePlace last) {
  const std::lock_guard lock(mutex_);
  if (start.lowered == lowered_) place_ = std::max(*place_, last);
}

void ClaimWatermark::lower(DuePlace found) {
  const std::lock_guard lock(mutex_);
  if (!place_ || found > *place_) return;
  place_ = DuePlace{found.due_us, found.loop_id - 1};
  ++lowered_;
}

std::optional<DuePlace> ClaimWatermark::place() const {
  const std::lock_guard lock(mutex_);
  return place_;
}

void ClaimWatermark::raise_to(std::optional<DuePlace> place) {
  const std::lock_guard lock(mutex_);
  if (place && (!place_ || *place_ < *place)) place_ = place;
}

ClaimWatermark::Slice ClaimWatermark::nearest() const {
  const DuePlace to = place().value_or(kBeforeAll);
  return {std::max(to.due_us - kNearest_us, kBeforeAll.due_us), to};
}

void ClaimWatermark::looked_nearest(const Slice& nearest) {
  const std::lock_guard lock(mutex_);
  if (!looked_down_to_us_) looked_down_to_us_ = nearest.from_us;
}

ClaimWatermark::Slice ClaimWatermark::next() const {
  const std::lock_guard lock(mutex_);
  const DuePlace to =
      behind(looked_down_to_us_.value_or(place_.value_or(kBeforeAll).due_us - kNearest_us));
  return {std::max(to.due_us - width_us_.value_or(kNearest_us), kBeforeAll.due_us), to};
}

bool ClaimWatermark::looked(const Slice& slice, double seconds) {
  const std::lock_guard lock(mutex_);
  if (slice.from_us <= kBeforeAll.due_us) {
    looked_down_to_us_.reset();
    width_us_.reset();
    return true;
  }
  looked_down_to_us_ = slice.from_us;
  const std::int64_t width_us = width_us_.value_or(kNearest_us);
  if (seconds < kQuick_s) width_us_ = std::min(width_us * kGrowth, -kBeforeAll.due_us);
  if (seconds > kSlow_s) width_us_ = std::max(width_us / kGrowth, kSecond_us);
  return false;
}

ClaimWatermark& ClaimWatermarks::of(const std::vector<std::string>& but_of) {
  if (but_of.empty()) return all_;
  const std::lock_guard lock(mutex_);
  ClaimWatermark& watermark = elsewhere_[but_of];
  watermark.raise_to(all_.place());
  return watermark;
}

}  // namespace loopscope::storage
