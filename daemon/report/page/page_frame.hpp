#pragma once

#include <string>

namespace loopscope::daemon {

/// The policy of every page: no outside request whatever, pictures out of the page itself, and only
/// the style and the script that this program was built with.
[[nodiscard]] const std::string& content_security_policy();

/// What stands around the content of a page.
struct PageFrame {
  std::string title;       ///< plain text
  std::string subtitle;    ///< plain text: time span and zone
  std::string navigation;  ///< HTML; empty = none
};

/// A whole page in one file: head with its policy, style and script, `content` (HTML), foot.
[[nodiscard]] std::string page(const PageFrame& frame, const std::string& content);

}  // namespace loopscope::daemon
