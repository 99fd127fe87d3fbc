#pragma once

#include <string>
#include <vector>

namespace loopscope::daemon {

/// The names of all tags of a page in their order, "/p" for the end of one, with the names of their
/// attributes: what a browser would build. A reader of its own, so that the program does not check
/// itself.
[[nodiscard]] std::vector<std::string> tags_of(const std::string& html);

/// What a person reads of it: a line for each block and for each row of a table, "cell | cell".
[[nodiscard]] std::string words_of(const std::string& html);

/// The first tag that is not closed in its turn; empty = all are.
[[nodiscard]] std::string unbalanced(const std::string& html);

}  // namespace loopscope::daemon
