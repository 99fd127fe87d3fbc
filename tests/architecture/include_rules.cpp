#include "tests/architecture/include_rules.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>

#include "tests/architecture/rooms.hpp"

namespace loopscope::tests::architecture {

namespace {

/// Names that come with a harmless header and still reach outside of a computation.
constexpr std::array<std::string_view, 5> kImpureNames = {"random_device", "getenv", "std::rand(",
                                                          "std::srand(", "std::time("};

template <typename Range>
bool contains(const Range& range, std::string_view value) {
  return std::find(std::begin(range), std::end(range), value) != std::end(range);
}

bool is_excepted(std::string_view file, std::string_view header) {
  const auto all = exceptions();
  return std::any_of(all.begin(), all.end(), [&](const Exception& exception) {
    return exception.file == file && exception.header == header;
  });
}

/// Why a room may not include a header of the project; empty when it may.
std::string refuse_own(const Room& room, const std::string& header) {
  const Room* other = room_of(header);
  if (other == nullptr)
    return "\"" + header + "\" does not start at the root with the name of a room";
  const bool allowed = other == &room || std::any_of(room.rooms.begin(), room.rooms.end(),
                                                     [&](std::string_view lower) {
                                                       return lies_below(header, lower);
                                                     });
  if (allowed) return {};
  return std::string(room.path) + " may not use " + std::string(other->path) + " (" + header + ")";
}

/// Why a room may not include a header of a library or the system; empty when it may.
std::string refuse_foreign(const Room& room, const std::string& header) {
  const std::string_view library = library_of(header);
  if (!library.empty()) {
    if (contains(room.libraries, library)) return {};
    return std::string(room.path) + " may not use " + std::string(library) + " (" + header + ")";
  }
  const bool standard = header.find_first_of("./") == std::string::npos;
  const bool posix = header.ends_with(".h");
  if (room.pure ? is_pure_header(header) : standard || (posix && room.operating_system)) return {};
  if (standard || posix)
    return std::string(room.path) + " may not use <" + header + ">" +
           (room.pure ? ": core/ has no I/O, clock, log, thread or hidden randomness" : "");
  return "<" + header + "> belongs to no library that is known here";
}

std::string code_of(const std::string& line) {
  return line.substr(0, line.find("//"));
}

}  // namespace

std::optional<Include> include_of(const std::string& line) {
  static const std::regex include_line(R"(^\s*#\s*include\s*([<"])([^>"]*)[>"].*)");
  std::smatch match;
  if (!std::regex_match(line, match, include_line)) return std::nullopt;
  return Include{match[1] == "\"", match[2]};
}

std::vector<Violation> check_includes(const SourceFile& file) {
  std::vector<Violation> violations;
  const Room* room = room_of(file.path);
  if (room == nullptr) return violations;
  const std::vector<std::string> lines = lines_of(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto add = [&](const std::string& message) {
      if (!message.empty()) violations.push_back({file.path, i + 1, message});
    };
    if (const auto include = include_of(lines[i])) {
      if (!is_excepted(file.path, include->header))
        add(include->quoted ? refuse_own(*room, include->header)
                            : refuse_foreign(*room, include->header));
    } else if (room->pure) {
      for (const std::string_view name : kImpureNames)
        if (code_of(lines[i]).find(name) != std::string::npos)
          add(std::string(room->path) + " may not use " + std::string(name));
    }
  }
  return violations;
}

}  // namespace loopscope::tests::architecture
