#include "config/number_text.hpp"

#include <iomanip>
#include <locale>
#include <sstream>

namespace loopscope::config {

std::string number_text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());  // a host's locale must not put points into thousands
  text << std::setprecision(15) << value;
  return text.str();
}

}  // namespace loopscope::config
