#include "storage/stage_cost.hpp"

namespace loopscope::storage {
namespace {

/// Every member of both, pair by pair.
template <typename Use>
void with_members(StageCost& a, const StageCost& b, Use use) {
  use(a.loops, b.loops);
  use(a.analysed, b.analysed);
  use(a.modelled, b.modelled);
  use(a.values, b.values);
  use(a.claim_s, b.claim_s);
  use(a.fetch_s, b.fetch_s);
  use(a.prepare_s, b.prepare_s);
  use(a.statistics_s, b.statistics_s);
  use(a.model_s, b.model_s);
  use(a.decide_s, b.decide_s);
  use(a.write_s, b.write_s);
  use(a.wait_s, b.wait_s);
}

}  // namespace

void add(StageCost& sum, const StageCost& more) {
  with_members(sum, more, [](auto& to, auto from) { to += from; });
}

StageCost difference(const StageCost& later, const StageCost& earlier) {
  StageCost rest = later;
  with_members(rest, earlier, [](auto& of, auto taken) { of -= taken; });
  return rest;
}

}  // namespace loopscope::storage
