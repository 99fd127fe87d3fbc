#include "core/plant/line_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/plant/chances.hpp"

namespace loopscope::core::plant {
namespace {

/// Envelopes of two loops can be compared when both were taken at one frequency: a loop is taken at
/// the few frequencies of this grid (a ratio of 4 %) that its neighbours call for.
constexpr double kGrid = 0.04;

struct Line {
  std::size_t index = 0;
  double log_frequency = 0.0;
};

std::vector<Line> sorted_lines(std::span<const MemberLoop> loops) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const loop::Oscillation& found = loops[i].oscillation;
    if (may_begin_event(found)) lines.push_back({i, -std::log(*found.period_s)});
  }
  std::ranges::sort(lines, {}, [](const Line& l) { return std::pair(l.log_frequency, l.index); });
  return lines;
}

/// Every loop's wander at the places of the grid, made when first asked for. Pairs come in the
/// order of frequency, so that places far below can be forgotten.
class WanderBank {
 public:
  explicit WanderBank(std::span<const MemberLoop> loops) : loops_(loops) {}

  const Wander& get(std::size_t index, int place) {
    const auto [found, fresh] = kept_.try_emplace({place, index});
    if (fresh)
      found->second = measure_wander(make_envelope(loops_[index], std::exp(kGrid * place)));
    return found->second;
  }
  void forget_below(int place) { kept_.erase(kept_.begin(), kept_.lower_bound({place, 0})); }

 private:
  std::span<const MemberLoop> loops_;
  std::map<std::pair<int, std::size_t>, Wander> kept_;
};

int place_of(double log_frequency) {
  return static_cast<int>(std::lround(log_frequency / kGrid));
}

/// The best k of one centre's neighbours.
Star star_at(std::size_t centre, std::vector<Neighbour> around) {
  std::ranges::sort(around, {}, [](const Neighbour& n) { return std::pair(n.p, n.index); });
  Star star{centre, {}, 1.0};
  std::size_t size = 0;
  for (std::size_t k = 1; k <= around.size(); ++k) {
    const double p =
        at_least_p(k, around.size(), around[k - 1].p) * static_cast<double>(around.size());
    if (p < star.p) star.p = p, size = k;
  }
  for (std::size_t k = 0; k < size; ++k) star.rays.push_back(around[k].index);
  return star;
}

}  // namespace

bool may_begin_event(const loop::Oscillation& oscillation) {
  return oscillation.period_s &&
         (oscillation.present || oscillation.regularity.value_or(0.0) >= kClearRegularity);
}

std::vector<std::vector<Neighbour>> compare_neighbours(std::span<const MemberLoop> loops) {
  const std::vector<Line> lines = sorted_lines(loops);
  WanderBank bank(loops);
  std::vector<std::vector<Neighbour>> neighbours(loops.size());
  for (std::size_t a = 0; a < lines.size(); ++a) {
    bank.forget_below(place_of(lines[a].log_frequency) - 1);
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      if (lines[b].log_frequency - lines[a].log_frequency > kSamePeriod) break;
      const int place = place_of(0.5 * (lines[a].log_frequency + lines[b].log_frequency));
      const double p = compare(bank.get(lines[a].index, place), bank.get(lines[b].index, place)).p;
      neighbours[lines[a].index].push_back({lines[b].index, p});
      neighbours[lines[b].index].push_back({lines[a].index, p});
    }
  }
  return neighbours;
}

Star find_star(const std::vector<std::vector<Neighbour>>& neighbours,
               const std::vector<bool>& taken) {
  Star best;
  double centres = 0.0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (taken[i] || neighbours[i].empty()) continue;
    std::vector<Neighbour> around;
    std::ranges::copy_if(neighbours[i], std::back_inserter(around),
                         [&](const Neighbour& n) { return !taken[n.index]; });
    centres += 1.0;
    const Star star = star_at(i, std::move(around));
    if (star.p < best.p) best = star;
  }
  best.p = std::min(1.0, best.p * centres);
  return best;
}

}  // namespace loopscope::core::plant
