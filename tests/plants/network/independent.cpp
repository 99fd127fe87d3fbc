#include "tests/plants/network/independent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "core/plant/event.hpp"
#include "core/signal/prepare.hpp"
#include "tests/effects/window_of.hpp"
#include "tests/plants/network/network.hpp"
#include "tests/support/in_threads.hpp"

namespace loopscope::tests::network {
namespace {

using core::plant::MemberLoop;

constexpr std::size_t kNetworks = 60;
constexpr std::size_t kLoops = 30;

/// The errors of one network's loops.
std::vector<core::signal::PreparedLoop> prepared_loops(std::uint64_t seed) {
  std::vector<core::signal::PreparedLoop> loops;
  for (const LoopRecord& record : draw_network(seed, Origin::valve).records)
    loops.push_back(core::signal::prepare(effects::window_of(record, record.interval_s, 0), {}));
  return loops;
}

MemberLoop member_of(const core::signal::PreparedLoop& loop, std::int64_t id) {
  MemberLoop member;
  member.id = id;
  member.sample_interval_s = loop.sample_interval_s;
  member.start_us =
      -std::llround(1e6 * loop.sample_interval_s * static_cast<double>(loop.error.size()));
  member.error = loop.error;
  return member;
}

}  // namespace

std::size_t plants_with_false_event(std::uint64_t seed, std::size_t plants, unsigned threads) {
  std::vector<std::vector<core::signal::PreparedLoop>> networks(kNetworks);
  in_threads(kNetworks, threads, [&](std::size_t k) { networks[k] = prepared_loops(seed + k); });
  std::vector<int> shown(plants, 0);
  in_threads(plants, threads, [&](std::size_t plant) {
    std::mt19937_64 random(seed + plant);
    std::vector<std::size_t> order(kNetworks);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::shuffle(order, random);
    std::vector<MemberLoop> members;
    for (std::size_t k = 0; k < kLoops; ++k) {
      const auto& loops = networks[order[k]];
      members.push_back(member_of(loops[random() % loops.size()], static_cast<std::int64_t>(k)));
    }
    shown[plant] = core::plant::find_events(members, {}).empty() ? 0 : 1;
  });
  return static_cast<std::size_t>(std::ranges::count(shown, 1));
}

}  // namespace loopscope::tests::network
