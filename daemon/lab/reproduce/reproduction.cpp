#include "daemon/lab/reproduce/reproduction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/diagnosis/diagnose.hpp"
#include "core/hos/analyse.hpp"
#include "core/hos/numeric/quantile.hpp"
#include "core/hos/transforms/window.hpp"
#include "core/simulate/scenario.hpp"
#include "daemon/lab/reproduce/bifrequency.hpp"

namespace loopscope::daemon {
namespace {

using core::simulate::LoopRecord;

double standard_deviation(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double square = 0.0;
  for (const double value : values) square += (value - mean) * (value - mean);
  return std::sqrt(square / static_cast<double>(values.size()));
}

bool in_principal_domain(const PaperPeak& peak) {
  return peak.f1 + peak.f2 <= 0.5;
}

/// Within one main lobe two lines are one to the estimate.
bool is_at(const core::hos::Peak& found, const PaperPeak& wanted,
           const core::hos::Settings& settings) {
  const double lobe = core::hos::main_lobe_half_width(settings.window) /
                      static_cast<double>(settings.segment_length);
  return std::abs(found.f1 - wanted.f1) <= lobe && std::abs(found.f2 - wanted.f2) <= lobe;
}

/// Outside the principal domain a single bifrequency is tested, so without correction for many:
/// K bic2 is exponential without coupling and passes -ln(alpha) with probability alpha.
bool stands_out(const std::vector<double>& signal, const PaperPeak& peak,
                const core::hos::Settings& settings) {
  const BifrequencyEstimate estimate = estimate_at(signal, peak.f1, peak.f2, settings);
  return static_cast<double>(estimate.segments) * estimate.bic2 > -std::log(settings.alpha);
}

bool found(const PaperPeak& peak, const std::vector<double>& signal,
           const core::hos::Result& result, const core::hos::Settings& settings) {
  if (!in_principal_domain(peak)) return stands_out(signal, peak, settings);
  return std::ranges::any_of(result.peaks,
                             [&](const auto& seen) { return is_at(seen, peak, settings); });
}

bool decided_as(PaperDecision decision, const core::hos::PublishedDecision& published) {
  return decision == PaperDecision::gaussian ? published.gaussian : !published.linear;
}

/// The historian's view of a loop: no valve position, as in most plants.
std::string verdict_of(const LoopRecord& record) {
  core::signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  window.op_range = core::signal::OpRange{};
  return std::string(core::diagnosis::name(core::diagnose(window, {}).verdict.code));
}

/// Collects one example seed by seed.
class Collector {
 public:
  explicit Collector(const Example& example) : example_(example), peaks_(example.peaks.size()) {}

  void add(std::uint64_t seed) {
    const LoopRecord record = core::simulate::simulate_scenario(example_.scenario, {}, seed);
    const std::vector<double> signal = core::simulate::control_error(record);
    const auto result = core::hos::analyse(signal, example_.settings);
    if (!result) throw std::runtime_error("scenario without variance: " + example_.scenario);
    ngi_.push_back(result->ngi);
    nli_.push_back(result->nli);
    error_std_.push_back(standard_deviation(signal));
    if (decided_as(example_.decision, result->published)) ++decided_;
    add_peaks(signal, *result);
    if (example_.is_loop) ++verdicts_[verdict_of(record)];
  }

  [[nodiscard]] Measurement result() const {
    Measurement measurement;
    measurement.ngi = spread_of(ngi_);
    measurement.nli = spread_of(nli_);
    measurement.error_std = spread_of(error_std_);
    measurement.decision_share = share(decided_);
    measurement.peak_seeds = share(max_f1_.size());
    if (!max_f1_.empty()) {
      measurement.max_f1 = spread_of(max_f1_);
      measurement.max_f2 = spread_of(max_f2_);
    }
    for (std::size_t i = 0; i < peaks_.size(); ++i) {
      const PaperPeak& peak = example_.peaks[i];
      measurement.peaks.push_back({peak, in_principal_domain(peak), share(peaks_[i])});
    }
    measurement.verdict = verdict();
    return measurement;
  }

 private:
  void add_peaks(const std::vector<double>& signal, const core::hos::Result& result) {
    if (!result.peaks.empty()) {
      max_f1_.push_back(result.peaks.front().f1);
      max_f2_.push_back(result.peaks.front().f2);
    }
    for (std::size_t i = 0; i < peaks_.size(); ++i) {
      if (found(example_.peaks[i], signal, result, example_.settings)) ++peaks_[i];
    }
  }

  [[nodiscard]] double share(std::size_t count) const {
    return static_cast<double>(count) / static_cast<double>(ngi_.size());
  }

  [[nodiscard]] std::optional<VerdictShare> verdict() const {
    if (verdicts_.empty()) return std::nullopt;
    const auto most = std::ranges::max_element(
        verdicts_, {}, [](const auto& code_count) { return code_count.second; });
    return VerdictShare{most->first, share(most->second)};
  }

  const Example& example_;
  std::vector<double> ngi_, nli_, error_std_, max_f1_, max_f2_;
  std::vector<std::size_t> peaks_;
  std::size_t decided_ = 0;
  std::map<std::string, std::size_t> verdicts_;
};

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("spread of no values");
  std::ranges::sort(values);
  const auto at = [&values](double share) { return core::hos::sample_quantile(values, share); };
  return {at(0.5), at(0.1), at(0.9), values.front(), values.back()};
}

std::string_view name(Agreement agreement) {
  switch (agreement) {
    case Agreement::met:
      return "met";
    case Agreement::in_range:
      return "in_range";
    case Agreement::not_met:
      break;
  }
  return "not_met";
}

Agreement agreement_of(double paper, const Spread& ours) {
  if (paper >= ours.p10 && paper <= ours.p90) return Agreement::met;
  return paper >= ours.min && paper <= ours.max ? Agreement::in_range : Agreement::not_met;
}

Measurement measure(const Example& example, std::size_t seeds) {
  Collector collector(example);
  for (std::size_t seed = 1; seed <= seeds; ++seed) collector.add(seed);
  return collector.result();
}

Reproduction reproduce_paper(std::size_t seeds) {
  Reproduction reproduction;
  reproduction.seeds = seeds;
  for (const Example& example : paper_examples()) {
    reproduction.examples.push_back({example, measure(example, seeds)});
  }
  return reproduction;
}

}  // namespace loopscope::daemon
