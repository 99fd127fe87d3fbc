#include "daemon/catalogue/instrument_name.hpp"

#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

#include "daemon/catalogue/tag_pattern.hpp"
#include "daemon/text/ascii.hpp"

namespace loopscope::daemon {
namespace {

std::string upper_case(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// Takes the longest of these away from the front, if there is one of them.
template <std::size_t n>
bool take(std::string_view& rest, const std::array<std::string_view, n>& longest_first) {
  for (const std::string_view part : longest_first) {
    if (!rest.starts_with(part)) continue;
    rest.remove_prefix(part.size());
    return true;
  }
  return false;
}

constexpr std::array<std::string_view, 8> kShowing{"QIR", "IR", "RI", "QI", "IQ", "QR", "I", "R"};
constexpr std::array<std::string_view, 1> kTotalling{"Q"};
constexpr std::array<std::string_view, 8> kLimits{"HHH", "LLL", "HH", "LL", "HL", "LH", "H", "L"};
constexpr std::array<std::string_view, 3> kAlarms{"A", "S", "Z"};

/// Nothing, or alarms and switches with what they stand at: "A", "AHL", "SLL", "ASH".
bool only_alarms(std::string_view rest) {
  while (take(rest, kAlarms)) take(rest, kLimits);
  return rest.empty();
}

std::optional<InstrumentKind> kind_of(std::string_view functions) {
  if (functions.empty()) return std::nullopt;
  std::string_view rest = functions;
  const bool shown = take(rest, kShowing) || take(rest, kTotalling);
  if (rest == "T" || rest == "E") return InstrumentKind::transmitter;
  if (rest.starts_with('C') && only_alarms(rest.substr(1))) return InstrumentKind::controller;
  if (only_alarms(rest) && (shown || !rest.empty())) {
    return functions.front() == 'Z' ? InstrumentKind::other : InstrumentKind::indicator;
  }
  for (const std::string_view element : {"V", "CV", "Y", "IY", "G", "ZT", "ZI", "K", "VI"}) {
    if (functions == element) return InstrumentKind::other;
  }
  return std::nullopt;
}

/// Number and suffix behind the letters that end at `at`; moves `at` behind them.
void read_number(std::string_view path, std::size_t& at, InstrumentName& name) {
  std::size_t from = at;
  if (from < path.size() && (path[from] == '-' || path[from] == '_' || path[from] == ' ')) ++from;
  std::size_t end = from;
  while (end < path.size() && is_ascii_digit(path[end])) ++end;
  if (end == from) return;
  name.number = path.substr(from, end - from);
  constexpr std::size_t kLongestSuffix = 2;
  std::size_t last = end;
  while (last < path.size() && is_ascii_letter(path[last])) ++last;
  if (last - end <= kLongestSuffix) {
    name.suffix = lower_case(path.substr(end, last - end));
    end = last;
  }
  at = end;
}

std::optional<InstrumentName> name_at(std::string_view path, std::size_t begin, std::size_t end) {
  auto letters = instrument_letters(path.substr(begin, end - begin));
  if (!letters) return std::nullopt;
  InstrumentName name{{}, std::move(*letters), {}, {}, false};
  read_number(path, end, name);
  if (name.number.empty() && (begin == 0 || !is_ascii_digit(path[begin - 1]))) return std::nullopt;
  name.ends_path = end == path.size();
  return name;
}

}  // namespace

std::optional<InstrumentLetters> instrument_letters(std::string_view letters) {
  constexpr std::size_t kShortest = 2, kLongest = 6;
  if (letters.size() < kShortest || letters.size() > kLongest) return std::nullopt;
  const std::string upper = upper_case(letters);
  const bool modified = upper.size() > 2 && (upper[1] == 'D' || upper[1] == 'F');
  const std::size_t measured = modified ? 2 : 1;
  const auto kind = kind_of(std::string_view(upper).substr(measured));
  if (!kind) return std::nullopt;
  return InstrumentLetters{upper.substr(0, measured), *kind};
}

std::optional<InstrumentName> instrument_name(std::string_view path) {
  std::optional<InstrumentName> found;
  std::size_t place = 0;
  for (std::size_t begin = 0; begin < path.size();) {
    std::size_t end = begin;
    while (end < path.size() && is_ascii_letter(path[end])) ++end;
    if (auto name = name_at(path, begin, end)) {
      found = std::move(name);
      place = begin;
    }
    begin = end == begin ? end + 1 : end;
  }
  if (found) found->place = lower_case(path.substr(0, place));
  return found;
}

}  // namespace loopscope::daemon
