#include "core/plant/common_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/plant/following.hpp"
#include "core/plant/in_step.hpp"

namespace loopscope::core::plant {
namespace {

/// The first loop follows itself without a rest; it weighs as much as one that follows well.
constexpr double kLeastRest = 0.01;

}  // namespace

CommonCourse::CommonCourse(std::span<const Envelope> envelopes, std::span<const std::size_t> core)
    : envelopes_(envelopes) {
  const Envelope& first = envelopes[core.front()];
  for (const std::size_t index : core) {
    const Following found = plant::follow(envelopes[index], first);
    if (!(found.followed > 0.0)) continue;
    Envelope aligned = envelopes[index];
    for (std::complex<double>& z : aligned.points) z /= found.gain;
    core_.push_back(
        {index, std::move(aligned), 1.0 / std::max(found.rest / found.followed, kLeastRest)});
  }
  whole_ = course_of_others(std::nullopt);
}

Envelope CommonCourse::course_of_others(std::optional<std::size_t> index) const {
  Envelope course;
  if (core_.empty()) return course;
  course.frequency_hz = core_.front().envelope.frequency_hz;
  std::int64_t from = std::numeric_limits<std::int64_t>::max();
  std::int64_t to = std::numeric_limits<std::int64_t>::min();
  for (const Aligned& one : core_) {
    if (one.index == index) continue;
    from = std::min(from, one.envelope.first);
    to = std::max(to, one.envelope.end());
  }
  course.first = from;
  for (std::int64_t j = from; j < to; ++j) {
    std::complex<double> sum = 0.0;
    double weight = 0.0;
    for (const Aligned& one : core_) {
      const std::complex<double> z = one.envelope.at(j);
      if (one.index == index || !std::isfinite(z.real())) continue;
      sum += one.weight * z;
      weight += one.weight;
    }
    course.points.push_back(sum / weight);
  }
  return course;
}

double CommonCourse::frequency_hz() const {
  std::complex<double> turn = 0.0;
  for (std::size_t j = 1; j < whole_.points.size(); ++j) {
    const std::complex<double> step = whole_.points[j] * std::conj(whole_.points[j - 1]);
    if (std::isfinite(step.real())) turn += step;
  }
  return whole_.frequency_hz + std::arg(turn) / (2.0 * std::numbers::pi * whole_.step_s());
}

Follower CommonCourse::follow(std::size_t index, bool own_line) const {
  const bool in_core = std::ranges::count(core_, index, &Aligned::index) > 0;
  const Envelope others = in_core ? course_of_others(index) : Envelope{};
  const Envelope& course = in_core ? others : whole_;
  const double p = own_line ? compare(measure_wander(course), measure_wander(envelopes_[index])).p
                            : plant::follow(envelopes_[index], course).p;
  // Of the course of all: without the clearest loop it is noisy, and noise hides what follows it.
  // An envelope is half the amplitude: a cosine of variance 1/2 has |z|^2 = 1/4.
  return {index, p, 2.0 * plant::follow(envelopes_[index], whole_).followed};
}

}  // namespace loopscope::core::plant
