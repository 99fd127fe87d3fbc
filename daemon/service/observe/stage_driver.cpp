#include "daemon/service/observe/stage_driver.hpp"

namespace loopscope::daemon {

double StageDriver::split(Stage stage) {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> passed = now - std::exchange(since_, now);
  if (stage != nullptr) cost_.*stage += passed.count();
  return std::chrono::duration<double, std::milli>(passed).count();
}

StageDriver::Unit::Unit(StageDriver& driver, Stage stage) : driver_(driver) {
  driver_.split(driver_.stage_);
  outer_ = std::exchange(driver_.stage_, stage);
  begun_ = driver_.since_;
}

StageDriver::Unit::~Unit() {
  driver_.split(driver_.stage_);
  driver_.stage_ = outer_;
  driver_.last_ms_ = std::chrono::duration<double, std::milli>(driver_.since_ - begun_).count();
  driver_.step_();
}

}  // namespace loopscope::daemon
