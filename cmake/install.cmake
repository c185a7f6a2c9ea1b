# Installation: libraries, headers, the CMake package Halfspace and pkg-config files. Installed files contain no absolute paths, so a prefix
# can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(halfspace_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Halfspace)
set(halfspace_modules core shading raster image geometry procedural scene model render reference)

# Public headers. The headers that these include are installed as well. docs/reference/api.md describes the same list.
set(halfspace_public_headers
  core/check.h core/cpu.h core/discrete_vec.h core/glsl.h core/glsl_common.h core/glsl_geometric.h core/glsl_integer.h core/glsl_matrix.h
  core/glsl_packing.h core/glsl_relational.h core/glsl_trigonometric.h core/half.h core/image.h core/lane_hyperbolic.h core/lane_math.h
  core/lane_uint.h core/lanes.h core/parallel.h core/srgb.h core/swizzle.h core/texel_codec.h core/texel_format.h core/texel_view.h
  core/tool_folder.h core/units.h core/vec.h
  shading/contract.h shading/geometry_stage.h shading/tessellation_stage.h
  shading/environment/environment.h shading/environment/environment_sky.h shading/environment/star_sky.h
  shading/values/light_types.h shading/light/lighting.h shading/shadow/shadow.h shading/shadow/shadow_map.h shading/sphere/sphere_depth.h
  shading/sphere/sphere_impostor.h shading/surface/colored_primitives.h shading/surface/depth_only.h shading/surface/lit_surface.h
  shading/surface/masked_depth.h shading/surface/metallic_surface.h shading/surface/shadow_catcher.h shading/surface/surface_shader.h
  shading/surface/surface_uniforms.h shading/texture/sampler.h shading/texture/texture.h shading/texture/texture_memory.h
  shading/texture/texture_view.h shading/texture/tiles_on_demand.h shading/values/tone.h shading/values/tone_types.h
  raster/blit.h raster/capture.h raster/clusters.h raster/depth_on_demand.h raster/depth_pyramid.h raster/draw_state.h raster/naive.h raster/pass.h
  raster/sample_location.h raster/statistics.h raster/target.h raster/vertex_input.h raster/vertex_stream.h
  image/image_difference.h image/image_io.h
  geometry/camera.h geometry/displaced_sphere.h geometry/height_field.h geometry/mesh.h geometry/normal_map.h geometry/shapes.h
  procedural/earth.h procedural/moon.h procedural/noise.h procedural/patterns.h procedural/sky.h
  scene/animation.h scene/description.h scene/keys.h scene/scene_check.h scene/scene_file.h
  model/model.h model/pose/pose.h
  render/assets/model_asset.h render/frame/frame.h render/model_file/frame_model.h render/model_file/model_scene.h
  render/model_file/model_view.h render/particles.h render/prepared_scene.h render/scene_assets.h render/view.h
  reference/ray_scene.h reference/shadow_score.h reference/validation.h)

# Sets the file names of the library of a module and installs it. The name of a shared library contains the number of lanes, because programs
# compiled for another width must not load it. Modules are exported one by one, so that a component of the package needs only its own
# dependencies.
function(halfspace_library_properties name)
  set_target_properties(halfspace_${name} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME halfspace-${name})
  get_target_property(type halfspace_${name} TYPE)
  if(type STREQUAL SHARED_LIBRARY)
    set_target_properties(halfspace_${name} PROPERTIES
      OUTPUT_NAME halfspace-${name}-lanes${HALFSPACE_BUILD_LANES} VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH $ORIGIN DEFINE_SYMBOL ""
      LINK_DEPENDS ${halfspace_SOURCE_DIR}/cmake/exports.map)
    target_link_options(halfspace_${name} PRIVATE LINKER:--version-script=${halfspace_SOURCE_DIR}/cmake/exports.map)
  elseif(NOT BUILD_SHARED_LIBS)
    # A shared object that contains this library, such as an extension module of Python, does not export its functions.
    set_target_properties(halfspace_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  if(HALFSPACE_INSTALL AND name IN_LIST halfspace_modules)
    install(TARGETS halfspace_${name} EXPORT halfspace-${name} COMPONENT dev
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)
    install(EXPORT halfspace-${name} NAMESPACE Halfspace:: FILE Halfspace-${name}.cmake DESTINATION ${halfspace_package_dir} COMPONENT dev)
  endif()
endfunction()

# Links a module with a library that has no CMake package. The installed package refers to this library by its name.
function(halfspace_link_by_name module library)
  get_filename_component(file_name ${library} NAME_WE)
  string(REGEX REPLACE "^lib" "" link_name ${file_name})
  target_link_libraries(halfspace_${module} PRIVATE $<BUILD_INTERFACE:${library}> $<INSTALL_INTERFACE:${link_name}>)
endfunction()

# Appends a header and all headers that it includes to the list `headers` of the caller.
function(halfspace_collect_headers header)
  if(header IN_LIST headers)
    return()
  endif()
  list(APPEND headers ${header})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${halfspace_SOURCE_DIR}/src/${header})
  file(STRINGS ${halfspace_SOURCE_DIR}/src/${header} includes REGEX "^#include \"halfspace/")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE ".*\"halfspace/(.*)\".*" "\\1" included ${include})
    halfspace_collect_headers(${included})
  endforeach()
  set(headers ${headers} PARENT_SCOPE)
endfunction()

set(headers "")
foreach(header IN LISTS halfspace_public_headers)
  halfspace_collect_headers(${header})
endforeach()
set(halfspace_installed_headers ${headers})

# Sets the variable named by `out` to the headers of a module that a program or another module includes.
function(halfspace_headers_used_elsewhere out)
  set(used "")
  file(GLOB_RECURSE sources ${halfspace_SOURCE_DIR}/src/*.cpp ${halfspace_SOURCE_DIR}/src/*.h ${halfspace_SOURCE_DIR}/apps/*.cpp
    ${halfspace_SOURCE_DIR}/apps/*.h ${halfspace_SOURCE_DIR}/benchmarks/*.cpp ${halfspace_SOURCE_DIR}/python/*.cpp)
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH module ${halfspace_SOURCE_DIR}/src ${source})
    string(REGEX REPLACE "/.*" "" module ${module})
    file(STRINGS ${source} includes REGEX "^#include \"halfspace/")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE ".*\"halfspace/(.*)\".*" "\\1" included ${include})
      if(NOT included MATCHES "^${module}/")
        list(APPEND used ${included})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES used)
  set(${out} ${used} PARENT_SCOPE)
endfunction()
if(BUILD_SHARED_LIBS)
  halfspace_headers_used_elsewhere(halfspace_exported_headers)
  list(APPEND halfspace_exported_headers ${halfspace_installed_headers})
endif()

# Shared libraries export the functions of headers that are installed or used by another module or a program. They do not export the
# functions of other headers, of the private folders of raster, or of the model writers. Static libraries are left
# unchanged, because a unity build does not combine sources that have their own options.
function(halfspace_hide_private_functions sources)
  if(NOT BUILD_SHARED_LIBS)
    return()
  endif()
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH header ${halfspace_SOURCE_DIR}/src ${source})
    string(REGEX REPLACE "[.]cpp$" ".h" header ${header})
    if(source MATCHES "[.]cpp$" AND NOT header IN_LIST halfspace_exported_headers
        AND (EXISTS ${halfspace_SOURCE_DIR}/src/${header} OR header MATCHES "^(raster/.*/|model/.*/write_)"))
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fvisibility=hidden)
    endif()
  endforeach()
endfunction()

function(halfspace_install_headers)
  foreach(header IN LISTS halfspace_installed_headers)
    get_filename_component(folder ${header} DIRECTORY)
    string(REGEX REPLACE "/.*" "" module ${folder})
    if(NOT TARGET halfspace_${module})
      continue()
    endif()
    install(FILES ${halfspace_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/halfspace/${folder} COMPONENT dev)
  endforeach()
endfunction()

# Writes and installs halfspace-MODULE.pc. requires: pkg-config packages. libraries: additional libraries by name.
function(halfspace_pkg_config module requires libraries)
  if(NOT TARGET halfspace_${module})
    return()
  endif()
  list(JOIN requires ", " requires)
  list(TRANSFORM libraries PREPEND " -l")
  list(JOIN libraries "" libraries)
  get_target_property(name halfspace_${module} OUTPUT_NAME)
  set(flags "")
  if(module STREQUAL "core")
    get_target_property(options halfspace_flags INTERFACE_COMPILE_OPTIONS)
    get_target_property(definitions halfspace_flags INTERFACE_COMPILE_DEFINITIONS)
    list(FILTER options EXCLUDE REGEX "[$]<")  # flags that not every compiler knows
    list(TRANSFORM definitions PREPEND -D)
    list(JOIN options " " options)
    list(JOIN definitions " " definitions)
    set(flags " ${options} ${definitions} -pthread")
  endif()
  file(RELATIVE_PATH prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" prefix ${prefix})
  file(CONFIGURE OUTPUT ${halfspace_BINARY_DIR}/pkgconfig/halfspace-${module}.pc CONTENT [[
prefix=${pcfiledir}/@prefix@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@

Name: halfspace-@module@
Description: Module @module@ of Halfspace, a renderer that runs on the CPU (C++20)
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags: -I${includedir}@flags@
Libs: -L${libdir} -l@name@@libraries@
]] @ONLY)
  install(FILES ${halfspace_BINARY_DIR}/pkgconfig/halfspace-${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()

# Dependencies that a program links in addition to a static library, by module.
function(halfspace_install_pkg_config)
  set(core glm)
  set(image halfspace-core)
  set(image_libraries "")
  set(scene halfspace-core nlohmann_json)
  set(model halfspace-core)
  set(model_libraries "")
  set(render halfspace-raster halfspace-image halfspace-procedural halfspace-scene halfspace-model)
  set(reference halfspace-render)
  set(reference_libraries "")
  if(NOT BUILD_SHARED_LIBS)
    foreach(module image scene model render reference)
      list(APPEND ${module} fmt)
    endforeach()
    if(HALFSPACE_WITH_TBB)
      list(APPEND core tbb)
    endif()
    if(JPEG_FOUND)
      list(APPEND image libjpeg)
    endif()
    if(OpenEXR_FOUND)
      list(APPEND image OpenEXR)
    endif()
    set(image_libraries spng)
    set(model_libraries meshoptimizer)
    get_filename_component(reference_libraries "${EMBREE_LIBRARY}" NAME_WE)
    string(REGEX REPLACE "^lib" "" reference_libraries "${reference_libraries}")
  endif()
  halfspace_pkg_config(core "${core}" "")
  halfspace_pkg_config(shading halfspace-core "")
  halfspace_pkg_config(raster halfspace-shading "")
  halfspace_pkg_config(geometry halfspace-shading "")
  halfspace_pkg_config(procedural halfspace-geometry "")
  halfspace_pkg_config(image "${image}" "${image_libraries}")
  halfspace_pkg_config(scene "${scene}" "")
  halfspace_pkg_config(model "${model}" "${model_libraries}")
  halfspace_pkg_config(render "${render}" "")
  halfspace_pkg_config(reference "${reference}" "${reference_libraries}")
endfunction()

# Installs everything but the libraries themselves. Called after src/ has been added.
function(halfspace_install_package)
  install(TARGETS halfspace_flags EXPORT halfspace-core COMPONENT dev)
  halfspace_install_headers()
  set(built "")
  foreach(module IN LISTS halfspace_modules)
    if(TARGET halfspace_${module})
      list(APPEND built ${module})
    endif()
  endforeach()
  get_target_property(type halfspace_core TYPE)
  string(COMPARE EQUAL ${type} STATIC_LIBRARY is_static)
  configure_file(${halfspace_SOURCE_DIR}/cmake/HalfspaceConfig.cmake.in ${halfspace_BINARY_DIR}/HalfspaceConfig.cmake @ONLY)
  write_basic_package_version_file(${halfspace_BINARY_DIR}/HalfspaceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${halfspace_BINARY_DIR}/HalfspaceConfig.cmake ${halfspace_BINARY_DIR}/HalfspaceConfigVersion.cmake
    DESTINATION ${halfspace_package_dir} COMPONENT dev)
  halfspace_install_pkg_config()
endfunction()

# Generates and installs the manual pages and the shell completions from the help texts of the programs.
function(halfspace_install_documents)
  find_package(Python3 COMPONENTS Interpreter)
  if(NOT Python3_FOUND OR CMAKE_CROSSCOMPILING OR NOT TARGET halfspace)
    return()
  endif()
  set(folder ${halfspace_BINARY_DIR}/share/generated)
  set(more "")
  set(page halfspace.1)
  if(HALFSPACE_PORTABLE)  # pages of packages are compressed
    set(more --compress)
    set(page halfspace.1.gz)
  endif()
  if(TARGET halfspace-bench)
    list(APPEND more --bench $<TARGET_FILE:halfspace-bench>)
  endif()
  if(TARGET halfspace-view)
    list(APPEND more --view $<TARGET_FILE:halfspace-view>)
  endif()
  add_custom_command(OUTPUT ${folder}/man/man1/${page}
    COMMAND Python3::Interpreter ${halfspace_SOURCE_DIR}/scripts/dev/generate_man.py --program $<TARGET_FILE:halfspace> ${more} ${folder}
    DEPENDS halfspace $<TARGET_NAME_IF_EXISTS:halfspace-bench> $<TARGET_NAME_IF_EXISTS:halfspace-view>
      ${halfspace_SOURCE_DIR}/scripts/dev/generate_man.py
    COMMENT "Generating manual pages and completions" VERBATIM)
  add_custom_target(halfspace_documents ALL DEPENDS ${folder}/man/man1/${page})
  install(DIRECTORY ${folder}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT runtime)
  install(DIRECTORY ${folder}/bash-completion ${folder}/fish DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT runtime)
  set(zsh_folder site-functions)
  if(HALFSPACE_PORTABLE)
    set(zsh_folder vendor-completions)  # Debian's zsh searches site-functions only below /usr/local
  endif()
  install(DIRECTORY ${folder}/zsh/site-functions/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder} COMPONENT runtime)
endfunction()

# Targets that build only what is installed: `installed` builds everything, and `isa` builds the files that a portable build has once per
# instruction set.
function(halfspace_add_install_targets)
  add_custom_target(isa)
  add_custom_target(installed)
  foreach(module IN LISTS halfspace_modules)
    if(TARGET halfspace_${module})
      add_dependencies(installed halfspace_${module})
    endif()
  endforeach()
  foreach(target halfspace halfspace-bench halfspace-view halfspace_documents halfspace_python halfspace-image-tool halfspace-jpeg-tool
          halfspace-draco-tool)
    if(TARGET ${target})
      add_dependencies(installed ${target})
    endif()
  endforeach()
  foreach(target halfspace-program-cli halfspace-program-bench halfspace_python)
    if(TARGET ${target})
      add_dependencies(isa ${target})
    endif()
  endforeach()
endfunction()
