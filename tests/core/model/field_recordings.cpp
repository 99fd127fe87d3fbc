#include "tests/core/model/field_recordings.hpp"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace loopscope::tests::model {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

double number_of(const std::vector<std::string>& fields, std::size_t i) {
  if (i >= fields.size() || fields[i].empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::strtod(fields[i].c_str(), nullptr);
}

std::ifstream opened(const std::string& path) {
  std::ifstream file(path);
  if (!file.is_open()) throw std::invalid_argument("cannot read " + path);
  return file;
}

/// Columns t_s, sp, pv, op.
void read_samples(const std::string& path, FieldRecording& recording) {
  std::ifstream file = opened(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fields_of(line);
    recording.sp.push_back(number_of(fields, 1));
    recording.pv.push_back(number_of(fields, 2));
    recording.op.push_back(number_of(fields, 3));
  }
  if (recording.pv.empty()) throw std::invalid_argument("no samples in " + path);
}

}  // namespace

std::vector<FieldRecording> recordings_of(const std::string& manifest) {
  std::vector<FieldRecording> recordings;
  const std::string folder = manifest.substr(0, manifest.find_last_of('/') + 1);
  std::ifstream list = opened(manifest);
  std::string line;
  std::getline(list, line);
  while (std::getline(list, line)) {
    // The first six columns hold no quoted commas.
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() < 6) continue;
    FieldRecording recording{fields[0], fields[1], fields[2], fields[5], {}, {}, {}};
    read_samples(folder + fields[0], recording);
    recordings.push_back(std::move(recording));
  }
  return recordings;
}

std::vector<FieldRecording> field_recordings() {
  const char* folder = std::getenv("LOOPSCOPE_RECORDINGS");
  return folder == nullptr ? std::vector<FieldRecording>{}
                           : recordings_of(std::string(folder) + "/manifest.csv");
}

}  // namespace loopscope::tests::model
