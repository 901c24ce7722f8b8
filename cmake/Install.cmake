# `cmake --install build/release --prefix PREFIX`: the program, what ships with it, and the library for
# find_package(lift_slam). A prefix may be moved afterwards: the program finds its files beside itself.
include(CMakePackageConfigHelpers)

# What a program of one's own links: runs, what they read, and what is made of them.
add_library(lift_slam_all INTERFACE)
target_link_libraries(lift_slam_all INTERFACE
  lift_slam_slam lift_slam_datasets lift_slam_evaluation lift_slam_visualization)
set_target_properties(lift_slam_all PROPERTIES EXPORT_NAME lift_slam)
add_library(lift_slam::lift_slam ALIAS lift_slam_all)

set(installed_libraries
  util geometry camera image datasets nn features features_sift features_orb features_lift
  place_recognition map matching optimization tracking local_mapping loop_closing slam evaluation
  visualization all options)
list(TRANSFORM installed_libraries PREPEND lift_slam_)

install(TARGETS lift_slam RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS ${installed_libraries} EXPORT lift_slam_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/lift_slam TYPE INCLUDE FILES_MATCHING PATTERN "*.h"
  PATTERN "testing" EXCLUDE PATTERN "simulation" EXCLUDE PATTERN "measurement" EXCLUDE
  REGEX "[_/]test(_[a-z_]+)?\\.h$" EXCLUDE)
install(DIRECTORY weights vocabularies configs DESTINATION ${CMAKE_INSTALL_DATADIR}/lift_slam)
install(FILES LICENSE README.md TYPE DOC)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lift_slam)
install(EXPORT lift_slam_targets NAMESPACE lift_slam:: DESTINATION ${config_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/lift_slamConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lift_slamConfig.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lift_slamConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lift_slamConfig.cmake
  ${PROJECT_BINARY_DIR}/lift_slamConfigVersion.cmake DESTINATION ${config_folder})
