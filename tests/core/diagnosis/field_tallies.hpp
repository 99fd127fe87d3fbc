#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "tests/core/model/field_families.hpp"

/// The whole program's verdicts on recordings as plants make them.
namespace loopscope::core::diagnosis::tests {

[[nodiscard]] Verdict recorded_verdict(std::vector<double> sp, std::vector<double> pv,
                                       std::vector<double> op, bool integrating);

struct Tally {
  std::map<std::string, int> codes;
  double confidence = 0.0;
  int records = 0;

  void add(const Verdict& verdict);
  [[nodiscard]] double accused() const;  ///< share of the records
};

[[nodiscard]] Tally tally(const loopscope::tests::model::FieldFamily& family, std::uint64_t first,
                          std::size_t records);

/// Share that is judged as it is.
[[nodiscard]] double right(const loopscope::tests::model::FieldFamily& family, const Tally& found);

}  // namespace loopscope::core::diagnosis::tests
