#include "tests/fuzz/check_diagnosis.hpp"

#include <cmath>
#include <string_view>

#include "core/diagnosis/loop_state.hpp"
#include "daemon/output/analysis_text.hpp"
#include "tests/fuzz/require.hpp"

namespace loopscope::tests::fuzz {
namespace {

using Json = nlohmann::ordered_json;

bool is_probability(std::string_view key) {
  return key == "p" || key == "confidence" || key.ends_with("_p") || key.ends_with("_fraction");
}

void check_number(const std::string& path, std::string_view key, double value) {
  require(std::isfinite(value), path + " is finite");
  if (is_probability(key)) require(value >= 0.0 && value <= 1.0, path + " lies within 0 and 1");
  if (key == "f1" || key == "f2") require(value >= 0.0 && value <= 0.5, path + " is a frequency");
}

void check_tree(const std::string& path, std::string_view key, const Json& node) {
  if (node.is_number()) check_number(path, key, node.get<double>());
  if (node.is_object())
    for (const auto& [name, member] : node.items()) check_tree(path + "/" + name, name, member);
  if (node.is_array())
    for (const Json& element : node) check_tree(path + "/-", key, element);
}

void check_verdict(const core::Diagnosis& diagnosis) {
  const core::diagnosis::Verdict& verdict = diagnosis.verdict;
  const auto word = core::diagnosis::name(verdict.code);
  require(core::diagnosis::verdict_code(word) == verdict.code, "the verdict is of the closed list");
  require(!verdict.summary.empty(), "a verdict has a summary");
  const core::signal::DataQuality& quality = diagnosis.evidence.data_quality;
  const bool refused = verdict.code == core::diagnosis::VerdictCode::insufficient_data;
  const bool state =
      core::diagnosis::state_of(diagnosis.evidence) != core::diagnosis::LoopState::none;
  require(quality.usable || refused || state, "what cannot be judged is not judged");
  require(!state || !refused, "a state that is seen is said");
  require(quality.usable == quality.reason.empty(), "a refusal has its reason");
}

}  // namespace

std::string check_diagnosis(const daemon::InputFacts& input, const core::Diagnosis& diagnosis) {
  const Json object = daemon::analysis_json(input, diagnosis);
  check_tree("", "", object);
  check_verdict(diagnosis);
  std::string text = daemon::json_text(object);
  require(daemon::json_text(Json::parse(text)) == text, "the JSON comes back from its text");
  require(!daemon::analysis_text("title", 1.0, diagnosis).empty(), "a page for a terminal");
  return text;
}

}  // namespace loopscope::tests::fuzz
