#include "config/read_value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "config/connection_secret.hpp"
#include "config/nearest_name.hpp"
#include "config/number_text.hpp"

namespace loopscope::config {

namespace {

using Json = nlohmann::ordered_json;

Problem wrong_kind(const Json& value, const std::string& path, const std::string& wanted) {
  std::string hint;
  if (value.is_null()) hint = "leave the key out for its default";
  if (value.is_string()) hint = "write it without quotes";
  if (value.is_number()) hint = "write it in quotes";
  return {path, "is " + kind_of(value) + ", not " + wanted, hint};
}

/// Why a number is refused; empty when it is accepted.
std::string complaint_about(double number, const Limits& limits, bool whole) {
  const std::string text = number_text(number);
  if (number < limits.low || number > limits.high)
    return text + " is out of range, " + limits_text(limits);
  if (whole && std::trunc(number) != number)
    return text + " is not a whole number, " + limits_text(limits);
  if (limits.even && std::fmod(number, 2.0) != 0.0) return text + " is odd, " + limits_text(limits);
  return {};
}

void read_number(const Json& value, const std::string& path, const Limits& limits,
                 const SettingTarget& target, ProblemList& problems) {
  const bool whole = takes_whole_numbers(target);
  if (!value.is_number()) {
    problems.add(
        wrong_kind(value, path, (whole ? "a whole number, " : "a number, ") + limits_text(limits)));
    return;
  }
  const auto number = value.get<double>();
  const std::string complaint = complaint_about(number, limits, whole);
  if (complaint.empty())
    store_number(target, number);
  else
    problems.add({path, complaint, {}});
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
  });
}

std::optional<Problem> refuse_word(const std::string& word, const std::string& path,
                                   const Limits& limits) {
  const std::vector<std::string> known(limits.words.begin(), limits.words.end());
  if (std::find(known.begin(), known.end(), word) != known.end()) return std::nullopt;
  const auto nearest = nearest_name(word, known);
  return Problem{path, Json(word).dump() + " is none of " + limits_text(limits),
                 nearest ? "did you mean \"" + *nearest + "\"?" : ""};
}

/// Texts of connections are never quoted in a message: they may hold what they should not.
std::optional<Problem> refuse_text(const std::string& text, const std::string& path,
                                   const Limits& limits) {
  if (limits.form == Form::choice) return refuse_word(text, path, limits);
  if (text.empty() && !may_be_empty(limits.form))
    return Problem{path, "is empty",
                   is_connection(limits.form) ? "a libpq connection string, e.g. \"service=plant\""
                                              : "leave the key out for its default"};
  if (has_control_character(text)) return Problem{path, "holds a control character", {}};
  if (is_connection(limits.form) && holds_secret(text))
    return Problem{path, "holds a password",
                   "move it to ~/.pgpass, or to pg_service.conf and write \"service=NAME\""};
  if (is_connection(limits.form) && has_text_for_port(text))
    return Problem{path, "has a text where a port should be",
                   "postgresql://USER@HOST:PORT/DATABASE, and a password belongs to ~/.pgpass"};
  return std::nullopt;
}

void read_text(const Json& value, const std::string& path, const Limits& limits,
               const SettingTarget& target, ProblemList& problems) {
  if (!value.is_string()) {
    const bool choice = limits.form == Form::choice;
    problems.add(wrong_kind(value, path, (choice ? "one of " : "a ") + limits_text(limits)));
    return;
  }
  const auto text = value.get<std::string>();
  if (auto problem = refuse_text(text, path, limits))
    problems.add(std::move(*problem));
  else
    store_text(target, text);
}

void read_switch(const Json& value, const std::string& path, const Limits& limits,
                 const SettingTarget& target, ProblemList& problems) {
  if (value.is_boolean()) {
    store_switch(target, value.get<bool>());
    return;
  }
  Problem problem = wrong_kind(value, path, limits_text(limits));
  if (value.is_number()) problem.hint = "true switches it on, false off";
  problems.add(std::move(problem));
}

/// The text that an element of a list stands for; nullopt when it is neither text nor number.
std::optional<std::string> element_text(const Json& element) {
  if (element.is_string()) return element.get<std::string>();
  if (element.is_number()) return number_text(element.get<double>());
  return std::nullopt;
}

bool is_number_text(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

std::optional<Problem> refuse_element(const std::string& text, const std::string& path, Form form) {
  if (text.empty()) return Problem{path, "is empty", "leave it out of the list"};
  if (has_control_character(text)) return Problem{path, "holds a control character", {}};
  if (form == Form::numbers && !is_number_text(text))
    return Problem{path, Json(text).dump() + " is not a number", {}};
  const std::size_t equals = text.rfind('=');
  const bool state = equals != std::string::npos && equals > 0 &&
                     is_number_text(std::string_view(text).substr(equals + 1));
  if (form == Form::states && !state)
    return Problem{path, Json(text).dump() + " is not TEXT=NUMBER", R"(e.g. "RUNNING=1")"};
  return std::nullopt;
}

void read_list(const Json& value, const std::string& path, const Limits& limits,
               const SettingTarget& target, ProblemList& problems) {
  if (!value.is_array()) {
    problems.add({path, "is " + kind_of(value) + ", not a " + limits_text(limits),
                  "put it into brackets: [ ... ]"});
    return;
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string place = path + "/" + std::to_string(i);
    const auto text = element_text(value[i]);
    if (!text) {
      problems.add({place, "is " + kind_of(value[i]) + ", not a text or a number", {}});
    } else if (auto problem = refuse_element(*text, place, limits.form)) {
      problems.add(std::move(*problem));
    } else {
      texts.push_back(*text);
    }
  }
  if (texts.size() == value.size()) store_list(target, std::move(texts));
}

}  // namespace

void read_value(const Json& value, const std::string& path, const Limits& limits,
                const SettingTarget& target, ProblemList& problems) {
  if (limits.form == Form::number)
    read_number(value, path, limits, target, problems);
  else if (limits.form == Form::toggle)
    read_switch(value, path, limits, target, problems);
  else if (is_list(limits.form))
    read_list(value, path, limits, target, problems);
  else
    read_text(value, path, limits, target, problems);
}

std::string kind_of(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  if (value.is_string()) return "a text";
  if (value.is_number()) return "a number";
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  return "null";
}

}  // namespace loopscope::config
