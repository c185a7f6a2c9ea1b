// SPDX-License-Identifier: Apache-2.0
//
// The history of a pixel as text and as JSON.
#include "cli/explain_command.h"
#include "halfspace/explain/history_text.h"

namespace halfspace {

namespace {

PixelHistory explained_history(const ExplainJob& job, const FrameTrace& trace) {
  const glm::ivec2 pixel = job.pixel.value_or(trace.busiest_pixel());
  return pixel_histories(job.scene, job.prepared, trace, std::span(&pixel, 1), job.workers)[0];
}

}  // namespace

std::string history_text(const ExplainJob& job) {
  const FrameTrace trace = trace_frame(job.prepared, job.workers);
  return history_text(job.command, explained_history(job, trace), trace);
}

std::string history_json(const ExplainJob& job) {
  const FrameTrace trace = trace_frame(job.prepared, job.workers);
  return history_json(explained_history(job, trace), trace);
}

}  // namespace halfspace
