// Feeds every file of a folder to a fuzz target: the seeds as an ordinary test, built by any
// compiler, so that targets do not rot.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

// What CMakeLists.txt calls LLVMFuzzerTestOneInput of each target (target.hpp).
#define TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef TARGET

namespace {

struct Target {
  std::string_view name;
  int (*run)(const std::uint8_t*, std::size_t);
};

#define TARGET(name) Target{#name, fuzz_##name},
constexpr std::array kTargets{
#include "fuzz_targets.inc"
};
#undef TARGET

namespace fs = std::filesystem;

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

int usage(const char* program) {
  std::fprintf(stderr, "usage: %s TARGET FILE or FOLDER\ntargets:", program);
  for (const Target& target : kTargets) std::fprintf(stderr, " %s", target.name.data());
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return usage(arguments[0]);
  const std::string_view name = arguments[1];
  const auto target = std::ranges::find(kTargets, name, &Target::name);
  if (target == kTargets.end()) return usage(arguments[0]);
  const std::vector<fs::path> files = inputs_of(arguments[2]);
  for (const fs::path& file : files) {
    // The name first: a property that does not hold ends the process.
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    const std::vector<char> bytes = bytes_of(file);
    target->run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 1 : 0;
}
