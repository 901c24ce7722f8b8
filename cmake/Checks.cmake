# The checks of the tree itself, as ctest tests beside the others.
if(LIFT_SLAM_BUILD_TESTS)
  add_test(NAME tools/layers COMMAND ${PROJECT_SOURCE_DIR}/tools/check_layers)
  add_test(NAME tools/layers_self_test COMMAND ${PROJECT_SOURCE_DIR}/tools/check_layers --self-test)
  add_test(NAME tools/names COMMAND ${PROJECT_SOURCE_DIR}/tools/check_names)
  add_test(NAME tools/names_self_test COMMAND ${PROJECT_SOURCE_DIR}/tools/check_names --self-test)
  add_test(NAME tools/format COMMAND ${PROJECT_SOURCE_DIR}/tools/format)
endif()
