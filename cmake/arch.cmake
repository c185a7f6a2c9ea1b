# Selects the instruction set and SIMD width of the build and the corresponding flags. Included after project(halfspace).
#
# Rendered pixels are bit-identical for all of them, except x86-64-v2, which has no fma instruction and does not guarantee this.
#
# halfspace_flags contains the flags that every translation unit including a Halfspace header needs; consumers inherit it from the
# libraries. Warnings and the macros that restrict GLM are directory options, so they apply only to our own sources.

set(HALFSPACE_ARCH native CACHE STRING "native, x86-64-v2, x86-64-v3 or x86-64-v4")
set_property(CACHE HALFSPACE_ARCH PROPERTY STRINGS native x86-64-v2 x86-64-v3 x86-64-v4)
set(HALFSPACE_LANES "" CACHE STRING "SIMD lanes: 1, 4, 8 or 16 (empty: the width of the instruction set)")

if(NOT HALFSPACE_ARCH MATCHES "^(native|x86-64-v[234])$")
  message(FATAL_ERROR "HALFSPACE_ARCH is '${HALFSPACE_ARCH}'; expected native, x86-64-v2, x86-64-v3 or x86-64-v4")
endif()

# The default width depends on the macros that the compiler defines for this instruction set.
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=${HALFSPACE_ARCH} -dM -E -x c++ /dev/null
  OUTPUT_VARIABLE arch_macros RESULT_VARIABLE arch_result ERROR_VARIABLE arch_error)
if(NOT arch_result EQUAL 0)
  message(FATAL_ERROR "${CMAKE_CXX_COMPILER} does not support -march=${HALFSPACE_ARCH}: ${arch_error}")
endif()

set(lanes "${HALFSPACE_LANES}")
if(lanes STREQUAL "")
  if(arch_macros MATCHES "__AVX512DQ__" AND arch_macros MATCHES "__AVX512VL__" AND arch_macros MATCHES "__AVX512BW__")
    set(lanes 16)
  elseif(arch_macros MATCHES "__AVX2__")
    set(lanes 8)
  else()
    set(lanes 4)
  endif()
endif()
if(NOT lanes MATCHES "^(1|4|8|16)$")
  message(FATAL_ERROR "HALFSPACE_LANES is '${lanes}'; expected 1, 4, 8 or 16")
endif()
message(STATUS "halfspace: ${HALFSPACE_ARCH}, ${lanes} lanes")

add_library(halfspace_flags INTERFACE)
# Headers are included as "halfspace/MODULE/FILE.h". The build tree provides this path with a symbolic link, an installation with a folder.
file(MAKE_DIRECTORY ${halfspace_BINARY_DIR}/include)
file(CREATE_LINK ${halfspace_SOURCE_DIR}/src ${halfspace_BINARY_DIR}/include/halfspace SYMBOLIC)
target_include_directories(halfspace_flags INTERFACE ${halfspace_BINARY_DIR}/include)
target_compile_definitions(halfspace_flags INTERFACE HALFSPACE_LANES=${lanes})
# Contraction of a*b + c would make results depend on the compiler; errno only costs time. -Wno-psabi suppresses a note that g++ prints
# wherever wide vectors are passed by value.
target_compile_options(halfspace_flags INTERFACE -march=${HALFSPACE_ARCH} -ffp-contract=off -fno-math-errno -Wno-psabi)
if(arch_macros MATCHES "__AVX512F__")
  target_compile_options(halfspace_flags INTERFACE -mprefer-vector-width=512)
  set(vector_bits 512)
elseif(arch_macros MATCHES "__AVX__")
  set(vector_bits 256)
else()
  set(vector_bits 128)
endif()
# Copy vectors as a whole. For many processors, and for x86-64-v3, g++ 12 copies them in halves, and a subsequent load of the whole vector
# stalls until both halves have left the store buffer.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-mmove-max=${vector_bits} -mstore-max=${vector_bits}" HALFSPACE_HAS_MOVE_MAX)
if(HALFSPACE_HAS_MOVE_MAX)
  target_compile_options(halfspace_flags INTERFACE -mmove-max=${vector_bits} -mstore-max=${vector_bits})
endif()
add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(HALFSPACE_WERROR)
  add_compile_options(-Werror)
endif()
add_compile_definitions(GLM_FORCE_XYZW_ONLY GLM_FORCE_EXPLICIT_CTOR)
if(HALFSPACE_ASSERTS)
  target_compile_definitions(halfspace_flags INTERFACE HALFSPACE_ASSERTS)
endif()
if(HALFSPACE_SANITIZE)
  target_compile_options(halfspace_flags INTERFACE -fsanitize=${HALFSPACE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(halfspace_flags INTERFACE -fsanitize=${HALFSPACE_SANITIZE})
endif()
