#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/coupling/segment_levels.hpp"

namespace loopscope::core::hos {

/// What a record needs before its bicoherence may be tested.
struct Precautions {
  /// The spectrum falls so steeply that its low end leaks over everything: the differences are
  /// tested. A linear filter changes no bicoherence.
  bool differenced = false;
  double overlap = 0.5;  ///< of segments, 0 to 0.9; not the settings' where a line is locked
};

/// The record and its squared bicoherence as the tests look at them: the published one where
/// nothing speaks against it, else one of the same record taken with precautions.
class TestedSpectra {
 public:
  /// `published` holds the last estimate, of `signal` with its own settings; all outlive this.
  TestedSpectra(std::span<const double> signal, const Bicoherence& published,
                std::span<const double> published_bic2, const Settings& settings);

  /// The same of a record that nothing is published of, in the memory of `workspace`, which is made
  /// for the same settings.
  TestedSpectra(std::span<const double> signal, Bicoherence& workspace, const Settings& settings);

  TestedSpectra(const TestedSpectra&) = delete;
  TestedSpectra& operator=(const TestedSpectra&) = delete;

  /// The record as it was given.
  [[nodiscard]] std::span<const double> recorded() const { return recorded_; }
  /// The record, single upsets marked missing (NaN).
  [[nodiscard]] std::span<const double> signal() const {
    return steady_.empty() ? recorded_ : std::span<const double>(steady_);
  }
  [[nodiscard]] const Bicoherence& bicoherence() const { return own_ ? *own_ : *published_; }
  /// Over the principal domain; empty when fewer than two segments, or no power, are left.
  [[nodiscard]] std::span<const double> bic2() const { return bic2_; }
  [[nodiscard]] const Precautions& precautions() const { return precautions_; }
  /// Those given, with the overlap of the precautions.
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const Kernels& kernels() const { return *kernels_; }
  /// Set when the variance changes along the record; the spectra are divided by them then.
  [[nodiscard]] const std::optional<SegmentLevels>& levels() const { return levels_; }

 private:
  void take_precautions();
  void transform();
  void unlock();
  void leave_out(const std::vector<std::size_t>& upsets);
  [[nodiscard]] bool has_segments() const { return bicoherence().segments() >= 2; }

  std::span<const double> recorded_;
  std::vector<double> steady_;  // empty = recorded_
  std::vector<double> differences_;
  Settings settings_;
  const Kernels* kernels_;
  Precautions precautions_;
  const Bicoherence* published_ = nullptr;
  Bicoherence* workspace_ = nullptr;
  std::optional<Bicoherence> made_;  // where there is no workspace, or one of another overlap
  Bicoherence* own_ = nullptr;       // of the two, with this record's spectra
  std::span<const double> bic2_;
  std::optional<SegmentLevels> levels_;
};

}  // namespace loopscope::core::hos
