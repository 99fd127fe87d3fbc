#include "core/model/residual_tests/statistics/spectral_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/core/model/residual_tests/loops.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

using tests::add_sinusoid;
using tests::Series;

LOOPSCOPE_TABLE(spectral_line_periods, "lines found and errors of their periods") {
  for (const std::size_t samples : {std::size_t{4096}, std::size_t{750}})
    for (const double amplitude : {0.15, 0.3, 1.0})
      for (const double period : {20.3, 100.7, 401.3}) {
        std::vector<double> errors;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
          Series signal = tests::white(tests::White::gaussian, samples, seed);
          add_sinusoid(signal, period, amplitude);
          const LineSearch found = find_lines(signal);
          if (found.p <= 0.01)
            errors.push_back(100.0 * std::abs(found.lines[0].period_samples / period - 1.0));
        }
        std::sort(errors.begin(), errors.end());
        const auto at = [&errors](std::size_t tenths) {
          return errors.empty() ? 0.0 : errors[(errors.size() - 1) * tenths / 10];
        };
        std::printf("%zu A %.2f period %.1f: found %zu %%, error %.3f %%, 90 %% below %.3f %%\n",
                    samples, amplitude, period, errors.size(), at(5), at(9));
      }
}

}  // namespace
}  // namespace loopscope::core::model
