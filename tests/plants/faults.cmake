# Plants of simulated loops with faults that nobody declares, and what the program makes of them.
add_library(loopscope_plants STATIC
  diagnosed_loop.cpp fault_kinds.cpp flags.cpp plant.cpp plant_faults_options.cpp plant_score.cpp
  score_text.cpp write_plant.cpp)
target_link_libraries(loopscope_plants PUBLIC
  loopscope_effects_runner loopscope_core nlohmann_json::nlohmann_json Threads::Threads)

add_executable(plant_faults plant_faults.cpp)
target_link_libraries(plant_faults PRIVATE loopscope_plants)

# Everything that `run` needs beside the program.
add_custom_target(plants_programs)
add_dependencies(plants_programs plant_faults)
foreach(other plant_sources plant_repairs)
  if(TARGET ${other})
    add_dependencies(plants_programs ${other})
  endif()
endforeach()

add_executable(plants_tests
  flags_test.cpp plant_faults_options_test.cpp plant_score_test.cpp plant_test.cpp
  reduced_plant_test.cpp score_text_test.cpp write_plant_test.cpp)
target_link_libraries(plants_tests PRIVATE loopscope_plants GTest::gmock GTest::gtest_main)
gtest_discover_tests(plants_tests TEST_PREFIX plants. DISCOVERY_TIMEOUT 60
  PROPERTIES TIMEOUT 600 LABELS plants)
