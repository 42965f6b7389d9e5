# Warnings and sanitizers of our own targets; nothing here reaches a consumer except the Eigen guard.
add_library(fcl_prob_settings INTERFACE)
target_compile_options(fcl_prob_settings INTERFACE -Wall -Wextra -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports std::string's operator+ (its bug 105651) and std::regex under sanitizers (105562).
  target_compile_options(fcl_prob_settings INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()
# Of classes that keep to one file, but in a unity build GCC takes every file for a header.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(fcl_prob_settings INTERFACE -Wno-subobject-linkage)
  # A tenth of the time went into collecting garbage, which 1.5 GB a compiler make needless.
  target_compile_options(fcl_prob_settings INTERFACE --param=ggc-min-heapsize=1500000)
endif()
# Results must not depend on which instruction set a kernel was compiled for.
target_compile_options(fcl_prob_settings INTERFACE -ffp-contract=off)
if(FCL_PROB_WERROR)
  target_compile_options(fcl_prob_settings INTERFACE -Werror)
endif()
if(FCL_PROB_SANITIZE)
  target_link_options(fcl_prob_settings INTERFACE -fsanitize=${FCL_PROB_SANITIZE})
  target_compile_definitions(fcl_prob_settings INTERFACE FCL_PROB_SANITIZED)
endif()

# Eigen's alignment is part of libfcl's ABI: a wider one in our build crashes at run time.
foreach(flags "${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}}")
  if(flags MATCHES "-march=native|-mavx")
    message(STATUS "fcl_prob: wide instruction sets asked for; keeping EIGEN_MAX_ALIGN_BYTES=16 "
      "so that Eigen's layout matches the installed libfcl")
  endif()
endforeach()

# Most of a build's time goes into reading FCL's and Eigen's headers. A source still includes all that
# it uses: one of CI's builds has this off.
function(fcl_prob_precompile target)
  if(FCL_PROB_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} ${ARGN})
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      target_compile_options(${target} PRIVATE -fpch-instantiate-templates)
    endif()
  endif()
endfunction()
set(FCL_PROB_COMMON_HEADERS <fcl/geometry/bvh/BVH_model.h> <Eigen/Dense> <algorithm> <cmath>
  <memory> <optional> <string> <vector>)
