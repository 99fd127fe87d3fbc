#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::storage {

/// An analysis as it stands in the results, with what it takes to do it again.
struct StoredAnalysis {
  CatalogueEntry loop;           ///< as the catalogue has it now
  std::int64_t slot_end_us = 0;  ///< microseconds UTC since 1970
  int algorithm_revision = 0;
  int input_revision = 0;  ///< 1 = no late rows so far
  std::string input_digest;
  std::string program_version;                  ///< with the processor path
  std::string settings_json;                    ///< the analysis settings, their keys in any order
  std::optional<core::signal::PvPast> pv_past;  ///< what was known of pv before the window
  bool modelled = false;                        ///< with a loop model
  /// What was measured and said: JSON object of the measured columns of `analysis`, and `verdict`,
  /// `peaks` and `steps` (arrays in the order of rank and step) without their keys.
  std::string figures_json;
};

/// Stored analyses, for those who do one again. One object = one connection; every function is one
/// transaction that writes nothing, and throws DatabaseError. Not shared between threads.
class AnalysisArchive {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit AnalysisArchive(const ConnectionSettings& settings);
  ~AnalysisArchive();

  /// nullopt = there is no analysis of that number.
  [[nodiscard]] std::optional<StoredAnalysis> find(std::int64_t analysis_id);
  /// The measured columns that a record would be stored with, as in StoredAnalysis::figures_json;
  /// by the same conversions, so that equal figures have equal words.
  [[nodiscard]] std::string measured_columns(const AnalysisRecord& record);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
