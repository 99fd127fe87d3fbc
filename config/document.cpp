#include "config/document.hpp"

#include <utility>

#include "config/syntax_problem.hpp"

namespace loopscope::config {

namespace {

using Json = nlohmann::ordered_json;

/// The settings nest three deep. Without a bound, a file of brackets alone would make paths as long
/// as itself at every one of its levels.
constexpr std::size_t kDeepest = 16;

/// Builds the tree from the parser's events. The library's own tree builder keeps the last of two
/// equal keys without a word; this one reports them.
class TreeBuilder final : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(std::string_view text, Document& document) : text_(text), document_(document) {}

  bool null() override { return place(Json()); }
  bool boolean(bool value) override { return place(value); }
  bool number_integer(number_integer_t value) override { return place(value); }
  bool number_unsigned(number_unsigned_t value) override { return place(value); }
  bool number_float(number_float_t value, const string_t&) override { return place(value); }
  bool string(string_t& value) override { return place(std::move(value)); }
  bool binary(binary_t& value) override { return place(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Container& container = open_.back();
    container.key = std::move(name);
    container.member_path = member_path(container.path, container.key);
    if (container.node->contains(container.key))
      document_.problems.push_back(
          {container.member_path, "is given more than once", "keep one of them"});
    return true;
  }

  bool parse_error(std::size_t characters_read, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    document_.problems.push_back(syntax_problem(text_, characters_read, token, error.what()));
    return false;
  }

 private:
  struct Container {
    Json* node;
    std::string path;
    std::string key;          ///< of the member that comes next; objects only
    std::string member_path;  ///< of that member
  };

  bool place(Json value) {
    add(std::move(value));
    return true;
  }

  bool open(Json container) {
    std::string path = next_path();
    if (open_.size() == kDeepest) {
      document_.problems.push_back({path, "is nested too deeply", {}});
      return false;
    }
    Json* node = add(std::move(container));
    open_.push_back({node, std::move(path), {}, {}});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  [[nodiscard]] std::string next_path() const {
    if (open_.empty()) return {};
    const Container& container = open_.back();
    return container.node->is_array()
               ? container.path + "/" + std::to_string(container.node->size())
               : container.member_path;
  }

  /// Pointers to open containers stay valid: only the innermost one grows.
  Json* add(Json value) {
    if (open_.empty()) {
      document_.root = std::move(value);
      return &document_.root;
    }
    Json& node = *open_.back().node;
    if (node.is_array()) {
      node.push_back(std::move(value));
      return &node.back();
    }
    return &(node[open_.back().key] = std::move(value));
  }

  std::string_view text_;
  Document& document_;
  std::vector<Container> open_;
};

}  // namespace

Document read_document(std::string_view text) {
  Document document;
  TreeBuilder builder(text, document);
  constexpr bool kStrict = true;
  constexpr bool kIgnoreComments = true;
  document.readable =
      Json::sax_parse(text, &builder, Json::input_format_t::json, kStrict, kIgnoreComments);
  return document;
}

std::string member_path(const std::string& parent, const std::string& key) {
  std::string path = parent + "/";
  for (const char c : key) {
    if (c == '~')
      path += "~0";
    else if (c == '/')
      path += "~1";
    else
      path += c;
  }
  return path;
}

}  // namespace loopscope::config
