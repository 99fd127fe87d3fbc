#include "daemon/lab/calibrate/record_tests.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/hos/analyse.hpp"
#include "core/hos/literature/fackrell.hpp"
#include "core/hos/literature/hinich.hpp"
#include "core/hos/numeric/distributions.hpp"

namespace loopscope::daemon {
namespace {

/// Places in record_tests().
enum Place : std::size_t {
  kPublishedNgi,
  kPublishedRule,
  kHinichGaussianity,
  kHinichLinearity,
  kFackrell,
  kNgi,
  kNli,
  kCubic,
  kNonlinear,
};

void add_published(const core::hos::Result& result, const core::hos::Settings& settings,
                   RecordPs& p) {
  const auto ngi_p = [&result](double threshold) {
    return published_p(result.mean_bic2, threshold, result.segments, result.bifrequencies);
  };
  p[kPublishedNgi] = ngi_p(0.0);
  p[kPublishedRule] = result.nli > settings.nli_threshold ? ngi_p(settings.ngi_threshold) : 1.0;
}

/// The tests of the literature, on independent segments and so on an estimate of their own.
void add_literature(std::span<const double> signal, RecordPs& p) {
  const auto finite = std::ranges::count_if(signal, [](double x) { return std::isfinite(x); });
  core::hos::Bicoherence bicoherence(
      core::hos::independent_segments(static_cast<std::size_t>(finite)));
  const auto bic2 = bicoherence.estimate(signal);
  if (bic2.empty()) return;
  // Fackrell's level for a single bifrequency is that of the published test.
  constexpr double kSingleLevel = 0.05;
  const auto hinich = core::hos::hinich(bic2, bicoherence.segments());
  p[kHinichGaussianity] = hinich.gaussianity_p;
  p[kHinichLinearity] = hinich.linearity_p;
  p[kFackrell] = core::hos::fackrell(bic2, bicoherence.segments(), kSingleLevel).count_p;
}

}  // namespace

const std::array<RecordTest, kRecordTests>& record_tests() {
  static constexpr std::array<RecordTest, kRecordTests> kTests = {{
      {"published_ngi", "NGI > 0", "NGI with the critical value of alpha is above 0 (eq. 12)"},
      {"published_rule", "rule", "NGI with the critical value of alpha > 0.001, and NLI > 0.01"},
      {"hinich_gaussianity", "Hinich G", "sum of 2 K bic2 above chi-square with 2P degrees"},
      {"hinich_linearity", "Hinich L", "interquartile range of 2 K bic2 off that of its law"},
      {"fackrell", "Fackrell", "more bifrequencies significant at 5 % than chance leaves"},
      {"ngi_p", "ngi_p", "calibrated test of Gaussianity"},
      {"nli_p", "nli_p", "calibrated test of linearity"},
      {"cubic_p", "cubic_p", "calibrated test of cubic coupling"},
      {"nonlinear_p", "nonlinear_p", "the calibrated tests combined: what decides"},
  }};
  return kTests;
}

double published_p(double mean_bic2, double threshold, std::size_t segments,
                   std::size_t bifrequencies) {
  const auto k = static_cast<double>(segments);
  const auto l = static_cast<double>(bifrequencies);
  // eq. 11 solved for c: mean - threshold exceeds (c + sqrt(4L - 1))^2 / (4KL) up to this c.
  const double excess = std::max(0.0, mean_bic2 - threshold);
  const double deviate = std::sqrt(4.0 * k * l * excess) - std::sqrt(4.0 * l - 1.0);
  return core::hos::normal_upper(deviate);
}

RecordTester::RecordTester(const core::hos::Settings& settings)
    : settings_(settings), bicoherence_(settings) {}

RecordOutcome RecordTester::test(std::span<const double> signal) {
  RecordOutcome outcome;
  add_analysis(signal, outcome);
  add_literature(signal, outcome.p);
  return outcome;
}

void RecordTester::add_analysis(std::span<const double> signal, RecordOutcome& outcome) {
  // Once unmeasured: whoever drew the record has filled the cache with other things.
  static_cast<void>(bicoherence_.estimate(signal));
  const double start_s = thread_cpu_s();
  static_cast<void>(bicoherence_.estimate(signal));
  const double between_s = thread_cpu_s();
  const auto result = core::hos::analyse(signal, settings_);
  outcome.analyse_s = thread_cpu_s() - between_s;
  outcome.estimate_s = between_s - start_s;
  if (!result) return;
  add_published(*result, settings_, outcome.p);
  outcome.p[kNgi] = result->ngi_p;
  outcome.p[kNli] = result->nli_p;
  outcome.p[kCubic] = result->cubic_p;
  outcome.p[kNonlinear] = result->nonlinear_p;
}

double thread_cpu_s() {
  constexpr double kNanosecond_s = 1e-9;
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + kNanosecond_s * static_cast<double>(time.tv_nsec);
}

}  // namespace loopscope::daemon
