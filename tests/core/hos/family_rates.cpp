#include "tests/core/hos/family_rates.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "core/hos/analyse.hpp"
#include "tests/core/hos/uniformity.hpp"

namespace loopscope::core::hos::tests {

FamilyRates FamilyPValues::at(double level) const {
  return {share_below(ngi, level), share_below(nli, level), share_below(cubic, level),
          share_below(nonlinear, level)};
}

FamilyPValues p_values(const simulate::CalibrationFamily& family, int records) {
  FamilyPValues p;
  for (int record = 1; record <= records; ++record) {
    // Away from the seeds that other tests use.
    const auto seed = static_cast<std::uint64_t>(500'000 + record);
    const auto found = analyse(family.draw(family.samples, seed), Settings{}, seed);
    p.ngi.push_back(found.value().ngi_p.value());
    p.nli.push_back(found->nli_p.value());
    p.cubic.push_back(found->cubic_p.value_or(1.0));
    p.nonlinear.push_back(found->nonlinear_p.value());
  }
  return p;
}

const simulate::CalibrationFamily& family(std::string_view name) {
  const auto& all = simulate::calibration_families();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const auto& family) { return family.name == name; });
  if (found == all.end()) throw std::out_of_range("no such family: " + std::string(name));
  return *found;
}

void print_row(std::string_view name, const FamilyPValues& p) {
  std::printf("| %-34s |", std::string(name).c_str());
  for (const double level : {0.05, 0.01, 0.001}) {
    const FamilyRates rates = p.at(level);
    std::printf(" %5.1f | %5.1f | %5.1f | %5.1f |", 100.0 * rates.ngi, 100.0 * rates.nli,
                100.0 * rates.cubic, 100.0 * rates.nonlinear);
  }
  std::printf("\n");
}

}  // namespace loopscope::core::hos::tests
