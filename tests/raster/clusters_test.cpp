// SPDX-License-Identifier: Apache-2.0
//
// Culling of clusters: the picture is the same with and without it, bit for bit, and the share of skipped triangles is close to that of
// the triangles that face away or are outside.
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "halfspace/geometry/shapes.h"
#include "halfspace/raster/clusters.h"
#include "raster/placed_mesh.h"

namespace halfspace::raster_test {
namespace {

struct Result {
  Image<glm::vec4> color;
  Image<float> depth;
  PassStatistics statistics;
};

Result draw_mesh(const Mesh& mesh, const Placement& place, DrawState state, const Clusters* clusters, int width = 160, int height = 120,
                 int samples = 1) {
  Result out{Image<glm::vec4>(width, height), Image<float>(width, height), {}};
  const Indices indices(mesh.indices, mesh.positions.size());
  if (clusters != nullptr) state.clusters = ClusterCulling{clusters, place.clip_from_world, place.world_from_object};
  Pass pass(width, height, rgba32f_target(out.color), d32f_target(out.depth), {.samples = samples});
  pass.draw(PlacedShader{place}, make_vertex_view(stream(mesh.positions)), indices, state);
  out.statistics = pass.run(one_worker());
  return out;
}

bool same_texels(const Result& a, const Result& b) {
  const auto same = [](const auto& x, const auto& y) { return std::memcmp(x.data(), y.data(), x.texels().size_bytes()) == 0; };
  return same(a.color, b.color) && same(a.depth, b.depth);
}

uint64_t culled(const PassStatistics& s) {
  return s.culled_non_finite + s.culled_outside + s.culled_face + s.culled_degenerate + s.culled_no_sample + s.culled_cluster;
}

// Draws with and without clusters, and returns the share of triangles that were skipped.
double expect_same_picture(const Mesh& mesh, const Clusters& clusters, const Placement& place, const DrawState& state, int samples = 1) {
  const Result whole = draw_mesh(mesh, place, state, nullptr, 160, 120, samples);
  const Result left = draw_mesh(mesh, place, state, &clusters, 160, 120, samples);
  EXPECT_TRUE(same_texels(whole, left));
  EXPECT_EQ(left.statistics.primitives_in, whole.statistics.primitives_in);
  EXPECT_EQ(left.statistics.vertices_in, whole.statistics.vertices_in);
  EXPECT_EQ(left.statistics.triangles_binned, whole.statistics.triangles_binned);
  EXPECT_EQ(left.statistics.clipped, whole.statistics.clipped);
  EXPECT_EQ(culled(left.statistics), culled(whole.statistics));
  EXPECT_LE(left.statistics.vertices_shaded, whole.statistics.vertices_shaded);
  return static_cast<double>(left.statistics.culled_cluster) / static_cast<double>(mesh.indices.size() / 3);
}

// The part of a unit sphere that faces an eye at distance d has the area 2π(1 − 1/d). Clusters across its border are kept: 64 triangles of
// 100 x 400 span 1.8° x 29°. From far away, more are kept, because the triangles become as small as the grid to which vertices are snapped.
TEST(Clusters, HalfOfASphereFacesAway) {
  const Mesh mesh = uv_sphere(100, 400, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  for (const double distance : {3.0, 4.0}) {
    const glm::mat4 clip(perspective() * look_at({0.0, distance * 0.6, distance * 0.8}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    const double faces_away = 0.5 * (1.0 + 1.0 / distance);
    const double share = expect_same_picture(mesh, clusters, clip, {.cull = CullMode::back});
    EXPECT_GT(share, faces_away - 0.25) << distance;
    EXPECT_LE(share, faces_away) << distance;
    EXPECT_EQ(expect_same_picture(mesh, clusters, clip, {.cull = CullMode::none}), 0.0) << distance;
  }
}

TEST(Clusters, NothingIsShadedOfAMeshOutsideOfTheView) {
  const Mesh mesh = uv_sphere(40, 60, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  const auto share = [&](const glm::dvec3& place, const DrawState& state = {}) {
    return expect_same_picture(mesh, clusters, glm::mat4(perspective() * glm::translate(glm::dmat4(1.0), place)), state);
  };
  for (const glm::dvec3& place : {glm::dvec3(20, 0, -10), glm::dvec3(-20, 0, -10), glm::dvec3(0, 20, -10), glm::dvec3(0, -20, -10),
                                  glm::dvec3(0, 0, 10), glm::dvec3(0, 0, -200)})
    EXPECT_EQ(share(place), 1.0) << place.x << ' ' << place.y << ' ' << place.z;
  EXPECT_EQ(share({0, 0, -200}, {.depth = {.clamp = true}}), 0.0);
  EXPECT_EQ(share({0, 0, -10}), 0.0);
}

// Draws without clusters before and after a draw of which nothing is left.
TEST(Clusters, DrawsBesideASkippedOneAreComplete) {
  const Mesh mesh = uv_sphere(8, 12, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  const glm::mat4 seen(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -4)));
  const glm::mat4 hidden(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 4)));
  const auto picture = [&](bool with_skipped) {
    Image<glm::vec4> image(64, 48);
    Pass pass(64, 48, rgba32f_target(image), {});
    const VertexView view = make_vertex_view(stream(mesh.positions));
    pass.draw(PlacedShader{seen}, view, indices);
    if (with_skipped) pass.draw(PlacedShader{hidden}, view, indices, {.clusters = ClusterCulling{&clusters, hidden}});
    pass.draw(PlacedShader{glm::scale(seen, glm::vec3(0.5f))}, view, indices);
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.culled_cluster, with_skipped ? mesh.indices.size() / 3 : 0);
    EXPECT_EQ(s.vertices_shaded, 2 * mesh.positions.size());
    return std::vector<glm::vec4>(image.texels().begin(), image.texels().end());
  };
  EXPECT_TRUE(picture(true) == picture(false));
}

// Views that come close to every rule: eyes inside and on the surface, tiny and huge meshes, planes through clusters, mirrored and
// orthographic projections, and triangles that are smaller than the grid to which vertices are snapped.
TEST(Clusters, RandomViewsHaveTheSamePicture) {
  std::vector<Mesh> meshes{uv_sphere(60, 90, 1.0f), torus_knot(0.7f, 0.25f, 60, 200), uv_sphere(200, 300, 1.0f)};
  {
    Random r(3);
    Mesh noise;  // triangles in all directions, some of them degenerate
    for (int i = 0; i < 3000; ++i) noise.positions.push_back({r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f)});
    for (int i = 0; i < 6000; ++i) noise.indices.push_back(i % 7 == 6 ? noise.indices.back() : static_cast<uint32_t>(r.below(3000)));
    meshes.push_back(noise);
  }
  std::vector<Clusters> clusters;
  for (const Mesh& mesh : meshes) clusters.emplace_back(stream(mesh.positions), Indices(mesh.indices, mesh.positions.size()));
  Random r(4);
  const auto choose = [&](int n) { return static_cast<std::size_t>(r.below(n)); };
  double skipped = 0.0;
  constexpr int kViews = 250;
  for (int i = 0; i < kViews; ++i) {
    const std::size_t number = choose(4);
    const auto real = [&](double low, double high) { return low + (high - low) * static_cast<double>(r.real(0.0f, 1.0f)); };
    const double distance = std::exp(real(-3.0, 5.0)), size = std::exp(real(-4.0, 1.0));
    const glm::dvec3 direction = glm::normalize(glm::dvec3(real(-1, 1), real(-1, 1), real(-1, 1)));
    const glm::dvec3 target(real(-0.5, 0.5), real(-0.5, 0.5), real(-0.5, 0.5));
    const bool is_reversed = r.below(3) == 0, is_orthographic = r.below(3) == 0;
    const glm::dmat4 view = look_at(direction * distance, target, {0.1, 1.0, 0.2});
    glm::dmat4 projection = perspective(0.05 * std::exp(real(-3.0, 1.0)), 20.0);
    if (is_reversed) projection = perspective_reversed(real(0.05, 2.0), 4.0 / 3.0, 0.05, 20.0);
    if (is_orthographic) projection = orthographic_gl(size, 4.0 / 3.0, -2.0, distance * 2.0);
    if (r.below(4) == 0) projection *= std::array{1e-9, 1e-4, 1e5, 1e9}[choose(4)];  // the same picture
    if (r.below(4) == 0) projection = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0)) * projection;
    DrawState state{.cull = std::array{CullMode::back, CullMode::back, CullMode::front, CullMode::none}[choose(4)],
                    .front = r.below(2) == 0 ? Winding::counter_clockwise : Winding::clockwise};
    if (is_reversed && !is_orthographic) state.depth = {.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};
    state.depth.clamp = r.below(5) == 0;
    if (r.below(4) == 0) state.viewport = ViewportRect(10.5f, 100.0f, 120.25f, -80.0f);
    if (r.below(4) == 0) state.clip_origin = ClipOrigin::upper_left;
    // Large translations that cancel each other: the rounding errors of the shader can be larger than pixels.
    glm::dmat4 world(1.0);
    if (r.below(3) == 0) {
      const double far = std::exp(real(0.0, 12.0));
      world = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(far, -0.5 * far, 0.3 * far)), real(0.0, 6.0), {0.1, 1.0, 0.3});
    }
    SCOPED_TRACE(i);
    const Placement place(glm::mat4(projection * view * glm::inverse(world)), glm::mat4(world));
    skipped += expect_same_picture(meshes[number], clusters[number], place, state, r.below(3) == 0 ? 4 : 1);
  }
  EXPECT_GT(skipped / kViews, 0.2);  // otherwise, the views would show nothing
}

// Triangles with a corner that is not finite are culled one by one, and do not hide the bounds of others.
TEST(Clusters, NonFiniteCornersHideNoOtherTriangle) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Mesh mesh;
    mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}, {bad, 0, 0}, {5, 5, 0}, {6, 5, 0}, {6, 6, 0}};
    mesh.indices = {0, 1, 2, 3, 4, 5, 4, 5, 6};
    const Clusters clusters(stream(mesh.positions), Indices(mesh.indices, mesh.positions.size()));
    EXPECT_EQ(expect_same_picture(mesh, clusters, glm::mat4(1.0f), {}), 0.0) << bad;
  }
}

// The corners and outlines of a triangle without area are drawn, so they belong to the bounds.
TEST(Clusters, OutlinesOfTrianglesWithoutAreaAreKept) {
  Mesh mesh;
  mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, 0.4f, 0}, {5, 5, 0}, {6, 5, 0}, {6, 6, 0}};
  mesh.indices = {0, 0, 1, 2, 3, 4};
  const Clusters clusters(stream(mesh.positions), Indices(mesh.indices, mesh.positions.size()));
  for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point})
    EXPECT_EQ(expect_same_picture(mesh, clusters, glm::mat4(1.0f), {.polygon_mode = mode, .cull = CullMode::back}), 0.0);
}

// With a small budget, the pass runs in rounds; with two threads, parts of the clusters that are left are shaded at the same time.
TEST(Clusters, RoundsAndThreadsDoNotMatter) {
  const Mesh mesh = uv_sphere(60, 90, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  const glm::mat4 clip(perspective() * look_at({0.0, 1.0, 2.0}, {0.3, 0.0, 0.0}, {0.0, 1.0, 0.0}));
  const auto picture = [&](bool with_clusters, std::size_t budget, const Workers& workers) {
    Image<glm::vec4> image(160, 120);
    Image<float> depth(160, 120);
    Pass pass(160, 120, rgba32f_target(image), d32f_target(depth), {.tuning = {.chunk_triangles = 100, .bin_budget = budget}});
    for (const float size : {1.0f, 0.9f, 1.1f}) {
      DrawState state{.cull = CullMode::back};
      const glm::mat4 scaled = glm::scale(clip, glm::vec3(size));
      if (with_clusters) state.clusters = ClusterCulling{&clusters, scaled};
      pass.draw(PlacedShader{scaled}, make_vertex_view(stream(mesh.positions)), indices, state);
    }
    const PassStatistics s = pass.run(workers);
    EXPECT_EQ(s.flushes > 0, budget < 1000000);
    EXPECT_EQ(s.culled_cluster > 0, with_clusters);
    return std::vector<glm::vec4>(image.texels().begin(), image.texels().end());
  };
  const auto expected = picture(false, 100000000, one_worker());
  for (const std::size_t budget : {std::size_t{1000}, std::size_t{100000000}}) {
    EXPECT_TRUE(picture(true, budget, one_worker()) == expected) << budget;
    EXPECT_TRUE(picture(true, budget, two_workers()) == expected) << budget;
  }
}

// A conditional draw that waits for a query and of which nothing is left still counts what was submitted.
TEST(Clusters, AConditionalDrawWithoutVisibleClustersIsCounted) {
  const Mesh mesh = uv_sphere(8, 12, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  const glm::mat4 seen(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -4)));
  const glm::mat4 hidden(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 4)));
  const VertexView view = make_vertex_view(stream(mesh.positions));
  const auto statistics = [&](bool with_clusters) {
    Image<glm::vec4> image(64, 48);
    Pass pass(64, 48, rgba32f_target(image), {});
    pass.draw(PlacedShader{seen}, view, indices, {.query = 0});
    DrawState state{.query = 1, .condition = DrawCondition{0}};
    if (with_clusters) state.clusters = ClusterCulling{&clusters, hidden};
    pass.draw(PlacedShader{hidden}, view, indices, state);
    return pass.run(one_worker());
  };
  const PassStatistics whole = statistics(false), left = statistics(true);
  EXPECT_EQ(left.primitives_in, whole.primitives_in);
  EXPECT_EQ(left.vertices_in, whole.vertices_in);
  EXPECT_EQ(left.query_primitives, whole.query_primitives);
  EXPECT_EQ(left.queries, whole.queries);
  EXPECT_EQ(left.culled_cluster, mesh.indices.size() / 3);
}

TEST(Clusters, VertexBlocksContainTheVerticesOfTheirTriangles) {
  Mesh mesh = uv_sphere(30, 50, 1.0f);
  mesh.indices.erase(mesh.indices.begin() + 300, mesh.indices.begin() + 3000);  // some vertices are not used
  const Indices indices(mesh.indices, mesh.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  ASSERT_FALSE(indices.used().empty());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t cluster = i / 3 / kClusterTriangles;
    const auto number = static_cast<uint32_t>(std::ranges::lower_bound(indices.used(), mesh.indices[i]) - indices.used().begin());
    EXPECT_TRUE(std::ranges::binary_search(clusters.vertex_blocks(cluster), number / kClusterVertexBlock)) << i;
    const glm::vec3 p = mesh.positions[mesh.indices[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(clusters.values(static_cast<Clusters::Value>(Clusters::kLowX + k))[cluster], p[static_cast<int>(k)]);
      EXPECT_GE(clusters.values(static_cast<Clusters::Value>(Clusters::kHighX + k))[cluster], p[static_cast<int>(k)]);
    }
  }
}

TEST(ClustersDeathTest, ChecksTheDraw) {
  const Mesh mesh = uv_sphere(8, 12, 1.0f), other = uv_sphere(8, 13, 1.0f);
  const Indices indices(mesh.indices, mesh.positions.size()), wrong(other.indices, other.positions.size());
  const Clusters clusters(stream(mesh.positions), indices);
  const auto draw = [&](const Indices& list, const DrawState& state) {
    Image<glm::vec4> image(16, 16);
    Pass pass(16, 16, rgba32f_target(image), {});
    pass.draw(PlacedShader{glm::mat4(1.0f)}, make_vertex_view(stream(other.positions)), list, state);
  };
  EXPECT_DEATH(draw(wrong, {.clusters = ClusterCulling{&clusters}}), "another index list");
  EXPECT_DEATH(draw(indices, {.instances = 2, .clusters = ClusterCulling{&clusters}}), "single instance of a triangle list");
  EXPECT_DEATH(draw(indices, {.topology = Topology::lines, .clusters = ClusterCulling{&clusters}}), "single instance of a triangle list");
  EXPECT_DEATH(draw(indices, {.base_vertex = 1, .clusters = ClusterCulling{&clusters}}), "a base_vertex");
  EXPECT_DEATH(draw(indices, {.clusters = ClusterCulling{}}), "there are no clusters");
  std::vector<uint32_t> fewer_vertices = mesh.indices;
  for (uint32_t& i : fewer_vertices) i /= 2;
  EXPECT_DEATH(draw(Indices(fewer_vertices, other.positions.size()), {.clusters = ClusterCulling{&clusters}}), "another index list");
  const std::vector<glm::vec4> four(mesh.positions.size());
  EXPECT_DEATH(Clusters(stream(four), indices), "expected positions of three");
#ifdef HALFSPACE_ASSERTS
  // The bounds are those of a smaller mesh: a cluster that they place outside of the view is not.
  const Mesh small = uv_sphere(8, 12, 0.01f);
  const Clusters wrong_bounds(stream(small.positions), indices);
  const glm::mat4 clip(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(2.0, 0, -3.0)));
  EXPECT_DEATH(draw_mesh(mesh, clip, {}, &wrong_bounds), "check failed");
#endif
}

}  // namespace
}  // namespace halfspace::raster_test
