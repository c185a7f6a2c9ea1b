// SPDX-License-Identifier: Apache-2.0
//
// A host program can recover from misuse: the check handler throws, and the pass can be destroyed afterwards.
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test {
namespace {

class PassCheckTest : public ThrowingChecksTest {
 protected:
  Image<glm::vec4> image_{16, 16};
  const std::vector<glm::vec4> positions_{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
};

/// A shader that fails a check when its fragments are shaded.
struct FailingShader : ConstantShader {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& pixel) const {
    HS_CHECK_OP(color.x, >, 1.0f);
    return ConstantShader::fragment(in, pixel);
  }
};

TEST_F(PassCheckTest, DrawRejectsOutOfRangeIndices) {
  const std::vector<uint32_t> list{0, 1, 5};
  const Indices of_six(list, 6);
  {
    Pass pass(16, 16, rgba32f_target(image_), {});
    pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)));
    const std::string message = failure_of([&] { pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)), of_six); });
    EXPECT_NE(message.find("(6 vs 3)"), std::string::npos) << message;
  }
  Pass pass(16, 16, rgba32f_target(image_), {});
  pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)));
  EXPECT_EQ(pass.run(one_worker()).primitives_in, 1u);
  EXPECT_EQ(image_.at(8, 8), glm::vec4(1));
}

TEST_F(PassCheckTest, OrderIndependentDrawsRejectStatesThatLayersDoNotHave) {
  const DrawState layered{.depth = {.write = false}, .order_independent = true};
  DrawState masked = layered, blended = layered, writes = layered;
  masked.color_mask.g = false;
  blended.attachments[0] = AttachmentState{.blend = kAlphaBlend};
  writes.depth.write = true;
  Pass pass(16, 16, rgba32f_target(image_), {});
  const auto message = [&](Pass& to, const DrawState& s) {
    return failure_of([&] { to.draw(ConstantShader{}, make_vertex_view(stream(positions_)), s); });
  };
  EXPECT_EQ(message(pass, layered), "");
  for (const DrawState& s : {masked, blended, writes}) EXPECT_NE(message(pass, s), "");
  Image<uint32_t> integers(16, 16);
  Pass integer_pass(16, 16, r32ui_target(integers), {});
  EXPECT_NE(message(integer_pass, layered), "");
  Pass colorless_pass(16, 16, ColorTarget{}, {.format = DepthFormat::d32f});
  EXPECT_NE(message(colorless_pass, layered), "");
}

TEST_F(PassCheckTest, RunPropagatesAFailedCheckOfAShader) {
  for (const int threads : {1, 3}) {
    Pass pass(16, 16, rgba32f_target(image_), {}, {.tuning = {.tile_size = 8}});
    pass.draw(FailingShader{}, make_vertex_view(stream(positions_)));
    EXPECT_EQ(failure_of([&] { pass.run(Workers(threads)); }), "color.x > 1.0f (1 vs 1)");
  }
}

}  // namespace
}  // namespace halfspace::raster_test
