#include "daemon/replay/record_figures.hpp"

#include <optional>

namespace loopscope::daemon {
namespace {

using Json = nlohmann::json;

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json verdict_json(const core::diagnosis::Verdict& verdict) {
  return {{"code", core::diagnosis::name(verdict.code)},
          {"confidence", verdict.confidence},
          {"p", number(verdict.p)},
          {"summary", verdict.summary},
          {"reasons", verdict.reasons},
          {"action", verdict.action}};
}

Json peaks_json(const core::Evidence& evidence) {
  Json peaks = Json::array();
  if (!evidence.hos) return peaks;
  for (const core::hos::Peak& peak : evidence.hos->peaks) {
    peaks.push_back({{"f1", peak.f1}, {"f2", peak.f2}, {"bic2", peak.bic2}, {"p", number(peak.p)}});
  }
  return peaks;
}

}  // namespace

Json record_figures(const storage::AnalysisRecord& record, const std::string& measured_columns) {
  Json figures = Json::parse(measured_columns);
  figures["verdict"] = verdict_json(record.diagnosis.verdict);
  figures["peaks"] = peaks_json(record.diagnosis.evidence);
  figures["steps"] =
      record.model_json.empty() ? Json::array() : Json::parse(record.model_json).at("steps");
  return figures;
}

}  // namespace loopscope::daemon
