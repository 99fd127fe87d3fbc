#include "daemon/report/figures/compact_svg.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace loopscope::daemon {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// From `first` to the end of the next `last`.
void drop(std::string& svg, std::string_view first, std::string_view last) {
  const std::size_t begin = svg.find(first);
  const std::size_t end = svg.find(last, std::min(begin, svg.size()));
  if (end != std::string::npos) svg.erase(begin, end + last.size() - begin);
}

/// Every run of blanks becomes one.
std::string with_single_blanks(std::string_view text) {
  std::string shorter;
  for (const char c : text) {
    const bool blank = kBlanks.find(c) != std::string_view::npos;
    if (!blank)
      shorter += c;
    else if (!shorter.empty() && shorter.back() != ' ')
      shorter += ' ';
  }
  return shorter;
}

void drop_empty_groups(std::string& svg) {
  constexpr std::string_view kEnd = "</g>";
  for (std::size_t at = svg.find("<g "); at != std::string::npos; at = svg.find("<g ", at)) {
    const std::size_t content = std::min(svg.find('>', at), svg.size() - 1) + 1;
    const std::size_t inside = svg.find_first_not_of(' ', content);
    if (inside != std::string::npos && svg.compare(inside, kEnd.size(), kEnd) == 0)
      svg.erase(at, inside + kEnd.size() - at);
    else
      at = content;
  }
}

/// "481.18" as "481.2", "64.01" as "64".
std::string to_a_tenth(std::string_view number) {
  double value = 0.0;
  std::from_chars(number.data(), number.data() + number.size(), value);
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

/// The data of one path: commands and numbers need no blank between them.
std::string short_path(std::string_view data) {
  std::string path;
  for (std::size_t at = 0; at < data.size();) {
    const std::size_t number = data.find_first_of("-0123456789.", at);
    const std::string_view between = data.substr(at, number - at);
    std::ranges::copy_if(between, std::back_inserter(path),
                         [](char c) { return kBlanks.find(c) == std::string_view::npos; });
    if (number == std::string_view::npos) break;
    const std::size_t end = std::min(data.find_first_not_of("-0123456789.", number), data.size());
    path += to_a_tenth(data.substr(number, end - number));
    at = end;
  }
  return path;
}

std::string with_short_paths(std::string_view svg) {
  constexpr std::string_view kData = " d='";
  std::string text;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t found = svg.find(kData, at);
    const std::size_t begin = std::min(found, svg.size() - kData.size()) + kData.size();
    if (found == std::string_view::npos) return text.append(svg.substr(at));
    const std::size_t end = std::min(svg.find('\'', begin), svg.size());
    text.append(svg.substr(at, begin - at)).append(short_path(svg.substr(begin, end - begin)));
    at = end;
  }
  return text;
}

}  // namespace

std::string compact_svg(std::string_view document) {
  std::string svg(document.substr(std::min(document.find("<svg"), document.size())));
  drop(svg, "<title>", "</desc>");
  drop(svg, "<defs>", "</defs>");  // marks for points, of which this program's pictures have none
  replace_all(svg, "currentColor", "black");
  replace_all(svg, "font-family=\"Arial\"", "");
  replace_all(svg, "<svg ", "<svg font-family=\"Arial,Liberation Sans,DejaVu Sans,sans-serif\" ");
  svg = with_single_blanks(svg);
  drop_empty_groups(svg);
  return with_short_paths(svg);
}

Markup svg_uri(std::string_view svg) {
  std::string uri = "data:image/svg+xml,";
  for (const char c : svg) {
    if (c == '"')
      uri += '\'';
    else if (std::string_view("%#<>& ").find(c) != std::string_view::npos)
      fmt::format_to(std::back_inserter(uri), "%{:02X}", static_cast<unsigned char>(c));
    else
      uri += c;
  }
  return Markup(std::move(uri));
}

}  // namespace loopscope::daemon
