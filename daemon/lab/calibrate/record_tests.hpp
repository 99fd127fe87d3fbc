#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::daemon {

/// A test that calibration measures.
struct RecordTest {
  std::string_view name;     ///< key in JSON
  std::string_view heading;  ///< of its column
  std::string_view rule;     ///< when it rejects at a level alpha
};

inline constexpr std::size_t kRecordTests = 9;
[[nodiscard]] const std::array<RecordTest, kRecordTests>& record_tests();

/// One p-value per test, in the order of record_tests(); a test rejects at every level from its
/// p-value on. nullopt = not computed.
using RecordPs = std::array<std::optional<double>, kRecordTests>;

/// What the tests said of one record, and CPU seconds of its analysis.
struct RecordOutcome {
  RecordPs p;
  double estimate_s = 0.0;  ///< squared bicoherence alone, buffers reused and in the cache
  double analyse_s = 0.0;   ///< core::hos::analyse: everything in its result
};

/// p-value of the published Gaussianity test by eq. 9 to 11: NGI with the critical value of a level
/// is above `threshold` from that level on. `mean_bic2` over `bifrequencies` (L, > 0) values of
/// `segments` (K).
[[nodiscard]] double published_p(double mean_bic2, double threshold, std::size_t segments,
                                 std::size_t bifrequencies);

/// Applies all tests. One object per thread.
class RecordTester {
 public:
  explicit RecordTester(const core::hos::Settings& settings);

  /// NaN in `signal` is missing.
  [[nodiscard]] RecordOutcome test(std::span<const double> signal);

 private:
  void add_analysis(std::span<const double> signal, RecordOutcome& outcome);

  core::hos::Settings settings_;
  core::hos::Bicoherence bicoherence_;
};

/// CPU seconds that the calling thread has used: what a piece of work costs, whatever else runs.
[[nodiscard]] double thread_cpu_s();

}  // namespace loopscope::daemon
