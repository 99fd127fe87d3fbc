#include "daemon/output/write_file.hpp"

#include "daemon/output/output_file.hpp"

namespace loopscope::daemon {

void write_file(const std::filesystem::path& file, const std::string& content) {
  OutputFile output(file);
  output.write(content);
  output.finish();
}

}  // namespace loopscope::daemon
