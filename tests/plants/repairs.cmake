# Simulated repairs: the state before and after, diagnosed, stored, and the word of the view.
add_library(loopscope_repairs STATIC
  diagnose_repair.cpp paper_repairs.cpp repair.cpp repair_fault.cpp repair_score.cpp run_repairs.cpp
  store_repairs.cpp)
target_link_libraries(loopscope_repairs PUBLIC loopscope_effects_generator loopscope_daemon)

# A long run, started by hand or by `run`; no test runs it.
add_executable(plant_repairs plant_repairs.cpp)
target_link_libraries(plant_repairs PRIVATE loopscope_repairs loopscope_test_support)

add_executable(repairs_tests paper_repairs_test.cpp repair_score_test.cpp repair_test.cpp)
target_link_libraries(repairs_tests PRIVATE
  loopscope_repairs loopscope_test_support GTest::gmock GTest::gtest_main)
gtest_discover_tests(repairs_tests TEST_PREFIX repairs. DISCOVERY_TIMEOUT 60
  PROPERTIES TIMEOUT 600 FIXTURES_REQUIRED postgres LABELS server)
