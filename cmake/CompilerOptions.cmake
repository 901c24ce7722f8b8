# One set of compiler options for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# ccache, when present, makes a rebuild of unchanged sources nearly free; the precompiled
# header needs the two sloppiness flags.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_ctime,include_file_mtime
    ${CCACHE_PROGRAM})
endif()

add_library(lift_slam_options INTERFACE)
target_compile_options(lift_slam_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Werror -fpch-preprocess)
# Eigen types cross into libraries built for the baseline instruction set (Ceres): both sides
# must agree on the alignment, whatever -march says.
target_compile_definitions(lift_slam_options INTERFACE EIGEN_MAX_ALIGN_BYTES=16)

if(NOT LIFT_SLAM_ARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(lift_slam_options INTERFACE -march=x86-64-v3)
elseif(LIFT_SLAM_ARCH)
  target_compile_options(lift_slam_options INTERFACE -march=${LIFT_SLAM_ARCH})
endif()

if(LIFT_SLAM_SANITIZER STREQUAL "address")
  set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(LIFT_SLAM_SANITIZER STREQUAL "thread")
  set(sanitize -fsanitize=thread -fno-omit-frame-pointer)
elseif(LIFT_SLAM_SANITIZER)
  message(FATAL_ERROR "LIFT_SLAM_SANITIZER is '${LIFT_SLAM_SANITIZER}', expected empty, address or thread")
endif()
if(sanitize)
  target_compile_options(lift_slam_options INTERFACE ${sanitize})
  target_link_options(lift_slam_options INTERFACE ${sanitize})
endif()
