#pragma once
/// The words after the name of a program of the tests, and how such a program ends.

#include <charconv>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace loopscope::tests {

/// A command line that cannot be understood; the message names the word.
struct WrongUsage : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

class CommandWords {
 public:
  explicit CommandWords(const std::vector<std::string>& words) : words_(words) {}

  [[nodiscard]] bool done() const { return place_ == words_.size(); }
  const std::string& next() { return words_.at(place_++); }

  /// The word behind `option`.
  const std::string& value(const std::string& option) {
    if (done()) throw WrongUsage(option + " lacks a value");
    return next();
  }

  /// The same as a number; `wanted` says which.
  template <typename Number>
  Number number(const std::string& option, const std::string& wanted) {
    const std::string& text = value(option);
    Number result{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (error != std::errc() || end != text.data() + text.size())
      throw WrongUsage(option + " wants " + wanted + ", not " + text);
    return result;
  }

  std::uint64_t count(const std::string& option, std::uint64_t least) {
    const std::string wanted = "a number of at least " + std::to_string(least);
    const auto result = number<std::uint64_t>(option, wanted);
    if (result < least)
      throw WrongUsage(option + " wants " + wanted + ", not " + std::to_string(result));
    return result;
  }

 private:
  const std::vector<std::string>& words_;
  std::size_t place_ = 0;
};

struct CannotWrite : std::runtime_error {
  explicit CannotWrite(const std::string& file) : std::runtime_error("cannot write, " + file) {}
};

/// A file of what `write` puts into a stream.
template <typename Write>
void write_file(const std::string& name, const Write& write) {
  std::ofstream file(name);
  write(file);
  file.close();
  if (!file) throw CannotWrite(name);
}

/// main(): `run` is given the words. 0 done, 1 fault, 2 wrong usage.
template <typename Run>
int run_program(int argc, char** argv, const Run& run) try {
  run(std::vector<std::string>(argv + 1, argv + argc));
  std::cout.flush();
  if (!std::cout) throw CannotWrite("standard output");
  return 0;
} catch (const WrongUsage& wrong) {
  std::cerr << "error: " << wrong.what() << "\nHINT: --help shows the options\n";
  return 2;
} catch (const CannotWrite& fault) {
  std::cerr << "error: " << fault.what()
            << "\nHINT: name a file in a folder that is there, may be written and has room\n";
  return 1;
} catch (const std::exception& fault) {
  std::cerr << "error: " << fault.what() << "\n";
  return 1;
}

}  // namespace loopscope::tests
