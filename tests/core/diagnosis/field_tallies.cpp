#include "tests/core/diagnosis/field_tallies.hpp"

#include <utility>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::core::diagnosis::tests {
namespace {

using loopscope::tests::model::FieldFamily;

}  // namespace

Verdict recorded_verdict(std::vector<double> sp, std::vector<double> pv, std::vector<double> op,
                         bool integrating) {
  signal::LoopWindow window;
  window.sp = std::move(sp);
  window.pv = std::move(pv);
  window.op = std::move(op);
  return diagnose(window, {}, {.integrating = integrating}).verdict;
}

void Tally::add(const Verdict& verdict) {
  ++codes[std::string(name(verdict.code))];
  confidence += verdict.confidence;
  ++records;
}

double Tally::accused() const {
  const auto found = codes.find(std::string(name(VerdictCode::valve_stiction)));
  return found == codes.end() ? 0.0 : static_cast<double>(found->second) / records;
}

Tally tally(const FieldFamily& family, std::uint64_t first, std::size_t records) {
  Tally result;
  for (std::uint64_t seed = first; seed < first + records; ++seed) {
    const loopscope::tests::model::FieldLoop loop = record_of(family, seed);
    result.add(recorded_verdict(loop.sp, loop.pv, loop.op, is_level(family)));
  }
  return result;
}

double right(const FieldFamily& family, const Tally& found) {
  return family.sticks ? found.accused() : 1.0 - found.accused();
}

}  // namespace loopscope::core::diagnosis::tests
