#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// What a pattern found in a tag.
struct TagMatch {
  std::string loop;
  std::string word;  ///< the role as the tag spells it: "PV", "meas"
};

/// How a site names the tags of a loop:
///
/// | piece | matches |
/// |---|---|
/// | `{loop}` | the name of the loop: one or more of any character, as many as possible |
/// | `{role}` | a word for a role, whatever its case |
/// | `*` | characters of one part of the name: none of `. / \ :` |
/// | `[./_]` | one of these characters |
/// | anything else | itself, whatever its case |
///
/// The whole tag has to fit: `{loop}/*/{role}.CV` takes `FIC101/PID1/PV.CV` apart into FIC101 and
/// PV.
class TagPattern {
 public:
  /// Throws std::invalid_argument: `{loop}` or `{role}` is missing or there twice, a bracket is
  /// open, a placeholder is unknown.
  explicit TagPattern(std::string_view text);

  /// nullopt when the tag does not fit. `words` are in lower case.
  [[nodiscard]] std::optional<TagMatch> match(std::string_view tag,
                                              std::span<const std::string> words) const;

 private:
  enum class Kind { literal, one_of, part, loop, role };
  struct Piece {
    Kind kind;
    std::string text;  ///< of a literal (lower case) or the characters of a set
  };
  struct Attempt;

  std::size_t read_piece(std::string_view text, std::size_t at);
  void require_both() const;
  [[nodiscard]] static bool fits(const Attempt& attempt, std::span<const Piece> pieces,
                                 std::size_t at, TagMatch& match);
  [[nodiscard]] static bool fits_piece(const Attempt& attempt, std::span<const Piece> pieces,
                                       std::size_t at, TagMatch& match);
  [[nodiscard]] static bool fits_run(const Attempt& attempt, std::span<const Piece> pieces,
                                     std::size_t at, TagMatch& match);
  [[nodiscard]] static bool fits_role(const Attempt& attempt, std::span<const Piece> pieces,
                                      std::size_t at, TagMatch& match);

  std::vector<Piece> pieces_;
};

/// ASCII letters in lower case: tags of one loop differ in case between systems.
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace loopscope::daemon
