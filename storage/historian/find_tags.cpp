#include "storage/historian/find_tags.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "storage/array_literal.hpp"
#include "storage/historian/native_key.hpp"
#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using core::signal::Hold;

/// One id behind a name.
struct Id {
  std::string text;
  std::string hold_code;
};
using IdsByName = std::map<std::string, std::vector<Id>>;

/// The parts of a tag as it is written: those of the key, then the column of loop_row and wide
/// tables. Split from the right: what comes first is a plant's own name and may hold anything.
std::optional<std::vector<std::string>> split_tag(const SourceLayout& layout, std::string tag) {
  const std::size_t columns = layout.shape == Shape::narrow ? 0 : 1;
  std::vector<std::string> parts;
  while (parts.size() + 1 < layout.key.size() + columns) {
    const std::size_t at = tag.rfind(layout.separator);
    if (at == std::string::npos) return std::nullopt;
    parts.push_back(tag.substr(at + layout.separator.size()));
    tag.resize(at);
  }
  parts.push_back(tag);
  std::reverse(parts.begin(), parts.end());
  return parts;
}

/// "[provider]path" -> "path": Ignition's names have no provider before them. Tried only for names
/// that are not found as they are written.
std::string without_provider(const std::string& name) {
  const std::size_t end = name.starts_with('[') ? name.find(']') : std::string::npos;
  return end == std::string::npos ? name : name.substr(end + 1);
}

Hold hold_of(const HoldRule& rule, const std::string& code) {
  const auto among = [&code](const std::vector<std::string>& codes) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
  };
  if (among(rule.step_codes)) return Hold::step;
  return among(rule.linear_codes) ? Hold::linear : rule.usual;
}

class TagFinder {
 public:
  TagFinder(PqConnection& connection, const ResolvedLayout& layout)
      : connection_(connection), layout_(layout), ids_(layout.key.size()) {}

  std::vector<std::vector<TagPlace>> find(std::span<const std::string> tags) {
    std::vector<std::optional<std::vector<std::string>>> split;
    for (const std::string& tag : tags) split.push_back(split_tag(layout_.layout, tag));
    for (std::size_t part = 0; part < layout_.key.size(); ++part) {
      if (layout_.key[part].names) look_up(part, split);
    }
    std::vector<std::vector<TagPlace>> places;
    for (const auto& parts : split) {
      places.push_back(parts ? places_of(*parts) : std::vector<TagPlace>{});
    }
    return places;
  }

 private:
  void look_up(std::size_t part,
               const std::vector<std::optional<std::vector<std::string>>>& split) {
    std::set<std::string> names;
    for (const auto& parts : split) {
      if (parts && is_storable((*parts)[part])) names.insert((*parts)[part]);
    }
    find_names(part, names);
    std::set<std::string> paths;
    for (const std::string& name : names) {
      const std::string path = without_provider(name);
      if (path != name && !ids_[part].contains(name)) paths.insert(path);
    }
    find_names(part, paths);
  }

  void find_names(std::size_t part, std::set<std::string> names) {
    ask(part,
        historian_statements::find_ids(*layout_.key[part].names,
                                       layout_.layout.key[part].ignore_case),
        names);
    if (!layout_.layout.key[part].ignore_case) return;
    for (const auto& [name, ids] : ids_[part]) names.erase(name);
    // No index serves this one: only names that are written otherwise are left for it.
    ask(part, historian_statements::find_ids_in_any_case(*layout_.key[part].names), names);
  }

  void ask(std::size_t part, const Statement& statement, const std::set<std::string>& names) {
    if (names.empty()) return;
    ArrayLiteral wanted;
    for (const std::string& name : names) wanted.add_text(name);
    const PqRows rows = connection_.run(statement, {wanted.text()});
    for (int row = 0; row < rows.size(); ++row) {
      const auto id = native_key(rows.text(row, 1), layout_.key[part].type);
      if (id) ids_[part][rows.text(row, 0)].push_back({*id, rows.text(row, 2)});
    }
  }

  /// The ids of one part of a tag; a text in the form of an id stands for itself.
  [[nodiscard]] std::vector<Id> ids_of(std::size_t part, const std::string& text) const {
    const ResolvedKey& key = layout_.key[part];
    if (key.names) {
      for (const std::string& name : {text, without_provider(text)}) {
        const auto found = ids_[part].find(name);
        if (found != ids_[part].end()) return found->second;
      }
      if (key.type != "int8" && key.type != "uuid") return {};
    }
    const auto native = native_key(text, key.type);
    return native ? std::vector<Id>{{*native, ""}} : std::vector<Id>{};
  }

  [[nodiscard]] std::vector<TagPlace> places_of(const std::vector<std::string>& parts) const {
    std::vector<TagPlace> places{{{}, "", layout_.layout.hold.usual}};
    if (layout_.layout.shape != Shape::narrow) places.front().column = parts.back();
    for (std::size_t part = 0; part < layout_.key.size(); ++part) {
      std::vector<TagPlace> longer;
      for (const TagPlace& place : places) {
        for (const Id& id : ids_of(part, parts[part])) {
          longer.push_back(place);
          longer.back().key.push_back(id.text);
          if (!id.hold_code.empty())
            longer.back().hold = hold_of(layout_.layout.hold, id.hold_code);
        }
      }
      places = std::move(longer);
    }
    return places;
  }

  PqConnection& connection_;
  const ResolvedLayout& layout_;
  std::vector<IdsByName> ids_;  ///< per part of the key
};

}  // namespace

std::vector<std::vector<TagPlace>> find_tags(PqConnection& connection, const ResolvedLayout& layout,
                                             std::span<const std::string> tags) {
  return TagFinder(connection, layout).find(tags);
}

}  // namespace loopscope::storage
