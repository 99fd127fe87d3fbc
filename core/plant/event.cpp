#include "core/plant/event.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "core/hos/numeric/distributions.hpp"
#include "core/plant/common_course.hpp"
#include "core/plant/false_discovery.hpp"
#include "core/plant/following.hpp"
#include "core/plant/hub.hpp"
#include "core/plant/synchrony.hpp"

namespace loopscope::core::plant {
namespace {

/// Below this share of its variance a loop is touched by the oscillation at most.
constexpr double kLeastStrength = 0.03;
/// Largest ratio of two frequencies, as a logarithm, that may be one line: that of a noisy record
/// or of a limit cycle that wanders is good to a few percent.
constexpr double kSameLine = 0.07;
constexpr int kHarmonics = 9;
/// Largest ratio of two events that are one irregular cycle, seen in different loops at different
/// places of its broad line; they have to share members as well.
constexpr double kOneCycle = 1.35;
/// Lines that are looked about at most, the most significant first: of a plant of ten thousand
/// loops with two or three faint ones each, those are enough, and the time stays bounded.
constexpr std::ptrdiff_t kMostCentres = 2000;
/// Of a line at its place: what none of several loops shows for sure may be plain in all of them.
constexpr double kFaintLine = 0.01;

/// Upper estimate of the share of null tests (Storey 2002; the 1 makes the control hold for finite
/// families, Storey, Taylor and Siegmund 2004).
double null_share(std::span<const double> p) {
  constexpr double kMiddle = 0.5;
  const auto above = std::ranges::count_if(p, [](double value) { return value > kMiddle; });
  return std::min(1.0, (1.0 + static_cast<double>(above)) /
                           (kMiddle * static_cast<double>(std::max<std::size_t>(1, p.size()))));
}

/// Envelopes are taken at these steps of ln f: lines of one step share them, and half a step off is
/// a turn in two hundred periods, slow beside the two of an envelope's window.
constexpr double kFrequencyStep = 0.02;

/// A line of one loop, from which an event may be found.
struct Centre {
  std::size_t index = 0;
  SpectralLine line;
  double step = 0.0;    ///< the line's frequency in kFrequencySteps, a whole number
  double step_p = 1.0;  ///< of the most significant line of this step
};

Centre make_centre(std::size_t index, const SpectralLine& line) {
  return {index, line, std::round(std::log(line.frequency_hz) / kFrequencyStep), line.p};
}

/// The most significant first, all lines of one step together.
void put_in_order(std::vector<Centre>& centres) {
  std::map<double, double> least;
  for (const Centre& one : centres) {
    const auto [known, added] = least.try_emplace(one.step, one.line.p);
    known->second = std::min(known->second, one.line.p);
  }
  for (Centre& one : centres) one.step_p = least.at(one.step);
  std::ranges::stable_sort(
      centres, {}, [](const Centre& one) { return std::tuple(one.step_p, one.step, one.line.p); });
}

/// Whether a line lies at the fundamental or a harmonic of an oscillation.
bool belongs(double line_hz, double fundamental_hz) {
  const double order = std::round(line_hz / fundamental_hz);
  return order >= 1.0 && order <= kHarmonics &&
         std::abs(std::log(line_hz / (order * fundamental_hz))) <= kSameLine / order;
}

bool has(const Event& event, std::size_t index) {
  return std::ranges::count(event.members, index, &EventMember::index) > 0;
}

/// One is a harmonic of the other or lies about the same line, and they share most of the smaller
/// one's loops: the same course, seen from another loop.
bool is_part_of_other(const Event& one, const Event& other) {
  const double low = std::min(one.frequency_hz, other.frequency_hz);
  const double high = std::max(one.frequency_hz, other.frequency_hz);
  return (belongs(high, low) || high <= kOneCycle * low) &&
         2 * std::ranges::count_if(one.members,
                                   [&](const EventMember& m) { return has(other, m.index); }) >=
             std::ssize(one.members.size() < other.members.size() ? one.members : other.members);
}

void join(Event& event, const Event& other) {
  if (other.frequency_hz < 0.75 * event.frequency_hz) event.frequency_hz = other.frequency_hz;
  event.p = std::min(event.p, other.p);
  for (const EventMember& one : other.members) {
    const auto known = std::ranges::find(event.members, one.index, &EventMember::index);
    if (known == event.members.end())
      event.members.push_back(one);
    else if (one.strength > known->strength)
      *known = one;
  }
}

class Search {
 public:
  Search(std::span<const LoopRecords> records, const PlantSettings& settings)
      : settings_(settings), records_(records), events_of_(records.size()) {
    for (std::size_t i = 0; i < records_.size(); ++i)
      for (const SpectralLine& line : records_[i].lines(kFaintLine))
        centres_.push_back(make_centre(i, line));
    std::ranges::stable_sort(centres_, {}, [](const Centre& c) { return c.line.p; });
    if (std::ssize(centres_) > kMostCentres)
      centres_.erase(centres_.begin() + kMostCentres, centres_.end());
    put_in_order(centres_);
  }

  std::vector<Event> run() {
    for (const Centre& centre : centres_)
      if (!explained(centre)) look_about(centre);
    keep_one_event_each();
    for (Event& event : events_) std::ranges::sort(event.members, {}, &EventMember::index);
    return std::move(events_);
  }

 private:
  [[nodiscard]] bool explained(const Centre& centre) const {
    return std::ranges::any_of(events_of_[centre.index], [&](std::size_t event) {
      return belongs(centre.line.frequency_hz, events_[event].frequency_hz);
    });
  }

  /// Of every loop with power at the step's frequency; the others' are empty.
  const std::vector<Envelope>& envelopes_at(double step) {
    if (step == step_ && !envelopes_.empty()) return envelopes_;
    step_ = step;
    const double frequency_hz = std::exp(step * kFrequencyStep);
    envelopes_.assign(records_.size(), {});
    for (std::size_t i = 0; i < records_.size(); ++i)
      if (records_[i].share_about(frequency_hz) >= kLeastStrength)
        envelopes_[i] = records_[i].envelope(frequency_hz);
    return envelopes_;
  }

  void look_about(const Centre& centre) {
    const std::vector<Envelope>& envelopes = envelopes_at(centre.step);
    const std::vector<bool> has_line = lines_at(centre.line.frequency_hz, envelopes);
    const Hub hub = hub_about(centre, envelopes, has_line);
    const double hub_p = hub.p * static_cast<double>(centres_.size());
    if (hub.neighbours.empty() || hub_p > settings_.event_p) return;
    std::vector<std::size_t> core{hub.centre};
    core.insert(core.end(), hub.neighbours.begin(), hub.neighbours.end());
    const CommonCourse course(envelopes, core);
    Event event{course.frequency_hz(), hub_p,
                members_of(course, envelopes, has_line, centre.line.frequency_hz)};
    if (event.members.size() < 2) return;
    event.p = std::max(event.p, shared_line_p(centre, event.members));
    if (event.p <= settings_.event_p) add(std::move(event));
  }

  /// Which of those with an envelope have a line of their own.
  [[nodiscard]] std::vector<bool> lines_at(double frequency_hz,
                                           const std::vector<Envelope>& envelopes) const {
    std::vector<bool> has_line(records_.size());
    for (std::size_t i = 0; i < records_.size(); ++i)
      has_line[i] = !envelopes[i].points.empty() && records_[i].share(frequency_hz) > 0.0;
    return has_line;
  }

  /// Loops with a line of their own here have to keep step, the others to follow: two families, of
  /// which the one that says less may still join.
  [[nodiscard]] Hub hub_about(const Centre& centre, const std::vector<Envelope>& envelopes,
                              const std::vector<bool>& has_line) const {
    std::vector<Neighbour> lines, others;
    const Envelope& own = envelopes[centre.index];
    const Increments increments = measure_increments(own);
    for (std::size_t i = 0; i < envelopes.size(); ++i) {
      if (i == centre.index || envelopes[i].points.empty()) continue;
      if (has_line[i])
        lines.push_back({i, compare(increments, measure_increments(envelopes[i])).p});
      else
        others.push_back({i, follow(envelopes[i], own).p});
    }
    Hub hub = find_hub(centre.index, std::move(lines));
    const Hub other = find_hub(centre.index, std::move(others));
    if (other.p < hub.p && other.p > settings_.event_p) hub.neighbours.clear();
    if (other.p <= std::max(hub.p, settings_.event_p))
      hub.neighbours.insert(hub.neighbours.end(), other.neighbours.begin(), other.neighbours.end());
    hub.p = std::min(1.0, 2.0 * std::min(hub.p, other.p));
    return hub;
  }

  /// Who follows the course, by false-discovery control among the loops with a line here and among
  /// the others: most of the first belong, few of the second.
  [[nodiscard]] std::vector<EventMember> members_of(const CommonCourse& course,
                                                    const std::vector<Envelope>& envelopes,
                                                    const std::vector<bool>& has_line,
                                                    double frequency_hz) const {
    std::vector<EventMember> lines, others;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (envelopes[i].points.empty()) continue;
      const Follower found = course.follow(i, has_line[i]);
      const double variance = records_[i].variance(frequency_hz);
      const double share = variance > 0.0 ? found.followed / variance : 0.0;
      (has_line[i] ? lines : others).push_back({i, found.p, std::min(1.0, share)});
    }
    std::vector<EventMember> found = discover(lines);
    std::ranges::move(discover(others), std::back_inserter(found));
    return found;
  }

  [[nodiscard]] std::vector<EventMember> discover(const std::vector<EventMember>& asked) const {
    std::vector<double> p;
    for (const EventMember& one : asked) p.push_back(one.p);
    const std::vector<bool> follows =
        control_false_discovery(p, std::min(1.0, settings_.member_rate / null_share(p))).flagged;
    std::vector<EventMember> found;
    for (std::size_t k = 0; k < asked.size(); ++k)
      if (follows[k] && asked[k].strength >= kLeastStrength) found.push_back(asked[k]);
    return found;
  }

  void add(Event event) {
    const auto same = std::ranges::find_if(
        events_, [&](const Event& other) { return is_part_of_other(event, other); });
    if (same == events_.end())
      events_.push_back(std::move(event));
    else
      join(*same, event);
    for (auto& events : events_of_) events.clear();
    for (std::size_t e = 0; e < events_.size(); ++e)
      for (const EventMember& one : events_[e].members) events_of_[one.index].push_back(e);
  }

  /// That loops without a line show so much of one together, by Fisher's rule over those that
  /// follow the course: a line that each shows faintly is plain in all of them.
  [[nodiscard]] double shared_line_p(const Centre& centre,
                                     const std::vector<EventMember>& members) const {
    std::array<double, kLineShapes> sums{};
    double count = 0.0;
    const auto add = [&](std::size_t index) {
      std::array<double, kLineShapes> best{};
      for (const double shift : {0.97, 0.985, 1.0, 1.015, 1.03}) {
        const auto here = records_[index].evidence(centre.line.frequency_hz * shift);
        for (std::size_t k = 0; k < best.size(); ++k) best[k] = std::max(best[k], here[k]);
      }
      for (std::size_t k = 0; k < best.size(); ++k) sums[k] += best[k];
      count += 1.0;
    };
    add(centre.index);
    for (const EventMember& one : members)
      if (one.index != centre.index) add(one.index);
    const double most = *std::ranges::max_element(sums);
    const double groups = static_cast<double>(records_.size()) / count;
    return records_[centre.index].bands(centre.line.frequency_hz) * groups *
           hos::gamma_upper(most, count);
  }

  /// A loop that follows several courses is told of with the one that shakes it most.
  void keep_one_event_each() {
    std::vector<double> most(records_.size(), 0.0);
    for (const Event& event : events_)
      for (const EventMember& one : event.members)
        most[one.index] = std::max(most[one.index], one.strength);
    for (Event& event : events_)
      std::erase_if(event.members, [&](const EventMember& one) {
        if (one.strength < most[one.index]) return true;
        most[one.index] = std::numeric_limits<double>::infinity();  // none of two that are equal
        return false;
      });
    std::erase_if(events_, [](const Event& event) { return event.members.size() < 2; });
  }

  const PlantSettings& settings_;
  std::span<const LoopRecords> records_;
  std::vector<Centre> centres_;  // put_in_order
  double step_ = 0.0;            // of envelopes_
  std::vector<Envelope> envelopes_;
  std::vector<Event> events_;
  std::vector<std::vector<std::size_t>> events_of_;
};

}  // namespace

std::vector<Event> find_events(std::span<const LoopRecords> records,
                               const PlantSettings& settings) {
  return Search(records, settings).run();
}

std::vector<Event> find_events(std::span<const MemberLoop> loops, const PlantSettings& settings) {
  const std::vector<LoopRecords> records(loops.begin(), loops.end());
  return find_events(records, settings);
}

}  // namespace loopscope::core::plant
