// SPDX-License-Identifier: Apache-2.0
//
// Renders a shipped scene, writes it to a file and reads the file: scene TOOL_FOLDER OUTPUT. If TOOL_FOLDER is empty, the library finds the
// decoders itself.
#include <halfspace/image/image_io.h>
#include <halfspace/render/frame/frame.h>
#include <halfspace/render/scene_assets.h>
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
    const Image<glm::u8vec4> read = read_image(argv[2]);
    std::printf("wrote %s, %d x %d pixels\n", argv[2], read.width(), read.height());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
