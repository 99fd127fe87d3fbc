#include "daemon/commands/unknown_word.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <string_view>
#include <vector>

#include "config/nearest_name.hpp"

namespace loopscope::daemon {
namespace {

using Names = std::vector<std::string>;
using Chain = std::vector<const CLI::App*>;

/// The program and the commands that were named, each below the one before.
Chain named_commands(const CLI::App& program) {
  Chain chain{&program};
  while (true) {
    const auto below = chain.back()->get_subcommands();
    if (below.empty()) return chain;
    chain.push_back(below.front());
  }
}

std::string command_text(const Chain& chain) {
  std::string text;
  for (const CLI::App* command : chain) text += (text.empty() ? "" : " ") + command->get_name();
  return text;
}

/// A negative number is none, nor is the mark behind which there are none.
bool is_option(const std::string& word) {
  return word.size() > 1 && word.front() == '-' && word != "--" &&
         std::string_view("0123456789.").find(word[1]) == std::string_view::npos;
}

Names options_of(const Chain& chain) {
  Names names;
  for (const CLI::App* command : chain) {
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

Names commands_of(const CLI::App& command) {
  Names names;
  for (const CLI::App* below : command.get_subcommands({})) names.push_back(below->get_name());
  return names;
}

/// The one that is spelt nearly so, else those that begin so: "simul".
Names likely_names(const std::string& word, const Names& known) {
  if (auto nearest = config::nearest_name(word, known)) return {*std::move(nearest)};
  Names begun;
  std::ranges::copy_if(known, std::back_inserter(begun),
                       [&](const std::string& name) { return name.starts_with(word); });
  constexpr std::size_t kMost = 3;
  return begun.size() <= kMost ? begun : Names{};
}

std::string hint_for(const std::string& word, const Names& known, const std::string& command) {
  const Names likely = likely_names(word, known);
  const std::string all = command + " --help lists them";
  return likely.empty()
             ? all
             : fmt::format("did you mean \"{}\"? {}", fmt::join(likely, "\" or \""), all);
}

UnknownWord unknown_option(const std::string& word, const Chain& chain) {
  const std::string name = word.substr(0, word.find('='));
  const std::string command = command_text(chain);
  return {fmt::format("{} has no option \"{}\"", command, name),
          hint_for(name, options_of(chain), command)};
}

}  // namespace

std::optional<UnknownWord> find_unknown_word(const CLI::App& program) {
  const Chain chain = named_commands(program);
  for (const CLI::App* command : chain) {
    const Names left = command->remaining();
    if (left.empty()) continue;
    if (is_option(left.front())) return unknown_option(left.front(), chain);
    const Names known = commands_of(*chain.back());
    if (known.empty()) continue;
    const std::string text = command_text(chain);
    return UnknownWord{chain.size() == 1
                           ? fmt::format("unknown command \"{}\"", left.front())
                           : fmt::format("{} has no action \"{}\"", text, left.front()),
                       hint_for(left.front(), known, text)};
  }
  return std::nullopt;
}

}  // namespace loopscope::daemon
