#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// HTML with names in it, in the language Mustache. {{name}} is a text or a number, escaped by
/// html() whatever it holds, between tags and in double quotes; {{{name}}} is Markup and nothing
/// else. {{#name}} ... {{/name}} is shown for true, for a text or Markup that is not empty, for a
/// number, for Fields, and for each element of a list, {{.}} where it has no names; {{^name}} is
/// shown where that is not. A section's tag alone in its line is no line of the page, a backslash
/// at the end of a line joins it with the next one, and the last line break is left out. Partials,
/// other delimiters and {{&name}} are refused.
class Template {
 public:
  /// Throws std::logic_error for a text that does not parse; `name` is what errors call it.
  Template(std::string name, std::string_view text);
  ~Template();
  Template(Template&&) noexcept;
  Template& operator=(Template&&) = delete;
  Template(const Template&) = delete;
  Template& operator=(const Template&) = delete;

  /// Filled with `fields`, from any thread. Throws std::logic_error where a name that is asked for
  /// is missing or of another kind: text where Markup is wanted, or the other way round.
  [[nodiscard]] Markup render(Fields fields) const;

 private:
  struct Parsed;
  std::string name_;
  std::unique_ptr<Parsed> parsed_;
};

/// The template templates/NAME.html of this folder filled with `fields`; see Template::render().
/// All are parsed at the first call.
[[nodiscard]] Markup render(std::string_view name, Fields fields);

}  // namespace loopscope::daemon
