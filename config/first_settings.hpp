#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"

namespace loopscope::config {

/// What a site needs to begin with.
struct FirstSettings {
  std::string results;             ///< connection string of the worker
  std::string owner;               ///< of the schema's owner
  std::string engineer;            ///< of people who annotate, offered as a comment
  HistorianSettings historian;     ///< with its connection
  std::vector<std::string> notes;  ///< on the historian, for whoever reviews the file: a line each
};

/// A commented settings file: the connections, and of the historian what differs from its preset.
[[nodiscard]] std::string first_settings_text(const FirstSettings& first);

}  // namespace loopscope::config
