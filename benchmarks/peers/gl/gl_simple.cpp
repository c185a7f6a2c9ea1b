// SPDX-License-Identifier: Apache-2.0
//
// clear, fill, tiny_1m, draws_10k and the series triangle_size: one color per draw call, positions in normalized device coordinates.
#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "workloads/workload_geometry.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position_ndc;
void main() { gl_Position = vec4(position_ndc, 1.0); }
)";
constexpr std::string_view kFragment = R"(
uniform vec4 color;
out vec4 result;
void main() { result = color; }
)";

class Clear final : public GlWorkload {
 public:
  using GlWorkload::GlWorkload;
  void draw() override { begin(); }
};

class Fill final : public GlWorkload {
 public:
  explicit Fill(const GlInput& in) : GlWorkload(in, false), mesh_(floats_of(std::span<const glm::vec3>(kFullQuad)), {3}) {
    program_.set("color", kFillColor);
  }
  void draw() override {
    target().bind();
    program_.use();
    mesh_.draw(GL_TRIANGLE_STRIP);
  }

 private:
  GlProgram program_{"", kVertex, kFragment};
  GlMesh mesh_;
};

class Triangles final : public GlWorkload {
 public:
  Triangles(const GlInput& in, int count, double area)
      : GlWorkload(in), mesh_(floats_of(std::span<const glm::vec3>(tiny_triangles(in.size, count, area))), {3}) {
    program_.set("color", kTinyColor);
  }
  void draw() override {
    begin();
    glDisable(GL_CULL_FACE);
    program_.use();
    mesh_.draw(GL_TRIANGLES);
  }

 private:
  GlProgram program_{"", kVertex, kFragment};
  GlMesh mesh_;
};

// All corners are in one buffer; each draw call uses four of them. The color is a uniform that is set before each draw call.
class Draws final : public GlWorkload {
 public:
  explicit Draws(const GlInput& in)
      : GlWorkload(in), quads_(grid_of_quads()), mesh_(floats_of(std::span<const glm::vec3>(corners_of(quads_))), {3}) {
    color_ = program_.location("color");
  }
  void draw() override {
    begin();
    program_.use();
    mesh_.bind();
    GLint first = 0;
    for (const ColoredQuad& q : quads_) {
      glUniform4fv(color_, 1, &q.color[0]);
      glDrawArrays(GL_TRIANGLE_STRIP, first, 4);
      first += 4;
    }
  }

 private:
  static std::vector<glm::vec3> corners_of(const std::vector<ColoredQuad>& quads) {
    std::vector<glm::vec3> corners;
    for (const ColoredQuad& q : quads) corners.insert(corners.end(), q.corners.begin(), q.corners.end());
    return corners;
  }
  std::vector<ColoredQuad> quads_;
  GlProgram program_{"", kVertex, kFragment};
  GlMesh mesh_;
  GLint color_;
};

}  // namespace

Made clear(const GlInput& in) { return std::make_unique<Clear>(in); }
Made fill(const GlInput& in) { return std::make_unique<Fill>(in); }
Made triangles(const GlInput& in, int count, double area) { return std::make_unique<Triangles>(in, count, area); }
Made draws(const GlInput& in) { return std::make_unique<Draws>(in); }

}  // namespace halfspace::gl
