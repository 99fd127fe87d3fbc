#include "config/setting_target.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace loopscope::config::tests {
namespace {

TEST(SettingTarget, WhatIsStoredIsWhatIsRead) {
  double real = 0.0;
  std::size_t count = 0;
  std::string text;
  store_number(&real, 0.1);
  store_number(&count, 4096.0);
  store_text(&text, "plant");
  EXPECT_EQ(target_value(&real).dump(), "0.1");
  EXPECT_EQ(target_value(&count).dump(), "4096");
  EXPECT_EQ(target_value(&text).dump(), "\"plant\"");
  EXPECT_TRUE(takes_whole_numbers(&count));
  EXPECT_FALSE(takes_whole_numbers(&real));
}

TEST(SettingTarget, WindowShapesGoByTheirNames) {
  core::hos::WindowShape shape{};
  for (const core::hos::WindowShape wanted : kWindowShapes) {
    store_text(&shape, std::string(core::hos::name(wanted)));
    EXPECT_EQ(shape, wanted);
    EXPECT_EQ(target_value(&shape), core::hos::name(wanted));
  }
  EXPECT_THROW(store_text(&shape, "square"), std::logic_error);
  // core/hos knows no shape beyond those listed here
  EXPECT_THROW(static_cast<void>(core::hos::name(core::hos::WindowShape{kWindowShapes.size()})),
               std::invalid_argument);
}

TEST(SettingTarget, SwitchesAreOnOrOff) {
  bool on = false;
  store_switch(&on, true);
  EXPECT_TRUE(on);
  EXPECT_EQ(target_value(&on).dump(), "true");
  EXPECT_FALSE(takes_whole_numbers(&on));
}

TEST(SettingTarget, NumbersTextsAndSwitchesDoNotMix) {
  double real = 0.0;
  std::string text;
  bool on = true;
  EXPECT_THROW(store_number(&on, 1.0), std::logic_error);
  EXPECT_THROW(store_text(&on, "true"), std::logic_error);
  EXPECT_THROW(store_switch(&real, true), std::logic_error);
  EXPECT_THROW(store_switch(&text, true), std::logic_error);
  EXPECT_THROW(store_number(&text, 1.0), std::logic_error);
  EXPECT_THROW(store_text(&real, "1"), std::logic_error);
}

}  // namespace
}  // namespace loopscope::config::tests
