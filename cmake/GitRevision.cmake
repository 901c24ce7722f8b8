# lift_slam_add_git_revision(TARGET): adds to TARGET a source file that defines
# `extern const char* const kGitRevision` (apps/build_info.h). It is looked up at every build, but
# written only when it has changed, so only TARGET is compiled and linked anew after a commit.
# Without git or outside a clone the revision is "unknown".
function(lift_slam_add_git_revision target)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/git_revision.cc)
  add_custom_target(${target}_git_revision
    COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D OUTPUT=${output}
      -P ${PROJECT_SOURCE_DIR}/cmake/WriteGitRevision.cmake
    BYPRODUCTS ${output} VERBATIM)
  set_source_files_properties(${output} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${output})
  add_dependencies(${target} ${target}_git_revision)
endfunction()
