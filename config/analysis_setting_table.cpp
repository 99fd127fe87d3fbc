#include "config/analysis_setting_table.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace loopscope::config {
namespace {

using core::AnalysisSettings;
using core::diagnosis::DecisionSettings;
using core::diagnosis::Priors;
using core::loop::OscillationSettings;
using core::loop::PerformanceSettings;
using core::signal::PrepareSettings;
using Hos = core::hos::Settings;
namespace bounds = core::hos::bounds;

template <auto member>
constexpr auto in_analysis = target_at<&Settings::analysis, member>;
template <auto member>
constexpr auto in_prepare = target_at<&Settings::analysis, &AnalysisSettings::prepare, member>;
template <auto member>
constexpr auto in_decision = target_at<&Settings::analysis, &AnalysisSettings::decision, member>;
template <auto member>
constexpr auto in_priors =
    target_at<&Settings::analysis, &AnalysisSettings::decision, &DecisionSettings::priors, member>;
template <auto member>
constexpr auto in_hos = target_at<&Settings::analysis, &AnalysisSettings::hos, member>;
template <auto member>
constexpr auto in_oscillation =
    target_at<&Settings::analysis, &AnalysisSettings::oscillation, member>;
template <auto member>
constexpr auto in_performance =
    target_at<&Settings::analysis, &AnalysisSettings::performance, member>;

/// The names are those of core/hos, not written down a second time.
const auto kWindowNames = [] {
  std::array<std::string_view, kWindowShapes.size()> names;
  std::transform(kWindowShapes.begin(), kWindowShapes.end(), names.begin(),
                 [](core::hos::WindowShape shape) { return core::hos::name(shape); });
  return names;
}();

/// The fewest samples that a verdict may rest on: 15 segments of 64 at 50 % overlap.
constexpr double kFewestSamples = 512;
/// A window this long holds a week at one sample in five seconds.
constexpr double kMostSamples = 131072;

/// 0 = as in the loops that the curves of the causes were fitted on.
constexpr auto kPrior = range(0, 0.99);

constexpr std::array kAnalysisSettings = {
    Setting{"/analysis/window_samples", in_prepare<&PrepareSettings::window_samples>,
            range(kFewestSamples, kMostSamples, "samples"),
            "length of a window: the last samples before its end"},
    Setting{"/analysis/min_usable_samples", in_prepare<&PrepareSettings::min_usable_samples>,
            range(kFewestSamples, kMostSamples, "samples"),
            "fewest usable samples with which a window is judged"},
    Setting{"/analysis/max_missing_fraction", in_prepare<&PrepareSettings::max_missing_fraction>,
            range(0, 0.9), "largest share of missing samples with which a window is judged"},
    Setting{"/analysis/max_filled_gap", in_prepare<&PrepareSettings::max_filled_gap>,
            range(0, 100, "samples"), "longest gap that is filled by a straight line"},
    Setting{"/analysis/slow_span_windows", in_prepare<&PrepareSettings::slow_span_windows>,
            range(1, 16, "windows"),
            "longest history that is read for a slow oscillation; 1 = never more than the window"},
    Setting{"/analysis/fit_model", in_analysis<&AnalysisSettings::fit_model>, any(Form::toggle),
            "whether a loop model is fitted; false = statistics and shapes only"},

    Setting{"/analysis/hos/segment_length", in_hos<&Hos::segment_length>,
            even_range(bounds::kSegmentLength, "samples"),
            "length of a segment of the averaged estimates"},
    Setting{"/analysis/hos/overlap", in_hos<&Hos::overlap>, range(bounds::kOverlap),
            "share of a segment that the next one repeats; whole samples"},
    Setting{"/analysis/hos/window", in_hos<&Hos::window>, one_of(kWindowNames),
            "taper of a segment; `hann` is the paper's"},
    Setting{"/analysis/hos/dft_length", in_hos<&Hos::dft_length>,
            even_range(bounds::kDftLength, "samples"),
            "length to which segments are padded; at least one segment"},
    Setting{"/analysis/hos/alpha", in_hos<&Hos::alpha>, range(bounds::kAlpha),
            "significance level of the critical bicoherence"},
    Setting{"/analysis/hos/ngi_threshold", in_hos<&Hos::ngi_threshold>, range(bounds::kThreshold),
            "largest NGI that counts as Gaussian"},
    Setting{"/analysis/hos/nli_threshold", in_hos<&Hos::nli_threshold>, range(bounds::kThreshold),
            "largest NLI that counts as linear"},
    Setting{"/analysis/hos/max_peaks", in_hos<&Hos::max_peaks>, range(bounds::kMaxPeaks, "peaks"),
            "number of strongest distinct peaks that are reported"},

    Setting{"/analysis/oscillation/min_regularity",
            in_oscillation<&OscillationSettings::min_regularity>, range(0.1, 100),
            "least regularity of an oscillation: mean / (3 std) of its half periods"},
    Setting{"/analysis/oscillation/min_half_period_samples",
            in_oscillation<&OscillationSettings::min_half_period_samples>,
            range(1, 1000, "samples"), "shortest half period that is not noise"},
    Setting{"/analysis/oscillation/min_cycles", in_oscillation<&OscillationSettings::min_cycles>,
            range(1, 1000, "cycles"), "fewest cycles of an oscillation within the window"},

    Setting{"/analysis/performance/min_delay_samples",
            in_performance<&PerformanceSettings::min_delay_samples>, range(1, 1000, "samples"),
            "shortest plausible delay of a loop"},
    Setting{"/analysis/performance/max_delay_samples",
            in_performance<&PerformanceSettings::max_delay_samples>, range(1, 1000, "samples"),
            "longest plausible delay of a loop"},
    Setting{"/analysis/performance/ar_order", in_performance<&PerformanceSettings::ar_order>,
            range(1, 200, "coefficients"), "order of the error model behind the Harris index"},

    Setting{"/analysis/decision/line", in_decision<&DecisionSettings::line>, range(0, 1),
            "least probability of a cause that is named"},
    Setting{"/analysis/priors/healthy", in_priors<&Priors::healthy>, kPrior,
            "share of loops in which nothing is wrong; 0 = that of the fit"},
    Setting{"/analysis/priors/valve_stiction", in_priors<&Priors::valve_stiction>, kPrior,
            "share of loops in which the valve sticks; 0 = that of the fit"},
    Setting{"/analysis/priors/valve_deadband", in_priors<&Priors::valve_deadband>, kPrior,
            "share of loops in which the valve has dead band; 0 = that of the fit"},
    Setting{"/analysis/priors/valve_saturation", in_priors<&Priors::valve_saturation>, kPrior,
            "share of loops in which the output meets a limit; 0 = that of the fit"},
    Setting{"/analysis/priors/valve_characteristic", in_priors<&Priors::valve_characteristic>,
            kPrior,
            "share of loops in which the valve's characteristic is curved; 0 = that of the fit"},
    Setting{"/analysis/priors/valve_oversized", in_priors<&Priors::valve_oversized>, kPrior,
            "share of loops in which the valve is too large; 0 = that of the fit"},
    Setting{"/analysis/priors/process_nonlinearity", in_priors<&Priors::process_nonlinearity>,
            kPrior, "share of loops in which the process is nonlinear; 0 = that of the fit"},
    Setting{"/analysis/priors/external_disturbance", in_priors<&Priors::external_disturbance>,
            kPrior,
            "share of loops in which something reaches the loop from outside; 0 = that of the fit"},
    Setting{"/analysis/priors/process_change", in_priors<&Priors::process_change>, kPrior,
            "share of loops in which the process changes; 0 = that of the fit"},
    Setting{"/analysis/priors/sensor_fault", in_priors<&Priors::sensor_fault>, kPrior,
            "share of loops in which the measurement is faulty; 0 = that of the fit"},
    Setting{"/analysis/priors/tight_tuning", in_priors<&Priors::tight_tuning>, kPrior,
            "share of loops in which the controller is too tight; 0 = that of the fit"},
    Setting{"/analysis/priors/sluggish_tuning", in_priors<&Priors::sluggish_tuning>, kPrior,
            "share of loops in which the controller is too slow; 0 = that of the fit"},
};

}  // namespace

std::span<const Setting> analysis_setting_table() {
  return kAnalysisSettings;
}

}  // namespace loopscope::config
