#pragma once

#include <string>
#include <vector>

#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// The policy of every page: no outside request whatever, pictures out of the page itself, and only
/// the style and the scripts that this program was built with.
[[nodiscard]] const std::string& content_security_policy();

/// What stands around the content of a page.
struct PageFrame {
  std::string title;
  std::vector<std::string> subtitle;  ///< time span and zone, in parts that no line breaks up
  bool navigation = false;            ///< with links to the live pages
  std::string zone = "UTC";           ///< name of the zone of all times, as TimeZone::name()
  bool trend = false;                 ///< with the script of a trend that can be zoomed
  /// Referrer-Policy. A form's page needs `same-origin`: under `no-referrer` browsers send
  /// "Origin: null" with its form.
  std::string referrer = "no-referrer";
};

/// A whole page in one file: head with its policy, style and script, `sections`, foot.
[[nodiscard]] std::string page(const PageFrame& frame, const std::vector<Markup>& sections);

}  // namespace loopscope::daemon
