#include "storage/startup_options.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace loopscope::storage {
namespace {

bool is_blank(char character) {
  return std::isspace(static_cast<unsigned char>(character)) != 0;
}

/// Blanks separate; a backslash takes the next character as it is.
std::vector<std::string> split_words(const std::string& options) {
  std::vector<std::string> words;
  bool in_word = false;
  for (std::size_t at = 0; at < options.size(); ++at) {
    if (is_blank(options[at])) {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (options[at] == '\\' && at + 1 < options.size()) ++at;
    words.back() += options[at];
  }
  return words;
}

void append_word(std::string& options, const std::string& word) {
  if (!options.empty()) options += ' ';
  for (const char character : word) {
    if (is_blank(character) || character == '\\') options += '\\';
    options += character;
  }
}

/// The server's rule: dashes of a name stand for underscores, and its case does not matter.
std::string setting_name(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char character) {
    return character == '-' ? '_' : static_cast<char>(std::tolower(character));
  });
  return name;
}

bool take_assignment(const std::string& text, SessionSettings& settings) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return false;
  settings[setting_name(text.substr(0, equals))] = text.substr(equals + 1);
  return true;
}

}  // namespace

StartupOptions split_startup_options(const std::string& options) {
  StartupOptions split;
  const std::vector<std::string> words = split_words(options);
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::string& word = words[at];
    const bool apart = word == "-c" && at + 1 < words.size();
    if (apart && take_assignment(words[at + 1], split.settings)) {
      ++at;
    } else if (apart || !(word.starts_with("-c") || word.starts_with("--")) ||
               !take_assignment(word.substr(2), split.settings)) {
      append_word(split.rest, word);
    }
  }
  return split;
}

}  // namespace loopscope::storage
