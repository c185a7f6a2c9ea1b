// SPDX-License-Identifier: Apache-2.0
//
// The history of a pixel as text and as JSON.
#include "cli/explain_command.h"
#include "explain/history_text.h"

namespace halfspace {

std::string explained_history(const ExplainJob& job, bool json) {
  const FrameTrace trace = trace_frame(job.prepared, job.workers);
  const glm::ivec2 pixel = job.pixel.value_or(trace.busiest_pixel());
  const PixelHistory history = pixel_histories(job.scene, job.prepared, trace, std::span(&pixel, 1), job.workers)[0];
  return json ? history_json(history, trace) : history_text(job.title, history, trace);
}

}  // namespace halfspace
