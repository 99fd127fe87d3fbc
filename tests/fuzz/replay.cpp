// Feeds every file of a folder to a fuzz target: the seeds as an ordinary test, built by any
// compiler, so that targets do not rot.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/target.hpp"

namespace {

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

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: %s FILE or FOLDER\n", arguments[0]);
    return 2;
  }
  const std::vector<fs::path> files = inputs_of(arguments[1]);
  for (const fs::path& file : files) {
    // The name first: a property that does not hold ends the process.
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    const std::vector<char> bytes = bytes_of(file);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 1 : 0;
}
