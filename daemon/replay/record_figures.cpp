#include "daemon/replay/record_figures.hpp"

#include <optional>

#include "daemon/output/analysis_json.hpp"

namespace loopscope::daemon {
namespace {

nlohmann::json number(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json peaks_json(const core::Evidence& evidence) {
  nlohmann::json peaks = nlohmann::json::array();
  if (!evidence.hos) return peaks;
  for (const core::hos::Peak& peak : evidence.hos->peaks) {
    peaks.push_back({{"f1", peak.f1}, {"f2", peak.f2}, {"bic2", peak.bic2}, {"p", number(peak.p)}});
  }
  return peaks;
}

}  // namespace

nlohmann::json record_figures(const storage::AnalysisRecord& record,
                              const std::string& measured_columns) {
  nlohmann::json figures = nlohmann::json::parse(measured_columns);
  figures["verdict"] = verdict_json(record.diagnosis.verdict);
  // The verdict follows from them, and of their parts only the probabilities are stored, rounded.
  figures["verdict"].erase("causes");
  figures["peaks"] = peaks_json(record.diagnosis.evidence);
  figures["steps"] = record.model_json.empty()
                         ? nlohmann::json::array()
                         : nlohmann::json::parse(record.model_json).at("steps");
  return figures;
}

}  // namespace loopscope::daemon
