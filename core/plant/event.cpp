#include "core/plant/event.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/plant/common_gain.hpp"
#include "core/plant/false_discovery.hpp"

namespace loopscope::core::plant {
namespace {

/// Below this share of its variance a loop is touched by the oscillation at most.
constexpr double kLeastStrength = 0.05;

double variance(std::span<const double> series) {
  double count = 0.0, mean = 0.0, squares = 0.0;
  for (const double value : series) {
    if (!std::isfinite(value)) continue;
    count += 1.0;
    const double off = value - mean;
    mean += off / count;
    squares += off * (value - mean);
  }
  return count > 0.0 ? squares / count : 0.0;
}

bool of_period(const MemberLoop& loop, double frequency_hz) {
  return may_begin_event(loop.oscillation) &&
         std::abs(std::log(*loop.oscillation.period_s * frequency_hz)) <= 1.5 * kSamePeriod;
}

double middle_frequency(std::span<const MemberLoop> loops, std::span<const std::size_t> core) {
  std::vector<double> periods;
  for (const std::size_t i : core) periods.push_back(*loops[i].oscillation.period_s);
  std::ranges::nth_element(periods,
                           periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2));
  return 1.0 / periods[periods.size() / 2];
}

/// Upper estimate of the share of null tests (Storey 2002; the 1 makes the control hold for finite
/// families, Storey, Taylor and Siegmund 2004).
double null_share(std::span<const double> p) {
  constexpr double kMiddle = 0.5;
  const auto above = std::ranges::count_if(p, [](double value) { return value > kMiddle; });
  return std::min(1.0, (1.0 + static_cast<double>(above)) /
                           (kMiddle * static_cast<double>(std::max<std::size_t>(1, p.size()))));
}

/// Those of `asked` that follow the course, by false-discovery control among themselves: of the
/// loops of one period most belong to the event, and the control is told so.
std::vector<Follower> followers_of(const CommonCourse& course, std::span<const std::size_t> asked,
                                   double rate) {
  std::vector<Follower> all;
  std::vector<double> p;
  for (const std::size_t i : asked) {
    all.push_back(course.follow(i));
    p.push_back(all.back().p);
  }
  const std::vector<bool> follows =
      control_false_discovery(p, std::min(1.0, rate / null_share(p))).flagged;
  std::vector<Follower> found;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (follows[k] && all[k].strength >= kLeastStrength) found.push_back(all[k]);
  return found;
}

struct Draft {
  Event event;
  CommonCourse course;
};

class Search {
 public:
  Search(std::span<const MemberLoop> loops, const PlantSettings& settings)
      : loops_(loops),
        settings_(settings),
        neighbours_(compare_neighbours(loops)),
        taken_(loops.size(), false) {}

  std::vector<Event> run() {
    while (begin_event()) {
    }
    let_others_join();
    std::vector<Event> events;
    for (Draft& draft : drafts_) {
      std::ranges::sort(draft.event.followers, {}, &Follower::index);
      events.push_back(std::move(draft.event));
    }
    return events;
  }

 private:
  bool begin_event() {
    const Star star = find_star(neighbours_, taken_);
    if (star.rays.empty() || star.p > settings_.event_p) return false;
    std::vector<std::size_t> core{star.centre};
    core.insert(core.end(), star.rays.begin(), star.rays.end());
    const double frequency = middle_frequency(loops_, core);
    CommonCourse course(loops_, core, frequency);
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (!taken_[i] && of_period(loops_[i], frequency)) asked.push_back(i);
    std::vector<Follower> found = followers_of(course, asked, settings_.member_rate);
    // Whatever becomes of the star, it has been looked at.
    for (const std::size_t i : core) taken_[i] = true;
    if (found.size() < 2) return true;
    for (const Follower& follower : found) taken_[follower.index] = true;
    drafts_.push_back({{frequency, star.p, std::move(found)}, std::move(course)});
    return true;
  }

  /// Loops without an event of their own period go to the one that they follow most clearly.
  void let_others_join() {
    std::vector<bool> in_event(loops_.size(), false);
    for (const Draft& draft : drafts_)
      for (const Follower& follower : draft.event.followers) in_event[follower.index] = true;
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (!in_event[i]) free.push_back(i);
    std::vector<std::pair<Follower, std::size_t>> best(loops_.size(), {{}, drafts_.size()});
    for (std::size_t d = 0; d < drafts_.size(); ++d)
      for (const Follower& f : followers_of(drafts_[d].course, free, settings_.member_rate))
        if (best[f.index].second == drafts_.size() || f.p < best[f.index].first.p)
          best[f.index] = {f, d};
    for (const auto& [follower, draft] : best)
      if (draft < drafts_.size()) drafts_[draft].event.followers.push_back(follower);
  }

  std::span<const MemberLoop> loops_;
  const PlantSettings& settings_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<bool> taken_;
  std::vector<Draft> drafts_;
};

}  // namespace

CommonCourse::CommonCourse(std::span<const MemberLoop> loops, std::span<const std::size_t> core,
                           double frequency_hz)
    : loops_(loops), frequency_hz_(frequency_hz) {
  const Envelope first = make_envelope(loops[core.front()], frequency_hz);
  for (const std::size_t index : core) {
    Envelope envelope = make_envelope(loops[index], frequency_hz);
    const CommonGain common = common_gain(envelope, first);
    if (!(common.followed > 0.0)) continue;
    for (std::complex<double>& z : envelope.points) z /= common.gain;
    // The first follows itself without a rest; it weighs as much as one that follows well.
    const double rest = std::max(common.rest / common.followed, 0.01);
    core_.push_back({index, std::move(envelope), 1.0 / rest});
  }
  whole_ = measure_wander(course_of_others(std::nullopt));
}

Envelope CommonCourse::course_of_others(std::optional<std::size_t> index) const {
  Envelope course;
  course.frequency_hz = frequency_hz_;
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

Follower CommonCourse::follow(std::size_t index) const {
  const bool in_core = std::ranges::count(core_, index, &Aligned::index) > 0;
  const Wander course = in_core ? measure_wander(course_of_others(index)) : whole_;
  Envelope own = make_envelope(loops_[index], frequency_hz_);
  const CommonGain common = common_gain(own, course.envelope);
  const double power = variance(loops_[index].error);
  Follower follower{index, 1.0, power > 0.0 ? std::min(1.0, 2.0 * common.followed / power) : 0.0};
  follower.p = compare(course, measure_wander(std::move(own))).p;
  return follower;
}

std::vector<Event> find_events(std::span<const MemberLoop> loops, const PlantSettings& settings) {
  return Search(loops, settings).run();
}

}  // namespace loopscope::core::plant
