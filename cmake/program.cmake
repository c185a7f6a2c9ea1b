# Programs. An ordinary build has one executable for each program. A portable build (HALFSPACE_PORTABLE, for packages) has a launcher that
# runs on any x86-64 processor and a shared library for the instruction set of the build. The library is in a folder that the dynamic loader
# searches only on processors with that instruction set.
#
#   halfspace_program(NAME SHORT SOURCES...)    The sources define main() and extern "C" int halfspace_SHORT_main(int argc, char** argv),
#                                               which do the same. Sets program_target to the target that is made of the sources.

if(HALFSPACE_PORTABLE AND NOT HALFSPACE_ARCH MATCHES "^x86-64-v[34]$")
  message(FATAL_ERROR "HALFSPACE_ARCH is '${HALFSPACE_ARCH}'; with HALFSPACE_PORTABLE, expected x86-64-v3 or x86-64-v4")
endif()
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
    add_executable(${name} ${halfspace_SOURCE_DIR}/apps/launcher/launcher.cpp ${halfspace_start_check} ${halfspace_SOURCE_DIR}/src/core/cpu.cpp)
    add_dependencies(${name} ${library})
    halfspace_cpu_needs(x86-64-v3 needs)
    target_include_directories(${name} PRIVATE ${halfspace_BINARY_DIR}/include)
    target_compile_options(${name} PRIVATE -march=x86-64)
    target_compile_definitions(${name} PRIVATE HALFSPACE_LIBRARY="$<TARGET_SONAME_FILE_NAME:${library}>"
      HALFSPACE_FUNCTION="halfspace_${short}_main" HALFSPACE_NEEDS="${needs}" HALFSPACE_ARCH="x86-64-v3" HALFSPACE_LANES=8 HALFSPACE_PORTABLE)
    target_link_libraries(${name} PRIVATE ${CMAKE_DL_LIBS})
    set_target_properties(${name} PROPERTIES BUILD_RPATH $ORIGIN UNITY_BUILD OFF)
    install(TARGETS ${library} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${folder} COMPONENT isa NAMELINK_SKIP)
    set(program_target ${library} PARENT_SCOPE)
  else()
    add_executable(${name} ${halfspace_start_check} ${ARGN})
    set(program_target ${name} PARENT_SCOPE)
  endif()
  set_target_properties(${name} PROPERTIES INSTALL_RPATH $ORIGIN/${halfspace_lib_from_bin})
  if(HALFSPACE_INSTALL)
    install(TARGETS ${name} COMPONENT runtime)
  endif()
endfunction()
