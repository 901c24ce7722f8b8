# Run by cmake -P at every build (cmake/GitRevision.cmake): writes OUTPUT when it would change.
set(revision unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE_DIR} describe --always --abbrev=40 --exclude=* --dirty
    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0 AND found)
    set(revision ${found})
  endif()
endif()
set(text "#include \"apps/build_info.h\"

namespace lift_slam {

const char* const kGitRevision = \"${revision}\";

}  // namespace lift_slam
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
