#include "daemon/replay/compare_figures.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace loopscope::daemon {
namespace {

/// No matter of digits: numbers of opposite signs are 2 apart at most.
constexpr double kOtherThing = 3.0;

/// A sentence without its figures.
std::string without_digits(const std::string& text) {
  std::string words;
  std::ranges::copy_if(text, std::back_inserter(words), [](unsigned char c) {
    return std::isdigit(c) == 0 && c != '.' && c != '-' && c != '+' && c != 'e';
  });
  return words;
}

double difference(const nlohmann::json& before, const nlohmann::json& after) {
  if (before.is_number() && after.is_number()) {
    const double a = before.get<double>();
    const double b = after.get<double>();
    return a == b ? 0.0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  }
  if (before.is_string() && after.is_string() &&
      without_digits(before.get<std::string>()) == without_digits(after.get<std::string>()))
    return 0.0;
  return kOtherThing;
}

void take(FigureComparison& result, const std::string& name, const nlohmann::json& before,
          const nlohmann::json* after) {
  ++result.compared;
  if (after != nullptr && before == *after) return;
  ++result.different;
  const double relative = after == nullptr ? kOtherThing : difference(before, *after);
  if (!result.name.empty() && relative <= result.relative) return;
  result.name = name;
  result.before = before.dump();
  result.after = after == nullptr ? "nothing" : after->dump();
  result.relative = relative;
}

}  // namespace

FigureComparison compare_figures(const nlohmann::json& before, const nlohmann::json& after) {
  FigureComparison result;
  const nlohmann::json flat = before.flatten();
  const nlohmann::json other = after.flatten();
  for (const auto& [name, value] : flat.items()) {
    const auto found = other.find(name);
    take(result, name.substr(std::min<std::size_t>(1, name.size())), value,
         found == other.end() ? nullptr : &*found);
  }
  return result;
}

}  // namespace loopscope::daemon
