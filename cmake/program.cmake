# Programs. An ordinary build has one executable for each program. A portable build (HALFSPACE_PORTABLE, for packages) has a launcher that
# runs on any x86-64 processor and a shared library for the instruction set of the build. The library is in a folder that the dynamic loader
# searches only on processors with that instruction set.
#
#   halfspace_program(NAME SHORT SOURCES...)    The sources define main() and extern "C" int halfspace_SHORT_main(int argc, char** argv),
#                                               which do the same. Sets program_target to the target that is made of the sources.

if(HALFSPACE_PORTABLE AND NOT HALFSPACE_ARCH MATCHES "^x86-64-v[34]$")
  message(FATAL_ERROR "HALFSPACE_ARCH is '${HALFSPACE_ARCH}'; with HALFSPACE_PORTABLE, expected x86-64-v3 or x86-64-v4")
endif()
# Adds the check of core/cpu.h to a target that starts other code. The target itself is compiled for baseline x86-64 and does not link
# Halfspace::core. In a portable build, it also starts code for the smallest instruction set of packages.
function(halfspace_add_processor_check target)
  set(arch ${HALFSPACE_ARCH})
  if(HALFSPACE_PORTABLE)
    set(arch x86-64-v3)
  endif()
  halfspace_cpu_needs(${arch} needs)
  target_sources(${target} PRIVATE ${halfspace_SOURCE_DIR}/src/core/cpu.cpp)
  target_include_directories(${target} PRIVATE ${halfspace_SOURCE_DIR}/include)
  target_compile_options(${target} PRIVATE -march=x86-64)
  target_compile_definitions(${target} PRIVATE HALFSPACE_NEEDS="${needs}" HALFSPACE_ARCH="${arch}" HALFSPACE_LANES=${HALFSPACE_BUILD_LANES}
    $<$<BOOL:${HALFSPACE_PORTABLE}>:HALFSPACE_PORTABLE>)
endfunction()

# Where a loader of a portable build searches for its library, relative to the folder with the libraries: first in the folder for the level
# that glibc assigns to the processor. glibc assigns x86-64-v3 only to processors with LZCNT and MOVBE, which our code does not need, so the
# folder for x86-64-v3 is searched on every processor.
set(halfspace_library_folders "" glibc-hwcaps/x86-64-v3)

set(halfspace_start_check ${halfspace_SOURCE_DIR}/apps/cli/start_check.cpp)
file(RELATIVE_PATH halfspace_lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})

function(halfspace_program name short)
  set_source_files_properties(${halfspace_start_check} PROPERTIES COMPILE_OPTIONS "-march=x86-64")
  if(HALFSPACE_PORTABLE)
    set(library halfspace-program-${short})
    set(folder glibc-hwcaps/${HALFSPACE_ARCH})
    add_library(${library} SHARED ${ARGN})
    set_target_properties(${library} PROPERTIES
      OUTPUT_NAME halfspace-${short} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${folder} INSTALL_RPATH $ORIGIN/../..
      BUILD_WITH_INSTALL_RPATH ON DEFINE_SYMBOL "")
    target_link_options(${library} PRIVATE LINKER:--version-script=${halfspace_SOURCE_DIR}/apps/launcher/entry.map)
    add_executable(${name} ${halfspace_SOURCE_DIR}/apps/launcher/launcher.cpp ${halfspace_start_check})
    add_dependencies(${name} ${library})
    halfspace_add_processor_check(${name})
    target_compile_definitions(${name} PRIVATE HALFSPACE_LIBRARY="$<TARGET_SONAME_FILE_NAME:${library}>"
      HALFSPACE_FUNCTION="halfspace_${short}_main")
    target_link_libraries(${name} PRIVATE ${CMAKE_DL_LIBS})
    list(TRANSFORM halfspace_library_folders PREPEND $ORIGIN/ OUTPUT_VARIABLE build_folders)
    list(TRANSFORM halfspace_library_folders PREPEND $ORIGIN/${halfspace_lib_from_bin}/ OUTPUT_VARIABLE folders)
    set_target_properties(${name} PROPERTIES BUILD_RPATH "${build_folders}" INSTALL_RPATH "${folders}" UNITY_BUILD OFF)
    install(TARGETS ${library} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${folder} COMPONENT isa NAMELINK_SKIP)
    set(program_target ${library} PARENT_SCOPE)
  else()
    add_executable(${name} ${halfspace_start_check} ${ARGN})
    set_target_properties(${name} PROPERTIES INSTALL_RPATH $ORIGIN/${halfspace_lib_from_bin})
    set(program_target ${name} PARENT_SCOPE)
  endif()
  if(HALFSPACE_INSTALL)
    install(TARGETS ${name} COMPONENT runtime)
  endif()
endfunction()
