// SPDX-License-Identifier: Apache-2.0
#include "halfspace/explain/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/core/cpu.h"
#include "halfspace/explain/page_data.h"
#include "halfspace/explain/page_encode.h"
#include "halfspace/explain/page_quotes.h"
#include "halfspace/explain/stage_context.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/render/frame.h"

namespace halfspace {

namespace {

PageJson quotes_json() {
  PageJson json = PageJson::object();
  for (const QuoteRange& range : quote_ranges()) {
    const Quote q = quote(range);
    json[std::string(range.chapter)].push_back({{"file", "src/" + q.file}, {"line", q.line}, {"text", q.text}});
  }
  return json;
}

Image<uint32_t> count_fragments(const PassContext& context, const StageGeometry& g) {
  Image<uint32_t> counts(context.width, context.height);
  for (std::size_t i = 0; i < g.triangles.size(); ++i) {
    const Draw& draw = context.draws[g.primitives[g.primitive_of[i]].draw];
    const Triangle& t = g.triangles[i];
    const PixelBounds box = pixel_bounds(draw, t, draw.bounds, context.samples_at);
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        for (int s = 0; s < context.samples; ++s) counts.at(x, context.height - 1 - y) += covers(context, draw, t, x, y, s);
      }
    }
  }
  return counts;
}

uint32_t example_primitive(const PassContext& context, const StageGeometry& g, const ValuePictures& values, const PreparedScene& scene,
                           glm::ivec2 pixel) {
  const uint32_t object = values.object.at(pixel.x, pixel.y), instance = values.instance.at(pixel.x, pixel.y),
                 triangle = values.triangle.at(pixel.x, pixel.y);
  uint32_t any = kNoPrimitive;
  for (std::size_t i = 0; i < g.triangles.size(); ++i) {
    const StagePrimitive& p = g.primitives[g.primitive_of[i]];
    if (!covers(context, context.draws[p.draw], g.triangles[i], pixel.x, context.height - 1 - pixel.y, 0)) continue;
    any = g.primitive_of[i];
    const DrawSource& s = scene.draws[p.draw].source;
    if (s.object == static_cast<int>(object) && static_cast<uint32_t>(s.instance) == instance && p.index == triangle) return any;
  }
  return any;
}

std::string replaced(std::string text, std::string_view placeholder, std::string_view value) {
  const std::size_t at = text.find(placeholder);
  HS_CHECK(at != std::string::npos);
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
          {"tiles_touched", s.tiles_touched},
          {"flushes", s.flushes}};
}

std::string explain_page(const SceneDescription& description, const PreparedScene& scene, const PageOptions& options,
                         const Workers& workers) {
  const int width = scene.view.width_px, height = scene.view.height_px;
  Image<glm::u8vec4> picture(width, height);
  const PassStatistics statistics = render(scene, picture, workers);
  Image<glm::vec4> light(width, height);
  render(scene, light, workers);
  const PassContext context = stage_context(scene, workers);
  const StageGeometry geometry = stage_geometry(context);
  const ValuePictures values = value_pictures(scene, workers);
  const Image<uint32_t> fragments = count_fragments(context, geometry);
  const auto most = std::ranges::max_element(fragments.texels()) - fragments.texels().begin();
  const glm::ivec2 pixel = options.pixel.value_or(glm::ivec2(most % width, most / width));
  const PageInput in{description, scene, context, geometry, light, values, pixel, example_primitive(context, geometry, values, scene, pixel),
                     workers};
  PageJson json{{"scene", options.scene},
                {"command", options.command},
                {"title", description.head.title},
                {"version", options.version},
                {"width", width},
                {"height", height},
                {"samples", scene.samples},
                {"pixel", {pixel.x, pixel.y}},
                {"build", {{"description", build_description()}, {"lanes", kLanes}, {"packet", {kPacketWidth, kPacketHeight}}}},
                {"statistics", statistics_json(statistics)},
                {"draws", draws_json(in)},
                {"transforms", transforms_json(in)},
                {"example", example_json(in)},
                {"outcomes", outcomes_json(in)},
                {"clipped", clip_json(in)},
                {"wire", wireframe_json(in)},
                {"bins", bins_json(in)},
                {"perspective", perspective_json(in)},
                {"pictures", pictures_json(in, picture)},
                {"depth", depth_json(in)},
                {"mips", mip_json(in)},
                {"terms", terms_json(in)},
                {"shadow", shadow_json(in)},
                {"tone", tone_json(in)},
                {"sample_positions", samples_json(in)},
                {"overdraw", overdraw_json(in, fragments)},
                {"quotes", quotes_json()}};
  std::string page(embedded_text("page.html"));
  page = replaced(std::move(page), "@style@", embedded_text("page.css"));
  page = replaced(std::move(page), "@script@", joined_scripts());
  return replaced(std::move(page), "@data@", script_safe(json.dump()));
}

}  // namespace halfspace
