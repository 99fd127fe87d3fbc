#include "daemon/catalogue/tag_parts.hpp"

#include <algorithm>
#include <array>

#include "daemon/catalogue/tag_pattern.hpp"
#include "daemon/text/ascii.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::string_view kSoft = "_- ";

bool is_soft(char c) {
  return kSoft.find(c) != std::string_view::npos;
}

/// What parts of a path stand between. Bytes above ASCII are letters of some language.
bool is_mark(char c) {
  return static_cast<unsigned char>(c) < 0x80 && !is_ascii_digit(c) && !is_ascii_letter(c) &&
         !is_soft(c);
}

std::string_view without_marks_behind(std::string_view text) {
  while (!text.empty() && is_mark(text.back())) text.remove_suffix(1);
  return text;
}

/// Without the one character that parts a name from what follows, or `"."`: what else stands there
/// is the name's own.
std::string_view without_separator(std::string_view text) {
  const bool quoted = text.size() > 3 && text.ends_with('"') && text[text.size() - 3] == '"';
  if (quoted) return text.substr(0, text.size() - 3);
  if (!text.empty() && (is_soft(text.back()) || is_mark(text.back()))) text.remove_suffix(1);
  return text;
}

std::size_t last_part_begins(std::string_view path) {
  std::size_t begin = path.size();
  while (begin > 0 && !is_mark(path[begin - 1])) --begin;
  return begin;
}

template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 14> kEndings{
    "value",   "val",          "cv",           "fcv",      "actual",      "act", "cur",
    "current", "currentvalue", "presentvalue", "actvalue", "actualvalue", "f",   "online"};
constexpr std::array<std::string_view, 2> kSoftEndings{"value", "val"};

/// The text without one ending; as it is when it has none, or is nothing else.
std::string_view without_ending(std::string_view text) {
  const std::string_view body = without_marks_behind(text);
  const std::size_t begin = last_part_begins(body);
  if (begin == 0 || !is_one_of(kEndings, plain_word(body.substr(begin)))) return text;
  const std::string_view rest = without_marks_behind(body.substr(0, begin));
  return rest.empty() ? text : rest;
}

constexpr std::array<std::string_view, 10> kRolesThemselves{"pv", "sp", "sv",  "op",  "mv",
                                                            "co", "cv", "out", "man", "ext"};

constexpr std::array<std::string_view, 47> kNoController{
    "h",         "hh",        "hi",     "hihi",  "high",  "l",      "ll",        "lo",
    "lolo",      "low",       "lim",    "limit", "hilim", "lolim",  "hlim",      "llim",
    "alm",       "alarm",     "alarms", "dev",   "trip",  "tot",    "total",     "totalizer",
    "totaliser", "totalized", "sum",    "acc",   "accum", "count",  "counter",   "avg",
    "average",   "mean",      "min",    "max",   "std",   "stddev", "monanalog", "monanl",
    "ain",       "aout",      "valve",  "vlv",   "motor", "sim",    "simulation"};

constexpr std::array<std::string_view, 4> kInputsAndOutputs{"ai", "ao", "di", "do"};

/// AI, AI1, AO_2: a block's number has one or two digits, an instrument's more.
bool is_input_or_output(std::string_view part) {
  std::string plain = plain_word(part);
  std::size_t digits = 0;
  for (; !plain.empty() && is_ascii_digit(plain.back()); plain.pop_back()) ++digits;
  return digits <= 2 && is_one_of(kInputsAndOutputs, plain);
}

/// The word, or as it is without its number: VALVE2. One or two letters with a number may be
/// anything: L2.
bool is_no_controller(std::string_view part) {
  std::string plain = plain_word(part);
  if (is_one_of(kNoController, plain)) return true;
  while (!plain.empty() && is_ascii_digit(plain.back())) plain.pop_back();
  return plain.size() > 2 && is_one_of(kNoController, plain);
}

/// What stands behind the last `_`, `-` or blank.
std::string_view last_token(std::string_view part) {
  const std::size_t soft = part.find_last_of(kSoft);
  return soft == std::string_view::npos ? part : part.substr(soft + 1);
}

/// Longer ones are no words: what is looked for in a long tag costs no more than its length.
constexpr std::size_t kLongestWord = 64;

/// Where a word that ends with the text may begin within its last part.
std::size_t earliest_word(std::string_view text, std::size_t part) {
  return std::max(part + 1, text.size() - std::min(text.size(), kLongestWord));
}

/// A role within a tag.
struct RolePlace {
  std::size_t stem_size, begin, size;
};

/// Behind a `_`, `-` or blank within the part: the longest word first.
std::optional<RolePlace> behind_soft(std::string_view body, std::size_t part,
                                     const PlainWords& words) {
  for (std::size_t k = earliest_word(body, part); k + 1 < body.size(); ++k) {
    if (!is_soft(body[k])) continue;
    const std::string word = plain_word(body.substr(k + 1));
    if (!words.contains(word)) continue;
    const std::string_view stem = body.substr(0, k);
    const std::string_view before = last_token(stem.substr(std::min(part, stem.size())));
    if (before.empty() || is_one_of(kRolesThemselves, plain_word(before)) ||
        is_no_controller(before))
      return std::nullopt;
    return RolePlace{stem.size(), k + 1, body.size() - k - 1};
  }
  return std::nullopt;
}

/// FIC209A: letters, a number, perhaps a letter that is no limit.
bool may_be_glued(std::string_view name) {
  name = name.substr(name.size() - std::min(name.size(), kLongestWord));
  if (name.empty()) return false;
  const char last = lower_case(name.substr(name.size() - 1)).front();
  if (last >= 'a' && last <= 'g') name.remove_suffix(1);
  return !name.empty() && is_ascii_digit(name.back()) && std::ranges::any_of(name, is_ascii_letter);
}

std::optional<RolePlace> behind_number(std::string_view body, std::size_t part,
                                       const PlainWords& words) {
  constexpr std::size_t kShortest = 2;
  for (std::size_t k = earliest_word(body, part); k + kShortest <= body.size(); ++k) {
    if (!may_be_glued(body.substr(part, k - part))) continue;
    if (words.contains(lower_case(body.substr(k)))) return RolePlace{k, k, body.size() - k};
  }
  return std::nullopt;
}

std::optional<RolePlace> role_of(std::string_view body, const PlainWords& words) {
  const std::size_t part = last_part_begins(body);
  const std::string_view stem = without_separator(body.substr(0, part));
  if (!stem.empty() && words.contains(plain_word(body.substr(part))))
    return RolePlace{stem.size(), part, body.size() - part};
  if (const auto soft = behind_soft(body, part, words)) return soft;
  return behind_number(body, part, words);
}

/// Also before an ending behind `_`: FIC101_PV_VAL.
std::optional<RolePlace> role_in(std::string_view text, const PlainWords& words) {
  const std::string_view body = without_marks_behind(text);
  if (const auto role = role_of(body, words)) return role;
  const std::size_t soft = body.find_last_of(kSoft);
  const bool has_ending = soft != std::string_view::npos && soft > last_part_begins(body) &&
                          is_one_of(kSoftEndings, plain_word(body.substr(soft + 1)));
  return has_ending ? role_of(body.substr(0, soft), words) : std::nullopt;
}

}  // namespace

std::string plain_word(std::string_view word) {
  std::string plain = lower_case(word);
  std::erase_if(plain, is_soft);
  return plain;
}

std::optional<TagParts> split_tag(std::string_view tag, const PlainWords& words) {
  std::optional<RolePlace> found;
  for (std::string_view text = tag;;) {
    // The shortest text that has a role counts: in FIC101/PV.CV it is PV, in FIC101/CV it is CV.
    if (const auto role = role_in(text, words)) found = role;
    const std::string_view shorter = without_ending(text);
    if (shorter.size() == text.size()) break;
    text = shorter;
  }
  if (!found) return std::nullopt;
  const std::size_t end = found->begin + found->size;
  return TagParts{std::string(tag.substr(0, found->stem_size)),
                  plain_word(tag.substr(found->begin, found->size)),
                  lower_case(tag.substr(found->stem_size, found->begin - found->stem_size)) + "{}" +
                      lower_case(tag.substr(end)),
                  found->stem_size == found->begin};
}

std::size_t without_endings(std::string_view tag) {
  for (std::string_view text = tag;;) {
    const std::string_view shorter = without_ending(text);
    if (shorter.size() == text.size()) return text.size();
    text = shorter;
  }
}

std::string_view last_part(std::string_view path) {
  return path.substr(last_part_begins(path));
}

std::string_view before_last_part(std::string_view path) {
  return without_separator(path.substr(0, last_part_begins(path)));
}

bool names_no_controller(std::string_view path) {
  const std::string_view part = last_part(path);
  return is_no_controller(part) || is_no_controller(last_token(part)) || is_input_or_output(part);
}

bool is_controller_block(std::string_view part) {
  constexpr std::array<std::string_view, 6> kBlocks{"ctrl",       "ctrlpid", "control",
                                                    "controller", "regler",  "reg"};
  const std::string plain = plain_word(part);
  return plain.starts_with("pid") || is_one_of(kBlocks, plain);
}

}  // namespace loopscope::daemon
