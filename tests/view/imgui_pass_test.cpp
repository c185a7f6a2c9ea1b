// SPDX-License-Identifier: Apache-2.0
#include "view/imgui_pass.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <utility>

#include "support/workers.h"
#include "view/interface_font.h"

namespace halfspace {
namespace {

constexpr int kWidth = 200, kHeight = 120;

// Draws over a gray frame with a new ImGui context.
class ImGuiPassTest : public testing::Test {
 protected:
  ImGuiPassTest() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().Fonts->AddFontDefault();
    ImGui::GetIO().DisplaySize = {kWidth, kHeight};
    std::fill_n(frame_.data(), frame_.texels().size(), kGray);
  }
  ~ImGuiPassTest() override { ImGui::DestroyContext(); }

  template <class F>
  void draw(const F& add) {
    ImGuiPass pass(*ImGui::GetIO().Fonts);
    ImGui::NewFrame();
    add(*ImGui::GetForegroundDrawList());
    ImGui::Render();
    pass.draw(*ImGui::GetDrawData(), frame_, two_workers());
  }

  static constexpr glm::u8vec4 kGray{100, 100, 100, 255};
  Image<glm::u8vec4> frame_{kWidth, kHeight};
};

TEST_F(ImGuiPassTest, ARectangleCoversItsPixelsAndNoOthers) {
  draw([](ImDrawList& list) { list.AddRectFilled({20, 30}, {60, 50}, IM_COL32(255, 0, 0, 255)); });
  int covered = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 20 && x < 60 && y >= 30 && y < 50;
      const glm::u8vec4 expected = inside ? glm::u8vec4(255, 0, 0, 255) : kGray;
      // ImGui adds one-pixel antialiased edges outside a solid rectangle.
      const bool edge = !inside && x >= 19 && x <= 60 && y >= 29 && y <= 50;
      ASSERT_TRUE(edge || frame_.at(x, y) == expected) << x << " " << y;
      covered += inside;
    }
  }
  EXPECT_EQ(covered, 40 * 20);
}

TEST_F(ImGuiPassTest, BlendingUsesSrgbValues) {
  draw([](ImDrawList& list) { list.AddRectFilled({0, 0}, {50, 50}, IM_COL32(200, 0, 255, 128)); });
  // 100 + (200 − 100) · 128/255 = 150.2; linear blending would give 158.
  EXPECT_NEAR(frame_.at(10, 10).x, 150, 1);
  EXPECT_NEAR(frame_.at(10, 10).y, 50, 1);
  EXPECT_NEAR(frame_.at(10, 10).z, 178, 1);
}

TEST_F(ImGuiPassTest, TheScissorLimitsWhatIsDrawn) {
  draw([](ImDrawList& list) {
    list.PushClipRect({10, 20}, {30, 40});
    list.AddRectFilled({0, 0}, {kWidth, kHeight}, IM_COL32_WHITE);
    list.PopClipRect();
  });
  EXPECT_EQ(frame_.at(10, 20), glm::u8vec4(255));
  EXPECT_EQ(frame_.at(29, 39), glm::u8vec4(255));
  for (const glm::ivec2 outside : {glm::ivec2(9, 20), glm::ivec2(10, 19), glm::ivec2(30, 39), glm::ivec2(29, 40)})
    EXPECT_EQ(frame_.at(outside.x, outside.y), kGray) << outside.x << ' ' << outside.y;
}

TEST_F(ImGuiPassTest, TextHasTheTexelsOfTheFont) {
  draw([](ImDrawList& list) { list.AddText({5, 5}, IM_COL32_WHITE, "H"); });
  // The default font is a 13-pixel bitmap font, so each pixel of the letter is white or unchanged.
  int white = 0, other = 0;
  for (const glm::u8vec4& c : frame_.texels()) {
    white += c == glm::u8vec4(255);
    other += c != glm::u8vec4(255) && c != kGray;
  }
  EXPECT_GT(white, 15);
  EXPECT_EQ(other, 0);
}

TEST(InterfaceFont, AScalableFontHasTheRequestedHeightAndAMissingOneIsReplaced) {
  for (const auto& [file, height] : {std::pair(std::filesystem::path("/no/font.ttf"), 21.0f), std::pair(interface_font(), 21.7f)}) {
    if (file.empty()) GTEST_SKIP() << "no font is installed (Debian and Ubuntu: fonts-dejavu-core)";
    ImFontAtlas fonts;
    add_interface_font(fonts, file, 21.7);
    unsigned char* texels = nullptr;
    int width = 0, atlas_height = 0;
    fonts.GetTexDataAsAlpha8(&texels, &width, &atlas_height);
    ASSERT_EQ(fonts.Fonts.Size, 1);
    EXPECT_EQ(fonts.Fonts[0]->FontSize, height) << file;
    const bool scalable = file == interface_font();
    EXPECT_EQ(fonts.Fonts[0]->FindGlyphNoFallback(0x416) != nullptr, scalable) << "a Cyrillic letter";
    EXPECT_EQ(fonts.Fonts[0]->GetCharAdvance('i'), fonts.Fonts[0]->GetCharAdvance('M')) << "columns of text are aligned";
  }
}

TEST_F(ImGuiPassTest, WithoutTrianglesTheFrameIsUnchanged) {
  const Image<glm::u8vec4> before = frame_;
  draw([](ImDrawList&) {});
  EXPECT_EQ(frame_, before);
}

}  // namespace
}  // namespace halfspace
