// SPDX-License-Identifier: Apache-2.0
//
// halfspace-start-to-file-bound: measures the minimum time for an image of the Earth, as a reference for `halfspace render earth`
// (scripts/bench/start_to_file.py). It generates the maps of the scene, sleeps for the duration of a frame, and writes an existing image.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "halfspace/core/parallel.h"
#include "halfspace/image/image_io.h"
#include "halfspace/procedural/earth.h"

namespace {

using namespace halfspace;
using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

void run(bool with_normals, int width, double frame_ms, const char* from, const char* to) {
  const Clock::time_point start = Clock::now();
  const Image<glm::u8vec4> picture = read_image(from);
  std::printf("%.3f\n", milliseconds_since(start));  // to be subtracted from the total time

  const Workers workers(Workers::cores());
  const EarthMaps maps = procedural_earth_maps(width, width / 2, workers);
  Image<glm::vec4> normals;
  if (with_normals) normals = procedural_earth_normals(maps.height, workers);
  const Clock::time_point frame = Clock::now();
  while (milliseconds_since(frame) < frame_ms) {
  }
  write_image(to, picture);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view maps = argc == 6 ? argv[1] : "";
  if (maps != "heights" && maps != "normals") {
    std::fputs(
        "usage: halfspace-start-to-file-bound heights|normals MAP_WIDTH FRAME_MS FROM.png TO.png; prints the time to read FROM in ms\n",
        stderr);
    return 2;
  }
  try {
    run(maps == "normals", std::atoi(argv[2]), std::atof(argv[3]), argv[4], argv[5]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "halfspace-start-to-file-bound: %s\n", e.what());
    return 1;
  }
}
