# halfspace_embed_scenes(OUT): writes a source file that holds every scenes/*.json, so that the program needs no files.
function(halfspace_embed_scenes out)
  file(GLOB scenes CONFIGURE_DEPENDS ${halfspace_SOURCE_DIR}/scenes/*.json)
  list(TRANSFORM scenes REPLACE "^.*/(.*)[.]json$" "\\1" OUTPUT_VARIABLE names)
  list(SORT names)
  set(entries "")
  foreach(name ${names})
    set(scene ${halfspace_SOURCE_DIR}/scenes/${name}.json)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scene})
    file(READ ${scene} text)
    string(APPEND entries "    {\"${name}\", R\"scene(${text})scene\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${out} CONTENT [[
// Written by cmake/embed_scenes.cmake from scenes/*.json.
#include "halfspace/scene/scene_file.h"

namespace halfspace {

std::span<const ShippedScene> shipped_scenes() {
  static constexpr ShippedScene scenes[] = {
@entries@  };
  return scenes;
}

}  // namespace halfspace
]] @ONLY)
endfunction()
