// SPDX-License-Identifier: Apache-2.0
//
// The draws of a pass with emitting stages or layers, layer by layer. Draws with emitting stages become draws of what these emit. If only
// the vertex function chooses layers, instances that have a single one are drawn as they are.
#pragma once

#include <memory>
#include <vector>

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/amplify/split_primitives.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace::HS_LANES::detail {

class EmittedDraws {
 public:
  /// Takes the draws of a context, and runs their emitting stages. Adds to the counters of their functions. The arena of the context keeps
  /// states and streams. layers, supersample: see PassOptions.
  EmittedDraws(PassContext& context, const Attachments& attachments, int layers, bool supersample, const Workers& workers,
               PassStatistics& statistics);

  /// Replaces the draws of the context by those of a layer. They are valid as long as this object.
  void set_layer(int layer);

 private:
  // What a draw has emitted: runs of instances, or primitives.
  struct Emitted {
    std::vector<InstanceRun> runs;
    EmittedPrimitives primitives;
    std::vector<PrimitivePart> parts;
    std::vector<std::shared_ptr<const Indices>> indices;  // of each part
  };

  SplitOptions split_options(const Draw& draw, int layers) const;
  Emitted emit(const Draw& draw, int layers, const Workers& workers, PassStatistics& statistics) const;
  void add_draw(const Draw& source, const ShaderKernels& kernels, std::shared_ptr<const Indices> indices, const VertexStreams& vertices,
                DrawState state, int32_t viewport);
  void add_instances(const Draw& source, const InstanceRun& run);
  void add_part(const Draw& source, const Emitted& emitted, std::size_t part);

  PassContext& context_;
  const Attachments& attachments_;
  bool supersample_;
  std::vector<Draw> sources_;
  std::vector<Emitted> emitted_;  // one per source; empty for those without emitting stages
};

}  // namespace halfspace::HS_LANES::detail
