// SPDX-License-Identifier: Apache-2.0
//
// Renders a shipped scene and writes it to a file: scene TOOL_FOLDER OUTPUT.
#include <halfspace/image/image_io.h>
#include <halfspace/render/prepared_scene.h>
#include <halfspace/scene/scene_file.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  using namespace halfspace;
  if (argc != 3) return 2;
  try {
    set_tool_folder(argv[1]);
    const Workers workers(2);
    SceneAssets assets(workers);
    Image<glm::u8vec4> picture(96, 54);
    render(assets.prepare(SceneFile::open("earth").description(), picture.width(), picture.height()), picture, workers);
    write_image(argv[2], picture);
    std::printf("wrote %s\n", argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
