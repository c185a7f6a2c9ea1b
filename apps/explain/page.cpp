// SPDX-License-Identifier: Apache-2.0
#include "explain/page.h"

#include <algorithm>

#include "explain/example_pixel.h"
#include "explain/page_data.h"
#include "explain/page_encode.h"
#include "explain/page_history.h"
#include "explain/page_quotes.h"
#include "explain/pixel_history.h"
#include "halfspace/core/cpu.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace {

namespace {

PageJson quotes_json() {
  PageJson json = PageJson::object();
  for (const QuoteRange& range : quote_ranges()) {
    const Quote q = quote(range);
    json[std::string(range.chapter)].push_back({{"file", q.file}, {"line", q.line}, {"text", q.text}});
  }
  return json;
}

// Returns the light that the frame stores. Without HDR, it has been rounded to 8-bit values. With a transparent background, it is divided
// by alpha, as before the tone curve.
Image<glm::vec4> straight_light(const PreparedScene& scene, const FrameTrace& trace) {
  Image<glm::vec4> light = trace.light;
  if (!scene.transparent) return light;
  std::ranges::transform(light.texels(), light.data(),
                         [](const glm::vec4& c) { return glm::vec4(glm::vec3(c) / (c.w > 0.0f ? c.w : 1.0f), c.w); });
  return light;
}

uint32_t example_primitive(const StageGeometry& g, const TracedFragment* f) {
  if (f == nullptr) return kNoPrimitive;
  for (uint32_t i = 0; i < g.primitives.size(); ++i) {
    const StagePrimitive& p = g.primitives[i];
    if (p.draw == f->draw && p.instance == f->instance && p.index == f->primitive) return i;
  }
  return kNoPrimitive;
}

// Returns what the example pixel can show, and whether the user chose it.
PageJson choice_json(const ExampleSearch& search, glm::ivec2 pixel, bool by_user) {
  const ExampleFacts f = search.facts(pixel);
  const ExampleIdeas& ideas = search.ideas();
  PageJson json{{"by_user", by_user}, {"visible", f.visible_pixels}, {"covered", f.covered_pixels}, {"primitives", f.primitives}};
  if (ideas.perspective && f.is_triangle) json["affine_error"] = f.affine_error;
  if (ideas.light && f.is_triangle) json["cosine"] = f.cosine;
  if (ideas.shadow && f.is_triangle) json["shadow"] = f.shadow;
  return json;
}

std::string replaced(std::string text, std::string_view placeholder, std::string_view value) {
  const std::size_t at = text.find(placeholder);
  HS_CHECK(at != std::string::npos, "explain: the template of the page lacks a placeholder; expected each placeholder once");
  return text.replace(at, placeholder.size(), value);
}

std::string joined_scripts() {
  std::string out;
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name.ends_with(".js")) out += file.text;
  }
  return out;
}

}  // namespace

PageJson statistics_json(const PassStatistics& s) {
  return {{"vertices_in", s.vertices_in},
          {"vertices_shaded", s.vertices_shaded},
          {"primitives_in", s.primitives_in},
          {"culled_non_finite", s.culled_non_finite},
          {"culled_outside", s.culled_outside},
          {"culled_face", s.culled_face},
          {"culled_degenerate", s.culled_degenerate},
          {"culled_no_sample", s.culled_no_sample},
          {"clipped", s.clipped},
          {"triangles_binned", s.triangles_binned},
          {"bin_entries", s.bin_entries},
          {"samples_tested", s.samples_tested},
          {"samples_passed", s.samples_passed},
          {"fragments_shaded", s.fragments_shaded},
          {"layers_merged", s.layers_merged},
          {"geometry_invocations", s.geometry_invocations},
          {"tiles_touched", s.tiles_touched},
          {"flushes", s.flushes}};
}

PageJson frame_json(const PageInput& in, const FrameTrace& trace) {
  return {{"width", trace.width},
          {"height", trace.height},
          {"samples", trace.samples},
          {"pixel", {in.pixel.x, in.pixel.y}},
          {"visible", visible_json(in)},
          {"build", {{"description", build_description()}, {"lanes", kLanes}, {"packet", {kPacketWidth, kPacketHeight}}}},
          {"statistics", statistics_json(trace.statistics)},
          {"draws", draws_json(in)},
          {"transforms", transforms_json(in)},
          {"example", example_json(in)},
          {"emission", emission_json(in)},
          {"outcomes", outcomes_json(in)},
          {"clipped", clip_json(in)},
          {"wire", wireframe_json(in)},
          {"bins", bins_json(in)},
          {"perspective", perspective_json(in)},
          {"pictures", pictures_json(in, trace.picture)},
          {"surfaces", surfaces_json(in)},
          {"depth", depth_json(in)},
          {"mips", mip_json(in)},
          {"terms", terms_json(in)},
          {"shadow", shadow_json(in)},
          {"tile", tile_json(in)},
          {"tone", tone_json(in)},
          {"sample_positions", samples_json(in)},
          {"sample_block", sample_block_json(in)},
          {"layers", layers_json(in)},
          {"overdraw", overdraw_json(in, trace)},
          {"history", histories_json(in, trace)},
          {"tile_times", tile_times_json(in)},
          {"quotes", quotes_json()}};
}

std::string explain_page(const SceneDescription& description, const PreparedScene& scene, const PageOptions& options,
                         const Workers& workers) {
  const FrameTrace trace = trace_frame(scene, workers);
  const Image<glm::vec4> light = straight_light(scene, trace);
  const ValuePictures values = value_pictures(scene, workers);
  PageJson json{{"scene", options.scene},          {"command", options.command}, {"render_command", options.render_command},
                {"title", description.head.title}, {"version", options.version}, {"lessons", options.lessons}};
  visit_set_up_scene(scene, workers, [&](const PassContext& context, int round) {
    if (round > 0) return;  // for a very large scene, the page shows only the triangles of the first round
    const ExampleSearch search({scene, context, trace, values, workers});
    const glm::ivec2 pixel = options.pixel ? *options.pixel : search.best();
    const TracedFragment* visible = visible_fragment(trace, pixel);
    const StageGeometry geometry = stage_geometry(context);
    const uint32_t example = example_primitive(geometry, visible);
    json.update(frame_json({description, scene, context, geometry, trace, light, values, pixel, visible, example, workers}, trace));
    json["choice"] = choice_json(search, pixel, options.pixel.has_value());
  });
  std::string page(embedded_text("page.html"));
  page = replaced(std::move(page), "@style@", embedded_text("page.css"));
  page = replaced(std::move(page), "@script@", joined_scripts());
  return replaced(std::move(page), "@data@", script_safe(json.dump()));
}

}  // namespace halfspace
