#include "core/plant/common_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/plant/following.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

/// The first loop follows itself without a rest; it weighs as much as one that follows well.
constexpr double kLeastRest = 0.01;

}  // namespace

void CommonCourse::Sum::add(std::complex<double> value, double by_weight) {
  if (!std::isfinite(value.real())) return;
  sum += by_weight * value;
  weight += by_weight;
  count += by_weight > 0.0 ? 1 : -1;
}

std::complex<double> CommonCourse::Sum::mean() const {
  if (count < 1) return {signal::kMissing, signal::kMissing};
  return sum / weight;
}

CommonCourse::CommonCourse(std::span<const Envelope> envelopes, std::span<const std::size_t> core)
    : envelopes_(envelopes) {
  const Envelope& first = envelopes[core.front()];
  for (const std::size_t index : core) {
    const Following found = plant::follow(envelopes[index], first);
    if (!(found.followed > 0.0)) continue;
    Envelope aligned = envelopes[index];
    for (auto& z : aligned.points) z = std::complex<float>(std::complex<double>(z) / found.gain);
    core_.push_back(
        {index, std::move(aligned), 1.0 / std::max(found.rest / found.followed, kLeastRest)});
  }
  add_up();
}

void CommonCourse::add_up() {
  if (core_.empty()) return;
  std::int64_t to = std::numeric_limits<std::int64_t>::min();
  first_ = std::numeric_limits<std::int64_t>::max();
  for (const Aligned& one : core_) {
    first_ = std::min(first_, one.envelope.first);
    to = std::max(to, one.envelope.end());
  }
  sums_.resize(static_cast<std::size_t>(std::max<std::int64_t>(0, to - first_)));
  for (const Aligned& one : core_)
    for (std::int64_t j = one.envelope.first; j < one.envelope.end(); ++j)
      sums_[static_cast<std::size_t>(j - first_)].add(one.envelope.at(j), one.weight);
  whole_ = course_without(nullptr);
  increments_ = measure_increments(whole_);
}

Envelope CommonCourse::course_without(const Aligned* left_out) const {
  Envelope course;
  if (core_.empty()) return course;
  course.frequency_hz = core_.front().envelope.frequency_hz;
  course.first = first_;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    Sum sum = sums_[k];
    if (left_out != nullptr)
      sum.add(left_out->envelope.at(first_ + static_cast<std::int64_t>(k)), -left_out->weight);
    course.points.emplace_back(sum.mean());
  }
  return course;
}

double CommonCourse::frequency_hz() const {
  std::complex<double> turn = 0.0;
  for (std::size_t j = 1; j < whole_.points.size(); ++j) {
    const std::complex<double> step = std::complex<double>(whole_.points[j]) *
                                      std::conj(std::complex<double>(whole_.points[j - 1]));
    if (std::isfinite(step.real())) turn += step;
  }
  return whole_.frequency_hz + std::arg(turn) / (2.0 * std::numbers::pi * whole_.step_s());
}

Follower CommonCourse::follow(std::size_t index, bool own_line) const {
  const Envelope& envelope = envelopes_[index];
  // Of the course of all: without the clearest loop it is noisy, and noise hides what follows it.
  const Following of_all = plant::follow(envelope, whole_);
  const auto own = std::ranges::find(core_, index, &Aligned::index);
  const bool in_core = own != core_.end();
  const Envelope others = in_core ? course_without(&*own) : Envelope{};
  const auto p = [&] {
    if (!own_line) return in_core ? plant::follow(envelope, others).p : of_all.p;
    const Increments own_steps = measure_increments(envelope);
    if (in_core) return compare(measure_increments(others), own_steps).p;
    return compare(increments_, own_steps).p;
  }();
  // An envelope is half the amplitude: a cosine of variance 1/2 has |z|^2 = 1/4.
  return {index, p, 2.0 * of_all.followed};
}

}  // namespace loopscope::core::plant
