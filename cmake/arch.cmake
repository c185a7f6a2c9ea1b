# Selects the instruction set and SIMD width of the build and the corresponding flags. Included after project(halfspace).
#
# Rendered pixels are bit-identical for all instruction sets except x86-64-v2, which has no fma instruction and does not guarantee this.
#
# halfspace_flags contains the flags that every translation unit needs that includes a Halfspace header; consumers inherit it from the
# libraries. All other flags are directory options, so they apply only to our own sources.

set(HALFSPACE_ARCH native CACHE STRING "native, x86-64-v2, x86-64-v3 or x86-64-v4")
set_property(CACHE HALFSPACE_ARCH PROPERTY STRINGS native x86-64-v2 x86-64-v3 x86-64-v4)
set(HALFSPACE_LANES "" CACHE STRING "SIMD lanes: 1, 4, 8 or 16 (empty: the width of the instruction set)")

if(NOT HALFSPACE_ARCH MATCHES "^(native|x86-64-v[234])$")
  message(FATAL_ERROR "HALFSPACE_ARCH is '${HALFSPACE_ARCH}'; expected native, x86-64-v2, x86-64-v3 or x86-64-v4")
endif()

# The extensions that code for an instruction set may need: those that the compiler uses on its own or that our code uses. core/cpu.cpp
# knows the same names. Other extensions, such as AES, SSE4A and ADX, are used by intrinsics only, of which we have none.
set(halfspace_extensions SSE3 SSSE3 SSE4_1 SSE4_2 POPCNT MOVBE LZCNT BMI BMI2 AVX F16C FMA AVX2 FMA4 XOP TBM AVX512F AVX512BW AVX512DQ
  AVX512VL AVX512CD)

# Sets the variable named by `out` to the macros that the compiler defines with the given options.
function(halfspace_macros out)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${ARGN} -dM -E -x c++ /dev/null
    OUTPUT_VARIABLE macros RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${CMAKE_CXX_COMPILER} does not support ${ARGN}: ${error}")
  endif()
  set(${out} "${macros}" PARENT_SCOPE)
endfunction()

# Sets the variable named by `out` to the options that select an instruction set. They exclude extensions that make nothing faster, so that
# a build does not need them:
# - LZCNT and MOVBE, which x86-64-v3 and x86-64-v4 include and some processors and virtual machines lack
# - for a processor with AVX-512: everything beyond x86-64-v4, such as VBMI and VNNI
# - for other processors: GFNI and the extensions of AVX2 for matrix products and conversions, such as AVX-VNNI
function(halfspace_arch_options arch out)
  set(options -march=${arch})
  if(arch STREQUAL "native")
    halfspace_macros(macros -march=native)
    if(macros MATCHES "__AVX512BW__" AND macros MATCHES "__AVX512CD__" AND macros MATCHES "__AVX512DQ__" AND macros MATCHES "__AVX512VL__")
      set(options -march=x86-64-v4 -mtune=native -mno-lzcnt -mno-movbe)
    else()
      string(REGEX MATCHALL "__(GFNI|AVX[A-Z0-9]+)__ 1" excluded "${macros}")
      list(TRANSFORM excluded REPLACE "^__(.*)__ 1$" "\\1")
      list(REMOVE_ITEM excluded ${halfspace_extensions})
      list(TRANSFORM excluded TOLOWER)
      list(TRANSFORM excluded PREPEND -mno-)
      list(APPEND options ${excluded})
    endif()
  elseif(arch MATCHES "^x86-64-v[34]$")
    list(APPEND options -mno-lzcnt -mno-movbe)
  endif()
  set(${out} ${options} PARENT_SCOPE)
endfunction()

# Sets the variable named by `out` to the extensions that code for an instruction set needs, as core/cpu.cpp expects them, for example
# " SSE3 AVX AVX2 FMA ".
function(halfspace_cpu_needs arch out)
  halfspace_arch_options(${arch} options)
  halfspace_macros(macros ${options})
  set(needs " ")
  foreach(extension IN LISTS halfspace_extensions)
    if(macros MATCHES "#define __${extension}__ 1")
      string(APPEND needs "${extension} ")
    endif()
  endforeach()
  set(${out} "${needs}" PARENT_SCOPE)
endfunction()

# The default width depends on the macros that the compiler defines for this instruction set.
halfspace_arch_options(${HALFSPACE_ARCH} arch_options)
halfspace_macros(arch_macros ${arch_options})

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
# Headers are included as "halfspace/MODULE/FILE.h". include/halfspace is a symbolic link to src.
include(GNUInstallDirs)
target_include_directories(halfspace_flags INTERFACE
  $<BUILD_INTERFACE:${halfspace_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
set_target_properties(halfspace_flags PROPERTIES EXPORT_NAME flags)
target_compile_features(halfspace_flags INTERFACE cxx_std_20)
set(HALFSPACE_BUILD_LANES ${lanes})
target_compile_definitions(halfspace_flags INTERFACE HALFSPACE_LANES=${lanes})
# Contraction of a*b + c would make results depend on the compiler. Functions are aligned to 32 bytes: with the default of 16, the code
# before the kernel of a shader decides where it lies, which made a fifth of difference once (docs/development/optimizations.md).
set(halfspace_common_options -ffp-contract=off -falign-functions=32)
target_compile_options(halfspace_flags INTERFACE ${arch_options} ${halfspace_common_options})
# Gives a program the include path and the options of halfspace_flags, but another instruction set. It must not link halfspace_flags, whose
# -march would follow this one and override it.
function(halfspace_set_arch target arch)
  target_include_directories(${target} PRIVATE $<TARGET_PROPERTY:halfspace_flags,INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_features(${target} PRIVATE cxx_std_20)
  halfspace_arch_options(${arch} options)
  target_compile_options(${target} PRIVATE ${options} ${halfspace_common_options})
endfunction()

# Copy vectors as a whole. When tuning for x86-64-v3 and many processors, g++ copies them in halves. A subsequent load of the whole vector
# then stalls until both halves have left the store buffer. Shaders of consumers need these flags as well. An installation may be used with
# another compiler, and only g++ 12 and later know them.
if(arch_macros MATCHES "__AVX512F__")
  set(vector_bits 512)
elseif(arch_macros MATCHES "__AVX__")
  set(vector_bits 256)
else()
  set(vector_bits 128)
endif()
set(has_move_max $<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>>)
target_compile_options(halfspace_flags INTERFACE
  $<${has_move_max}:-mmove-max=${vector_bits}> $<${has_move_max}:-mstore-max=${vector_bits}>)

# Options of our own sources. Results do not depend on them. errno of math functions only costs time. -Wno-psabi suppresses a note that g++
# prints wherever vectors are passed by value that are wider than the registers. Macros such as __FILE__ contain paths relative to the source
# tree, so that binaries do not name the folder they were built in. Unique symbols would keep a shared object loaded after dlclose().
add_compile_options(-fno-math-errno -Wno-psabi -fmacro-prefix-map=${halfspace_SOURCE_DIR}/=
  -fmacro-prefix-map=${halfspace_SOURCE_DIR}/include/= $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
if(arch_macros MATCHES "__AVX512F__")
  add_compile_options(-mprefer-vector-width=512)
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
