#include "tests/daemon/report/markup.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace loopscope::daemon {
namespace {

constexpr std::array kEmptyElements{"img", "input", "meta", "link", "!DOCTYPE", "br"};

/// A tag without the values of its attributes, which may hold anything in quotes.
std::string without_values(const std::string& html, std::size_t& at) {
  std::string tag;
  for (char quote = '\0'; at < html.size(); ++at) {
    const char c = html[at];
    if (quote == '\0' && c == '>') break;
    if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
    } else if (quote == c) {
      quote = '\0';
    } else if (quote == '\0') {
      tag += c;
    }
  }
  return tag;
}

std::string element(const std::string& tag) {
  return tag.substr(0, tag.find_first_of(" \n"));
}

}  // namespace

std::vector<std::string> tags_of(const std::string& html) {
  std::vector<std::string> tags;
  for (std::size_t at = 0; (at = html.find('<', at)) != std::string::npos;) {
    ++at;
    tags.push_back(without_values(html, at));
  }
  return tags;
}

std::string words_of(const std::string& html) {
  constexpr std::array kWithinALine{"bdi", "b", "i", "a", "td", "th", "rect"};
  std::string words;
  const auto at_start = [&words] { return words.empty() || words.ends_with('\n'); };
  const auto end_line = [&] {
    while (words.ends_with(' ') || words.ends_with('|')) words.pop_back();
    if (!at_start()) words += '\n';
  };
  const auto space = [&] {
    if (!at_start() && !words.ends_with(' ')) words += ' ';
  };
  for (std::size_t at = 0; at < html.size(); ++at) {
    if (html[at] == '<') {
      std::string name = element(without_values(html, ++at));
      if (name == "/td" || name == "/th") {
        while (words.ends_with(' ')) words.pop_back();
        words += " | ";
      }
      if (name.starts_with('/')) name.erase(0, 1);
      if (name == "span" || name == "small" || name == "svg")
        space();
      else if (std::ranges::find(kWithinALine, name) == kWithinALine.end())
        end_line();
    } else if (html[at] == '\n') {
      end_line();
    } else if (html[at] == ' ') {
      space();
    } else {
      words += html[at];
    }
  }
  end_line();
  return words;
}

std::string unbalanced(const std::string& html) {
  std::vector<std::string> open;
  for (const std::string& tag : tags_of(html)) {
    const std::string name = element(tag);
    if (std::ranges::find(kEmptyElements, name) != kEmptyElements.end()) continue;
    if (tag.ends_with('/')) continue;  // of a drawing
    if (!name.starts_with('/')) {
      open.push_back(name);
    } else if (open.empty() || "/" + open.back() != name) {
      return name;
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

}  // namespace loopscope::daemon
