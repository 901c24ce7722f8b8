# lift_slam_add_library(NAME [SOURCES ...] [PUBLIC libs ...] [PRIVATE libs ...])
#   The library of one folder: target lift_slam_NAME, lift_slam::NAME once installed. Without sources it is
#   header-only.
# lift_slam_add_test(NAME [SOURCES ...] [LIBRARIES ...])
#   One test program of one folder: target lift_slam_NAME_test; each case is a ctest test.
# lift_slam_add_executable(NAME [SOURCES ...] [LIBRARIES ...])

function(lift_slam_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target lift_slam_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} lift_slam_options)
    target_link_libraries(${target} PUBLIC Eigen3::Eigen)
    target_compile_definitions(${target} PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
    target_link_libraries(${target} INTERFACE ${ARG_PUBLIC} Eigen3::Eigen)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
endfunction()

function(lift_slam_add_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} lift_slam_options)
  if(LIFT_SLAM_SANITIZER)
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/sanitizer_suppressions.cc)
  endif()
endfunction()

function(lift_slam_add_test name)
  if(NOT LIFT_SLAM_BUILD_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(target lift_slam_${name}_test)
  lift_slam_add_executable(${target} SOURCES ${ARG_SOURCES}
    LIBRARIES ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  if(LIFT_SLAM_SANITIZER STREQUAL "thread")
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/single_threaded_opencv.cc)
    target_link_libraries(${target} PRIVATE opencv_core)
  endif()
  gtest_discover_tests(${target} TEST_PREFIX ${name}/ DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600 ENVIRONMENT "LIFT_SLAM_SOURCE_DIR=${PROJECT_SOURCE_DIR}")
endfunction()
