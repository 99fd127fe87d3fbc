#include "daemon/recording/column_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

using Word = std::pair<std::string_view, std::string_view>;

/// Words as they are left by bare(). No single letter: W, X and Y are signals to some and places to
/// others. No "status" for the quality: a wrong one would discard every sample.
constexpr auto kWords = std::to_array<Word>({
    {"timestamp", "time"},
    {"datetime", "time"},
    {"dateandtime", "time"},
    {"time", "time"},
    {"timeutc", "time"},
    {"utctime", "time"},
    {"zeit", "time"},
    {"zeitstempel", "time"},
    {"datumzeit", "time"},
    {"datumuhrzeit", "time"},
    {"pv", "pv"},
    {"processvariable", "pv"},
    {"processvalue", "pv"},
    {"istwert", "pv"},
    {"sp", "sp"},
    {"setpoint", "sp"},
    {"setpt", "sp"},
    {"sv", "sp"},
    {"sollwert", "sp"},
    {"op", "op"},
    {"out", "op"},
    {"output", "op"},
    {"co", "op"},
    {"controlleroutput", "op"},
    {"controloutput", "op"},
    {"stellwert", "op"},
    {"stellgr\xC3\xB6\xC3\x9F"
     "e",
     "op"},
    {"stellgroesse", "op"},
    {"mv", "mv"},
    {"valveposition", "mv"},
    {"ventilstellung", "mv"},
    {"mode", "mode"},
    {"betriebsart", "mode"},
    {"quality", "quality"},
});

/// Seconds, told from a date and clock by their unit.
constexpr auto kSeconds = std::to_array<std::string_view>(
    {"times", "timesec", "timeseconds", "timeinseconds", "zeits", "seconds", "sekunden"});

constexpr std::string_view kBetween = ". _-:/\\";

/// In lower case without brackets and what stands between words.
std::string bare(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (kBetween.find(c) != std::string_view::npos) continue;
    if (std::string_view("()[]{}").find(c) != std::string_view::npos) continue;
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

/// "PV [m3/h]" without its unit.
std::string_view without_unit(std::string_view name) {
  name = trimmed(name);
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return name;
  const std::size_t open = name.find_last_of("[(");
  return open == std::string_view::npos ? name : trimmed(name.substr(0, open));
}

std::string_view role_of(std::string_view word) {
  const std::string text = bare(word);
  const auto* const found = std::ranges::find(kWords, text, &Word::first);
  return found == kWords.end() ? std::string_view() : found->second;
}

}  // namespace

std::optional<NamedColumn> read_column_name(std::string_view name) {
  if (std::ranges::find(kSeconds, bare(name)) != kSeconds.end()) return NamedColumn{"t_s", ""};
  name = without_unit(name);
  if (const std::string_view role = role_of(name); !role.empty()) return NamedColumn{role, ""};
  // Behind the loop's name as many words as make one: "FIC101 process value", "FIC-101.PV".
  for (std::size_t k = 1; k + 1 < name.size(); ++k) {
    if (kBetween.find(name[k]) == std::string_view::npos) continue;
    const std::string_view role = role_of(name.substr(k + 1));
    if (!role.empty()) return NamedColumn{role, bare(name.substr(0, k))};
  }
  return std::nullopt;
}

}  // namespace loopscope::daemon
