#include "daemon/catalogue/tag_pattern.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

constexpr std::string_view kLoop = "{loop}";
constexpr std::string_view kRole = "{role}";
constexpr std::string_view kPartEnds = "./\\:";
constexpr std::string_view kSpecial = "{[*";

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), lower);
  return result;
}

/// A tag on trial, as it is and in lower case.
struct TagPattern::Attempt {
  std::string_view tag;
  std::string_view lower;
  std::span<const std::string> words;
  /// Which pieces are known not to fit from where on, by pieces left and place: without it a
  /// pattern of many * would try every way to share a tag out among them.
  std::vector<bool>& hopeless;
};

TagPattern::TagPattern(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) at = read_piece(text, at);
  require_both();
}

/// Appends the piece that begins at `at`; returns where the next one begins.
std::size_t TagPattern::read_piece(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with(kLoop)) {
    pieces_.push_back({Kind::loop, {}});
    return at + kLoop.size();
  }
  if (rest.starts_with(kRole)) {
    pieces_.push_back({Kind::role, {}});
    return at + kRole.size();
  }
  if (rest.front() == '{') {
    throw std::invalid_argument("only {loop} and {role} may stand in braces");
  }
  if (rest.front() == '*') {
    pieces_.push_back({Kind::part, {}});
    return at + 1;
  }
  if (rest.front() == '[') {
    const std::size_t end = rest.find(']');
    if (end == std::string_view::npos || end == 1) {
      throw std::invalid_argument("[ needs characters and a ]");
    }
    pieces_.push_back({Kind::one_of, lower_case(rest.substr(1, end - 1))});
    return at + end + 1;
  }
  const std::size_t length = std::min(rest.find_first_of(kSpecial), rest.size());
  pieces_.push_back({Kind::literal, lower_case(rest.substr(0, length))});
  return at + length;
}

void TagPattern::require_both() const {
  const auto require_one = [this](Kind kind, std::string_view name) {
    const auto count = std::ranges::count(pieces_, kind, &Piece::kind);
    if (count != 1) throw std::invalid_argument(fmt::format("{} has to stand in it once", name));
  };
  require_one(Kind::loop, kLoop);
  require_one(Kind::role, kRole);
}

/// The longest run first: names of loops may hold the separators themselves.
bool TagPattern::fits_run(const Attempt& attempt, std::span<const Piece> pieces, std::size_t at,
                          TagMatch& match) {
  const bool is_loop = pieces.front().kind == Kind::loop;
  const std::size_t end =
      is_loop ? attempt.tag.size()
              : std::min(attempt.tag.find_first_of(kPartEnds, at), attempt.tag.size());
  const std::size_t shortest = at + (is_loop ? 1 : 0);
  for (std::size_t stop = end + 1; stop-- > shortest;) {
    if (!fits(attempt, pieces.subspan(1), stop, match)) continue;
    if (is_loop) match.loop = attempt.tag.substr(at, stop - at);
    return true;
  }
  return false;
}

bool TagPattern::fits_role(const Attempt& attempt, std::span<const Piece> pieces, std::size_t at,
                           TagMatch& match) {
  for (const std::string& word : attempt.words) {
    if (!attempt.lower.substr(at).starts_with(word)) continue;
    if (!fits(attempt, pieces.subspan(1), at + word.size(), match)) continue;
    match.word = attempt.tag.substr(at, word.size());
    return true;
  }
  return false;
}

bool TagPattern::fits(const Attempt& attempt, std::span<const Piece> pieces, std::size_t at,
                      TagMatch& match) {
  if (pieces.empty()) return at == attempt.tag.size();
  const std::size_t trial = pieces.size() * (attempt.tag.size() + 1) + at;
  if (attempt.hopeless[trial]) return false;
  const bool fit = fits_piece(attempt, pieces, at, match);
  attempt.hopeless[trial] = !fit;
  return fit;
}

bool TagPattern::fits_piece(const Attempt& attempt, std::span<const Piece> pieces, std::size_t at,
                            TagMatch& match) {
  const Piece& piece = pieces.front();
  const std::string_view rest = attempt.lower.substr(at);
  switch (piece.kind) {
    case Kind::loop:
    case Kind::part:
      return fits_run(attempt, pieces, at, match);
    case Kind::role:
      return fits_role(attempt, pieces, at, match);
    case Kind::one_of:
      return !rest.empty() && piece.text.find(rest.front()) != std::string::npos &&
             fits(attempt, pieces.subspan(1), at + 1, match);
    case Kind::literal:
      return rest.starts_with(piece.text) &&
             fits(attempt, pieces.subspan(1), at + piece.text.size(), match);
  }
  return false;
}

std::optional<TagMatch> TagPattern::match(std::string_view tag,
                                          std::span<const std::string> words) const {
  const std::string lower = lower_case(tag);
  TagMatch match;
  std::vector<bool> hopeless((pieces_.size() + 1) * (tag.size() + 1));
  if (!fits({tag, lower, words, hopeless}, pieces_, 0, match)) return std::nullopt;
  return match;
}

}  // namespace loopscope::daemon
