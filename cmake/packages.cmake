# Debian packages, which scripts/package.sh builds: halfspace (programs), libhalfspace-dev (static libraries and headers) and, if the build has
# the module, python3-halfspace.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME halfspace)
set(CPACK_PACKAGE_VENDOR "The Halfspace authors")
set(CPACK_PACKAGE_CONTACT "The Halfspace authors <halfspace@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "CPU renderer for models and scenes")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

# The component isa contains the libraries that are selected by the instruction set. HALFSPACE_SECOND_BUILD is a build for another
# instruction set.
set(HALFSPACE_SECOND_BUILD "" CACHE PATH "Portable build for another instruction set, whose programs are packaged as well")
set(CPACK_COMPONENTS_ALL runtime isa dev)
if(TARGET halfspace_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(HALFSPACE_SECOND_BUILD)
  # CPack ignores the component of a second project, so the files are installed by this one.
  install(DIRECTORY ${HALFSPACE_SECOND_BUILD}/bin/glibc-hwcaps DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT isa FILES_MATCHING PATTERN "*.so.*")
  if(TARGET halfspace_python)
    install(DIRECTORY ${HALFSPACE_SECOND_BUILD}/python/halfspace/glibc-hwcaps DESTINATION ${HALFSPACE_PYTHON_DIR}/halfspace COMPONENT python)
  endif()
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENT_RUNTIME_GROUP runtime)
set(CPACK_COMPONENT_ISA_GROUP runtime)
set(CPACK_COMPONENT_DEV_GROUP dev)
set(CPACK_COMPONENT_PYTHON_GROUP python)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE "${HALFSPACE_PACKAGE_RELEASE}")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME halfspace)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS python3-matplotlib)  # draws the charts of `halfspace chart`
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Command line programs for x86-64-v3 and later.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libhalfspace-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Static libraries and headers for x86-64-v3, with CMake and pkg-config files.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libglm-dev, libtbb-dev, libfmt-dev, libspng-dev, libjpeg-dev, libopenexr-dev, libmeshoptimizer-dev, \
nlohmann-json3-dev, libembree-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS halfspace)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-halfspace)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(TARGET halfspace_python)
  # An extension module works only with the version of Python that it was compiled for. The package halfspace contains the decoders.
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_python}), python3-numpy, "
    "halfspace (= ${CPACK_DEBIAN_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${halfspace_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module.")
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(changelog ${halfspace_BINARY_DIR}/changelog.Debian.gz)
execute_process(COMMAND ${Python3_EXECUTABLE} ${halfspace_SOURCE_DIR}/scripts/dev/debian_changelog.py
  ${CPACK_DEBIAN_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE} ${CPACK_PACKAGE_CONTACT} ${changelog} COMMAND_ERROR_IS_FATAL ANY)
foreach(component runtime dev python)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "Halfspace renders model files and scene files without a GPU or a graphics
driver. As a C++20 library, it provides the OpenGL pipeline.
${CPACK_COMPONENT_${upper}_DESCRIPTION}")
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${halfspace_SOURCE_DIR}/cmake/debian/copyright ${changelog} DESTINATION ${folder} COMPONENT ${component})
endforeach()
install(FILES ${halfspace_SOURCE_DIR}/cmake/debian/libhalfspace-dev.lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  RENAME libhalfspace-dev COMPONENT dev)
include(CPack)
