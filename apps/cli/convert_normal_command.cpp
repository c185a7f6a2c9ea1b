// SPDX-License-Identifier: Apache-2.0
//
// `halfspace convert-normal HEIGHT -o NORMAL`: converts a height map to a normal map.
#include <string>

#include "cli/commands.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/core/check.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/normal_map.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/model_file/input_files.h"

namespace halfspace {

namespace {

MapEdges parse_edges(const std::string& text) {
  if (text == "repeat") return MapEdges::torus;
  if (text == "clamp") return MapEdges::sheet;
  if (text == "sphere") return MapEdges::sphere;
  throw UsageError("--edges is '" + text + "'; expected repeat, clamp or sphere");
}

}  // namespace

void convert_normal_command(const ConvertNormalArguments& args) {
  const double strength =
      args.strength.empty() ? 8.0
                            : parse_real("--strength", args.strength, -1e6, 1e6, "the height from black to white in texels, for example 8");
  const MapEdges edges = parse_edges(args.edges);
  if (image_file_of(args.out) != ImageFile::png && !(is_stream(args.out) && !std::filesystem::path(args.out).has_extension())) {
    throw UsageError("-o is '" + args.out + "'; expected a file name ending in .png");
  }
  reject_overwriting(args.out, {args.height});
  check_writable(args.out);
  const Image<float> heights = read_gray(args.height);
  if (heights.width() < 2) throw InputError(args.height + ": is only one texel wide; expected a height map");
  write_data_png(args.out, normal_map(heights, strength, edges, Workers(Workers::cores())));
}

}  // namespace halfspace
