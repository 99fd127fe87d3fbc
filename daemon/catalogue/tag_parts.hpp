#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

namespace loopscope::daemon {

/// What a tag says by itself: the name of something, a word for a role, perhaps an ending that says
/// "value".
struct TagParts {
  std::string stem;    ///< as the tag spells it: "Area1/FIC101", "FIC101.PIDA"; not empty
  std::string word;    ///< the role, plain_word(): "pv", "spwrk"
  std::string behind;  ///< what stands behind the stem with {} for the role, lower case: ".{}.cv"
  bool glued;          ///< nothing stands between stem and role: FIC209PV
};

/// Lower case without `_`, `-` and blanks: SP_WRK, SpWrk and "sp wrk" are one word.
[[nodiscard]] std::string plain_word(std::string_view word);

/// Words as plain_word() gives them.
using PlainWords = std::unordered_set<std::string>;

/// Reads a tag from its end: endings that stand for the value itself (.CV, #Value, ,Value, .F_CV)
/// are left out first, as many as leave a role. The role is the whole part behind the last `.`,
/// `/`, `\`, `:` or other mark, or stands in that part behind a `_`, `-` or blank, or, behind a
/// number, behind nothing (FIC209PV). nullopt when there is no role, or no name before it. A part
/// before `_` that is itself a limit or a role makes it none: SP_H, HI_SP, MAN_OP.
[[nodiscard]] std::optional<TagParts> split_tag(std::string_view tag, const PlainWords& words);

/// Bytes of a tag without endings that stand for its value: "FT-210.Value" -> 6.
[[nodiscard]] std::size_t without_endings(std::string_view tag);

/// The last part of a path, behind its last mark but `_`, `-` and blanks.
[[nodiscard]] std::string_view last_part(std::string_view path);

/// The path before its last part and the marks between; empty = there is only one part.
[[nodiscard]] std::string_view before_last_part(std::string_view path);

/// Whether a path names no controller by its last part or what stands there behind the last `_`:
/// limits and alarms (HI, ALM), totals (TOT), means (AVG), blocks of inputs and outputs (AI1).
[[nodiscard]] bool names_no_controller(std::string_view path);

/// Whether a part of a path is the controller's block within a module: PID, PID1, PIDA, CTRL_PID.
[[nodiscard]] bool is_controller_block(std::string_view part);

}  // namespace loopscope::daemon
