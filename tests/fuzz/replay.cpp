// Feeds every file of a folder to a fuzz target: the seeds as an ordinary test, built by any
// compiler, so that targets do not rot.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;
namespace fuzz = loopscope::tests::fuzz;

struct Target {
  std::string_view name;
  int (*run)(const std::uint8_t* data, std::size_t size);
};

constexpr std::array kTargets = {
    Target{"analyze", fuzz::fuzz_analyze},
    Target{"array_literal", fuzz::fuzz_array_literal},
    Target{"binary_array", fuzz::fuzz_binary_array},
    Target{"catalogue", fuzz::fuzz_catalogue},
    Target{"discovery", fuzz::fuzz_discovery},
    Target{"historian_rows", fuzz::fuzz_historian_rows},
    Target{"recording", fuzz::fuzz_recording},
    Target{"settings", fuzz::fuzz_settings},
    Target{"window", fuzz::fuzz_window},
};

const Target* target_of(std::string_view name) {
  const auto* const found = std::ranges::find(kTargets, name, &Target::name);
  return found == kTargets.end() ? nullptr : found;
}

std::vector<fs::path> inputs_of(const char* place) {
  if (fs::is_regular_file(place)) return {place};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<char> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int replay(const Target& target, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    // The name first: a property that does not hold ends the process.
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    const std::vector<char> bytes = bytes_of(file);
    target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 1 : 0;
}

}  // namespace

int main(int count, char** arguments) try {
  const Target* const target = count == 3 ? target_of(arguments[1]) : nullptr;
  if (target == nullptr) {
    std::fprintf(stderr, "usage: %s TARGET FILE|FOLDER\ntargets:", arguments[0]);
    for (const Target& one : kTargets) std::fprintf(stderr, " %s", one.name.data());
    std::fprintf(stderr, "\n");
    return 2;
  }
  return replay(*target, inputs_of(arguments[2]));
} catch (const fs::filesystem_error& error) {
  std::fprintf(stderr, "error: %s\nHINT: name a file or folder of inputs\n", error.what());
  return 2;
}
