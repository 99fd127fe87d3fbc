#include "daemon/report/page/template.hpp"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <functional>
#include <kainjow/mustache.hpp>
#include <map>
#include <stdexcept>
#include <utility>
#include <variant>

#include "daemon/report/page/page_assets.hpp"
#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {
namespace {

namespace mustache = kainjow::mustache;
using Data = mustache::data;

/// In front of the names of sections and of Markup: the library asks for all of them in the same
/// way, and a text must not be found where Markup is wanted.
constexpr char kSection = '#';
constexpr char kMarkup = '<';

void mark(std::string& text, std::string_view opening, char kind) {
  for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    at += opening.size();
    text.insert(at, 1, kind);
  }
}

/// A section's tag alone in its line, which then is no line of the page. The library knows that of
/// sections that are shown only.
bool is_tag_of_a_section(std::string_view line) {
  return line.starts_with("{{") && line.find_first_of("#^/") == 2 &&
         line.find("}}") == line.size() - 2;
}

std::string lines_of_the_page(std::string_view text) {
  std::string joined;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.ends_with('\\'))
      joined += line.substr(0, line.size() - 1);
    else
      joined.append(line).append(is_tag_of_a_section(line) ? "" : "\n");
  }
  return joined;
}

std::string with_marked_names(std::string_view text) {
  std::string marked = lines_of_the_page(text);
  mark(marked, "{{{", kMarkup);
  for (const std::string_view opening : {"{{#", "{{^", "{{/"}) mark(marked, opening, kSection);
  return marked;
}

/// The library renders partials and changes of delimiters out of sight of what is checked here.
void refuse_what_is_not_ours(const std::string& name, std::string_view text) {
  for (const std::string_view opening : {"{{>", "{{&", "{{="})
    if (text.find(opening) != std::string_view::npos)
      throw std::logic_error(
          fmt::format("template {}: {} is not for templates of pages", name, opening));
}

/// How often a section of it is shown.
std::size_t times_shown(const Value& value) {
  if (const auto* list = std::get_if<List>(&value)) return list->size();
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? 1 : 0;
  if (const auto* text = std::get_if<std::string>(&value)) return text->empty() ? 0 : 1;
  if (const auto* markup = std::get_if<Markup>(&value)) return markup->html.empty() ? 0 : 1;
  return 1;
}

/// Where the library looks names up, since it takes one that is not there for nothing at all. It
/// wants values of its own kind: of a text it gets one when it asks, of a list one without content
/// for each element, whose address tells which element it means.
class Names final : public mustache::basic_context<std::string> {
 public:
  Names(const std::string& name, const Value& fields) : template_(name), scopes_{&fields} {}

  void push(const Data* data) override { scopes_.push_front(element_at(data)); }
  void pop() override {
    scopes_.pop_front();
    while (!lists_.empty() && lists_.front().depth > scopes_.size()) lists_.pop_front();
  }

  [[nodiscard]] const Data* get(const std::string& marked) const override {
    const bool section = marked.starts_with(kSection), markup = marked.starts_with(kMarkup);
    const std::string name = marked.substr(section || markup ? 1 : 0);
    if (section) return shown(find(name));
    answer_ = Data(markup ? markup_of(name) : text_of(name));
    return &answer_;
  }

  [[nodiscard]] const Data* get_partial(const std::string& name) const override {
    fail(name, "is a partial");
  }

 private:
  struct OpenList {
    const List* values;
    Data elements;
    std::size_t depth;  ///< of the section that holds it
  };

  [[nodiscard]] const Value& find(const std::string& name) const {
    if (name == ".") return *scopes_.front();
    for (const Value* scope : scopes_) {
      const auto* fields = std::get_if<Fields>(scope);
      if (fields == nullptr) continue;
      const auto found = std::ranges::find(*fields, name, &Field::name);
      if (found != fields->end()) return found->value;
    }
    fail(name, "is missing");
  }

  [[nodiscard]] const Data* shown(const Value& value) const {
    static const Data yes(true), no(false);
    const std::size_t times = times_shown(value);
    if (times == 0) return &no;
    const auto* list = std::get_if<List>(&value);
    if (list == nullptr) return &yes;
    lists_.push_front({list, Data(mustache::list(times, yes)), scopes_.size()});
    return &lists_.front().elements;
  }

  /// The element that the library means; where it means none, what was in force stays.
  [[nodiscard]] const Value* element_at(const Data* data) const {
    const std::less<> before;
    for (const OpenList& list : lists_) {
      const mustache::list& all = list.elements.list_value();
      if (!before(data, all.data()) && before(data, all.data() + all.size()))
        return &(*list.values)[static_cast<std::size_t>(data - all.data())];
    }
    return scopes_.front();
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    const Value& value = find(name);
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
    fail(name, "is no text");
  }

  [[nodiscard]] const std::string& markup_of(const std::string& name) const {
    const auto* markup = std::get_if<Markup>(&find(name));
    if (markup == nullptr) fail(name, "is no Markup");
    return markup->html;
  }

  [[noreturn]] void fail(const std::string& name, const char* what) const {
    throw std::logic_error(fmt::format("template {}: {} {}", template_, name, what));
  }

  const std::string& template_;
  std::deque<const Value*> scopes_;     ///< innermost first, as the lists
  mutable std::deque<OpenList> lists_;  ///< a deque, since the library keeps their addresses
  mutable Data answer_;                 ///< to the last question
};

/// What the library writes to.
struct Output {
  std::string text;
  Output& operator<<(const std::string& more) {
    text += more;
    return *this;
  }
};

using Templates = std::map<std::string, Template, std::less<>>;

Templates parsed_templates() {
  Templates all;
  for (const PageTemplate& asset : page_templates())
    all.emplace(asset.name, Template(asset.name, asset.text));
  return all;
}

}  // namespace

struct Template::Parsed {
  /// Rendering only reads it: what would write, partials and functions, no template here has.
  mutable mustache::mustache mustache;
};

Template::Template(std::string name, std::string_view text) : name_(std::move(name)) {
  refuse_what_is_not_ours(name_, text);
  parsed_ = std::make_unique<Parsed>(Parsed{mustache::mustache(with_marked_names(text))});
  if (!parsed_->mustache.is_valid())
    throw std::logic_error(
        fmt::format("template {}: {}", name_, parsed_->mustache.error_message()));
  parsed_->mustache.set_custom_escape([](const std::string& plain) { return html(plain); });
}

Template::~Template() = default;
Template::Template(Template&&) noexcept = default;

Markup Template::render(Fields fields) const {
  const Value values(std::move(fields));
  Names names(name_, values);
  Output output;
  parsed_->mustache.render(names, output);
  if (output.text.ends_with('\n')) output.text.pop_back();
  return Markup(std::move(output.text));
}

Markup render(std::string_view name, Fields fields) {
  static const Templates templates = parsed_templates();
  const auto found = templates.find(name);
  if (found == templates.end()) throw std::logic_error(fmt::format("no template {}", name));
  return found->second.render(std::move(fields));
}

}  // namespace loopscope::daemon
