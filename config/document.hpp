#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "config/problem.hpp"

namespace loopscope::config {

/// JSON text with comments, read into a tree.
struct Document {
  nlohmann::ordered_json root;    ///< keys in the order of the file; of a repeated key the last
  std::vector<Problem> problems;  ///< repeated keys, or the one place where the syntax breaks
  bool readable = false;          ///< whether the syntax is right to the end
};

/// Reads the text. Problems of syntax carry "line L, column C" (counted from 1, in characters) and
/// never quote the text, which may hold a secret.
[[nodiscard]] Document read_document(std::string_view text);

/// The JSON path of a member: "/" and "~" inside the key are escaped (RFC 6901).
[[nodiscard]] std::string member_path(const std::string& parent, const std::string& key);

}  // namespace loopscope::config
