#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/hos/bicoherence.hpp"
#include "core/hos/segment_levels.hpp"

namespace loopscope::core::hos {

/// What a record needs before its bicoherence may be tested.
struct Precautions {
  /// The spectrum falls so steeply that its low end leaks over everything: the differences are
  /// tested. A linear filter changes no bicoherence.
  bool differenced = false;
  double overlap = 0.5;  ///< of the segments; another one than the settings' where a line is locked
};

/// The record and its squared bicoherence as the tests look at them: the published one where
/// nothing speaks against it, else one of the same record taken with precautions.
class TestedSpectra {
 public:
  /// `published` holds the last estimate, of `signal` with its own settings; both outlive this.
  TestedSpectra(std::span<const double> signal, const Bicoherence& published,
                std::span<const double> published_bic2, const Settings& settings);

  /// For a replicate of a record whose precautions are known; its variance is taken as constant.
  TestedSpectra(std::span<const double> signal, const Precautions& precautions,
                const Settings& settings, const Kernels& kernels = best_kernels());

  /// Turns to the next replicate, in the same memory; of one made for a replicate only.
  void look_at(std::span<const double> signal);

  /// The record, single upsets marked missing (NaN).
  [[nodiscard]] std::span<const double> signal() const {
    return steady_.empty() ? signal_ : std::span<const double>(steady_);
  }
  TestedSpectra(const TestedSpectra&) = delete;
  TestedSpectra& operator=(const TestedSpectra&) = delete;

  [[nodiscard]] const Bicoherence& bicoherence() const { return own_ ? *own_ : *published_; }
  /// Empty when the differences have too little left to estimate from.
  [[nodiscard]] std::span<const double> bic2() const { return bic2_; }
  [[nodiscard]] const Precautions& precautions() const { return precautions_; }
  /// `settings` with the overlap of the precautions.
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const Kernels& kernels() const { return *kernels_; }
  /// Set when the variance changes along the record.
  [[nodiscard]] const std::optional<SegmentLevels>& levels() const { return levels_; }

 private:
  void estimate();
  void unlock();
  void leave_out(const std::vector<std::size_t>& upsets);

  std::span<const double> signal_;
  std::vector<double> steady_;  // empty = signal_
  std::vector<double> differences_;
  Settings settings_;
  const Kernels* kernels_;
  Precautions precautions_;
  const Bicoherence* published_ = nullptr;
  std::optional<Bicoherence> own_;
  std::span<const double> bic2_;
  std::optional<SegmentLevels> levels_;
};

}  // namespace loopscope::core::hos
