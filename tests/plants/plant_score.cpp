#include "tests/plants/plant_score.hpp"

#include <algorithm>
#include <stdexcept>

namespace loopscope::tests::plants {
namespace {

const std::vector<std::string>& right_verdicts(const PlantLoop& loop) {
  for (const effects::KindInfo& kind : effects::all_kinds())
    if (kind.name == loop.record) return kind.verdicts;
  throw std::invalid_argument("no kind of record: " + loop.record);
}

bool is_right(const PlantLoop& loop, const std::string& verdict) {
  const std::vector<std::string>& right = right_verdicts(loop);
  return std::find(right.begin(), right.end(), verdict) != right.end();
}

bool names_a_cause(const std::string& verdict) {
  return verdict != "unexplained" && verdict != "nonlinear_unexplained";
}

/// `verdict` = empty when the loop is not on the list.
void count_faulty(PlantScore& total, const PlantLoop& loop, const std::string& verdict) {
  FaultScore& fault = total.by_fault[loop.fault];
  ++total.faulty;
  ++fault.faulty;
  if (verdict.empty()) return;
  if (is_right(loop, verdict)) {
    ++total.right;
    ++fault.right;
  } else if (names_a_cause(verdict)) {
    ++total.false_flags;
    ++fault.wrong;
  } else {
    ++fault.unnamed;
  }
}

bool as_it_should_be(const PlantLoop& loop, const std::string& verdict) {
  return loop.is_faulty() ? !verdict.empty() && is_right(loop, verdict) : verdict.empty();
}

void count(PlantScore& total, const PlantLoop& loop, const std::string& verdict) {
  ++total.loops;
  if (loop.is_faulty()) {
    count_faulty(total, loop, verdict);
  } else if (!verdict.empty()) {
    ++total.false_flags;
    ++total.false_healthy;
  }
  if (!as_it_should_be(loop, verdict))
    total.misses.push_back(loop.name + " " + loop.record + ": " +
                           (verdict.empty() ? "not flagged" : verdict));
}

}  // namespace

PlantScore score(const std::vector<PlantLoop>& plant, const Flags& flags) {
  PlantScore total;
  std::size_t found = 0;
  for (const PlantLoop& loop : plant) {
    const auto flag = flags.find(loop.name);
    found += flag == flags.end() ? 0U : 1U;
    count(total, loop, flag == flags.end() ? std::string() : flag->second);
  }
  if (found != flags.size())
    throw std::invalid_argument("a loop is flagged that the plant does not have");
  return total;
}

}  // namespace loopscope::tests::plants
