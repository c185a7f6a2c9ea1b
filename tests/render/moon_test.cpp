// SPDX-License-Identifier: Apache-2.0
//
// Tests the shipped scene "moon", and how PreparedScene handles displacement, placement and assets.
#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"
#include "support/constants.h"
#include "support/errors.h"
#include "support/workers.h"

namespace halfspace {
namespace {

SceneDescription moon_with(const std::vector<std::string>& settings) {
  SceneFile scene = SceneFile::open("moon");
  for (const std::string& s : settings) scene.set(s);
  return scene.description();
}

std::string error_of(const SceneDescription& scene) {
  SceneAssets assets(one_worker());
  return input_error([&] { assets.prepare(scene, 64, 64); });
}

TEST(Moon, IsWithinOneLsbOfDoublePrecision) {
  // The remaining 0.1% of pixels are on silhouettes, where a position rounds to a different multiple of 1/256 px, and on the rims of stars.
  EXPECT_LE(share_beyond_one_code<double>(SceneFile::open("moon").description(), 320, 180), 1e-3);
}

TEST(Moon, IsBitIdenticalForAnyThreadCount) {
  const SceneDescription scene = SceneFile::open("moon").at(1.0);
  const Image<glm::u8vec4> one = picture_of(scene, 160, 90, 1);
  EXPECT_EQ(picture_of(scene, 160, 90, 2), one);
  EXPECT_EQ(picture_of(scene, 160, 90, 7), one);
}

// The distance from the origin to the ray through a pixel, and whether the pixel is covered.
struct Sighting {
  double distance;
  bool covered;
  double pixel;  // its size in world units at the distance of the origin
};

std::vector<Sighting> sightings(const SceneDescription& scene, int width, int height) {
  SceneDescription white = scene;  // drawn pixels become 1, all others 0
  white.head.ambient.linear = glm::dvec3(1.0);
  white.lights.clear();
  white.background = {};
  for (auto& [name, object] : white.objects) object.surface.color = Color{glm::dvec3(1.0)};
  const Image<glm::u8vec4> picture = picture_of(white, width, height);
  const CameraDescription& c = white.cameras.front().second;
  const glm::dvec3 forward = glm::normalize(c.target - c.position), right = glm::normalize(glm::cross(forward, c.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double half = c.type == Projection::perspective ? std::tan(c.fov * kPi / 360.0) : 0.5 * c.height;
  std::vector<Sighting> list;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double sx = (2 * (x + 0.5) / width - 1) * half * width / height, sy = (1 - 2 * (y + 0.5) / height) * half;
      double distance, pixel;
      if (c.type == Projection::perspective) {
        const glm::dvec3 ray = glm::normalize(forward + right * sx + up * sy);
        distance = glm::length(glm::cross(c.position, ray));
        pixel = 2 * half / height * glm::length(c.position);
      } else {
        distance = glm::length(glm::cross(c.position + right * sx + up * sy, forward));
        pixel = 2 * half / height;
      }
      list.push_back({distance, picture.at(x, y).x > 127, pixel});
    }
  }
  return list;
}

TEST(Moon, SilhouetteWithoutDisplacementIsTheSphere) {
  for (const char* camera : {"cameras.whole.type=perspective", "cameras.whole.type=orthographic"}) {
    SceneFile scene = SceneFile::open("moon");
    scene.set(camera);
    if (scene.description().cameras.front().second.type == Projection::orthographic) scene.set("cameras.whole.height=3");
    scene.set("moon.height_scale=0");
    int covered = 0;
    for (const Sighting& s : sightings(scene.description(), 400, 300)) {
      covered += s.covered;
      // A chord of 1/256 of a half turn is 1 − cos(π/512) = 1.9e-5 below the sphere, in both directions of the grid. Snapping moves a
      // vertex by 1/512 px, and perspective stretches that at the outline by a factor of less than 2.
      const double slack = 2 * 1.9e-5 + s.pixel / 256;
      if (s.distance < 1 - slack) {
        EXPECT_TRUE(s.covered) << s.distance;
      }
      if (s.distance > 1 + slack) {
        EXPECT_FALSE(s.covered) << s.distance;
      }
    }
    EXPECT_GT(covered, 10000);
  }
}

TEST(Moon, DisplacedSilhouetteIsBetweenTheExtremeHeights) {
  const SceneDescription scene = moon_with({"moon.height_scale=0.2"});
  const double low = 1 - 0.1 - 1e-3, high = 1 + 0.1 + 1e-3;  // for the map values 0 and 1
  int between = 0, inside = 0;
  for (const Sighting& s : sightings(scene, 400, 300)) {
    if (s.distance < low) {
      EXPECT_TRUE(s.covered);
    }
    if (s.distance > high) {
      EXPECT_FALSE(s.covered);
    }
    const bool on_the_limb = s.distance > 0.96 && s.distance < 1.04;
    between += on_the_limb;
    inside += on_the_limb && s.covered;
  }
  // The limb has mountains, so the ring is partially covered.
  EXPECT_GT(inside, between / 10);
  EXPECT_LT(inside, between * 9 / 10);
}

TEST(Moon, PixelNormalsOnACoarseMeshResembleAFineMesh) {
  const auto picture = [](int sectors, const char* normals) {
    return picture_of(moon_with({"moon.longitudes=" + std::to_string(sectors), "moon.latitudes=" + std::to_string(sectors / 2),
                                 "moon.color=#ffffff", std::string("moon.normals=") + normals}),
                      320, 180);
  };
  const Image<glm::u8vec4> fine = picture(1024, "vertex");
  const auto difference = [&](const Image<glm::u8vec4>& p) {
    double sum = 0;
    for (int y = 40; y < 140; ++y) {
      for (int x = 110; x < 210; ++x) sum += std::abs(int{p.at(x, y).x} - int{fine.at(x, y).x});
    }
    return sum / 10000;
  };
  const double by_pixel = difference(picture(64, "pixel")), by_vertex = difference(picture(64, "vertex"));
  RecordProperty("by_pixel", std::to_string(by_pixel));
  RecordProperty("by_vertex", std::to_string(by_vertex));
  EXPECT_GT(by_vertex, 2 * by_pixel) << by_vertex << " and " << by_pixel << ", in 1/255";
}

// ---- prepared scenes -------------------------------------------------------------------------------------------

SceneDescription parsed(const std::string& text) { return SceneFile::parse(text, "test.json", ".").description(); }

TEST(PreparedScene, SkipsInvisibleObjects) {
  const Workers workers(1);
  SceneAssets assets(workers);
  EXPECT_TRUE(assets.prepare(parsed(R"({"version": 1})"), 8, 8).draws.empty());
  EXPECT_TRUE(assets.prepare(parsed(R"({"version": 1, "objects": {"a": {"visible": false, "color": "none.png"}}})"), 8, 8).draws.empty())
      << "the files of invisible objects are not loaded";
  const PreparedScene plain = assets.prepare(parsed(R"({"version": 1, "objects": {"a": {"color": 0.5}}})"), 8, 8);
  EXPECT_EQ(surface_of(plain.draws.at(0)).factors[kColor].map, nullptr);
  EXPECT_TRUE(surface_of(plain.draws.at(0)).lights.empty());
}

TEST(PreparedScene, ReusesAssetsBetweenFrames) {
  const Workers workers(1);
  SceneAssets assets(workers);
  SceneDescription scene = moon_with({"textures.surface.width=64", "textures.relief.width=64"});
  const auto map_of = [](const PreparedScene& p) { return surface_of(p.draws.front()).factors[kColor].map; };
  const PreparedScene first = assets.prepare(scene, 32, 32);
  scene.objects.front().second.placement.rotation.y += 10;
  const PreparedScene second = assets.prepare(scene, 32, 32);
  EXPECT_EQ(map_of(second), map_of(first));
  EXPECT_EQ(second.draws.front().vertices.streams[0].data, first.draws.front().vertices.streams[0].data);
  scene.objects.front().second.height_scale = 0.01;
  const PreparedScene third = assets.prepare(scene, 32, 32);
  EXPECT_EQ(map_of(third), map_of(first));
  EXPECT_NE(third.draws.front().vertices.streams[0].data, first.draws.front().vertices.streams[0].data);
}

// Instances share mesh and texture; each has its own transform.
TEST(PreparedScene, InstancesShareMeshAndTexture) {
  const Workers workers(1);
  SceneAssets assets(workers);
  const PreparedScene p = assets.prepare(parsed(R"({"version": 1, "textures": {"t": {"source": "checkerboard", "width": 64}},
    "objects": {"a": {"shape": "cube", "color": "t", "instances": [{}, {"position": [2, 0, 0]}, {"position": [4, 0, 0]}]}}})"),
                                         8, 8);
  ASSERT_EQ(p.draws.size(), 3u);
  const LitSurface& first = surface_of(p.draws[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    const LitSurface& copy = surface_of(p.draws[i]);
    EXPECT_EQ(copy.factors[kColor].map, first.factors[kColor].map);
    EXPECT_NE(copy.world_from_object, first.world_from_object);
    EXPECT_EQ(p.draws[i].indices, p.draws[0].indices);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(p.draws[i].vertices.streams[k].data, p.draws[0].vertices.streams[k].data);
  }
}

// The camera approaches the object. Unless later frames are announced, the map grows along the way; with expect(), it has its final width
// in the first frame.
TEST(PreparedScene, ExpectedFramesShareTheWidthOfTheirMaps) {
  const Workers workers(1);
  const SceneFile scene = SceneFile::parse(R"({"version": 1, "cameras": {"c": {"position": [0, 0, 9]}},
    "textures": {"t": {"source": "rock_color"}}, "objects": {"a": {"shape": "icosphere", "level": 1, "color": "t"}},
    "animations": {"dolly": {"target": "c.position", "rate": [0, 0, -7]}}})",
                                           "test.json", {});
  const auto width_at = [&](SceneAssets& assets, double seconds) {
    const PreparedScene p = assets.prepare(scene.at(seconds), 480, 270);
    return surface_of(p.draws[0]).factors[kColor].map->width();
  };
  SceneAssets alone(workers), together(workers);
  EXPECT_LT(width_at(alone, 0), width_at(alone, 1));
  together.expect(scene.at(0), 480, 270);
  together.expect(scene.at(1), 480, 270);
  EXPECT_EQ(width_at(together, 0), width_at(alone, 1));
  EXPECT_EQ(width_at(together, 1), width_at(alone, 1));
}

// From 1 unit above a plane with a field of view of 90°, the nearest visible point of the plane is 1 unit away along the view axis. At that
// distance, 8 units are 8/2 image widths, and a texel may span at most two pixels. Points behind the eye are nearer, but do not count.
TEST(PreparedScene, MapWidthOfAPlaneFollowsItsVisiblePart) {
  const Workers workers(1);
  const auto width_from = [&](const char* eye, const char* target, const std::string& plane, const std::string& more = "") {
    SceneAssets assets(workers);
    const PreparedScene p = assets.prepare(
        parsed(std::string(R"({"version": 1, "cameras": {"c": {"fov": 90, "position": )") + eye + R"(, "target": )" + target + R"(}},
          "textures": {"t": {"source": "rock_color"}, "h": {"source": "rock_height"}},
          "objects": {"a": {"shape": "plane", "color": "t", )" +
               plane + "}}" + more + "}"),
        512, 512);
    return surface_of(p.draws.at(0)).factors[kColor].map->width();
  };
  const std::string plain = R"("size": 8)";
  EXPECT_EQ(width_from("[0, 1.05, 0]", "[0, 1.05, -1]", plain), 1024);  // 8/2.1 · 512 = 1950 px
  EXPECT_EQ(width_from("[0, 0.95, 0]", "[0, 0.95, -1]", plain), 2048);  // 2156 px
  EXPECT_EQ(width_from("[0, 1.05, 0]", "[1, 3, -1]", plain), 256);      // only the sky is visible: minimum width

  const std::string placed = R"("size": 4, "scale": [2, 2, 2], "rotation": [0, 30, 0], "position": [0.5, 2, 0.5])";
  EXPECT_EQ(width_from("[0, 3.05, 0]", "[0, 3.05, -1]", placed), 1024);
  EXPECT_EQ(width_from("[0, 2.95, 0]", "[0, 2.95, -1]", placed), 2048);

  // The relief rises up to 0.5 above the plane.
  const std::string relief = R"("size": 8, "segments": 4, "height": "h", "height_scale": 0.5, "height_zero": 0)";
  EXPECT_EQ(width_from("[0, 1.55, 0]", "[0, 1.55, -1]", relief), 1024);
  EXPECT_EQ(width_from("[0, 1.45, 0]", "[0, 1.45, -1]", relief), 2048);
  const std::string shadow = R"(, "lights": {"l": {}}, "shadow": {"method": "pcf3"})";
  EXPECT_EQ(width_from("[0, 1.55, 0]", "[1, 3, -1]", relief), 256);
  // The plane is not visible but may cast a shadow into the view, so its map has the maximum width of a pattern.
  EXPECT_EQ(width_from("[0, 1.55, 0]", "[1, 3, -1]", relief, shadow), 2048);
}

// Draws every shape, with and without displacement, and every map that tiles.
TEST(PreparedScene, EveryShapeAndPatternIsDrawn) {
  const Workers workers(2);
  SceneAssets assets(workers);
  for (const char* shape : {"uv_sphere", "icosphere", "plane", "cube", "cylinder", "cone", "torus", "torus_knot"}) {
    for (const char* height : {"0", "\"bark\""}) {
      const PreparedScene p = assets.prepare(
          parsed(
              std::string(R"({"version": 1, "textures": {"bark": {"source": "bark_height", "width": 64}}, "objects": {"a": {"shape": ")") +
              shape + R"(", "height_scale": 0.1, "height": )" + height + "}}}"),
          8, 8);
      EXPECT_EQ(p.draws.size(), 1u) << shape;
    }
  }
  for (const char* source :
       {"checkerboard", "grass_color", "bark_color", "bricks_color", "facade_color", "facade_specular", "facade_emissive", "rock_color"}) {
    const PreparedScene p =
        assets.prepare(parsed(std::string(R"({"version": 1, "textures": {"t": {"width": 64, "source": ")") + source +
                              R"("}}, "objects": {"a": {"shape": "plane", "tiles_u": 2, "tiles_v": 3, "color": "t"}}})"),
                       8, 8);
    EXPECT_EQ(surface_of(p.draws.at(0)).factors[kColor].map->width(), 64) << source;
  }
}

TEST(PreparedScene, InstancesAndMirrorsAreDrawnCorrectly) {
  // A cube in three places, once mirrored, lit from the front. Each instance shows its front face, lit with the same cosine.
  const SceneDescription scene = parsed(R"({"version": 1,
    "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "height": 4}},
    "lights": {"l": {"direction": [0, 0, 1]}},
    "objects": {"a": {"shape": "cube", "size": 1, "instances": [{"position": [-2, 0, 0]}, {}, {"position": [2, 0, 0], "scale": [-1, 1, 1]}]}}})");
  const Image<glm::u8vec4> p = picture_of(scene, 80, 40);  // 10 px per unit
  for (const int x : {20, 40, 60}) {
    EXPECT_EQ(p.at(x, 20), glm::u8vec4(255)) << x;
    EXPECT_EQ(p.at(x - 4, 20), glm::u8vec4(255)) << x;
    EXPECT_EQ(p.at(x - 7, 20), glm::u8vec4(0, 0, 0, 255)) << x;
  }
}

TEST(PreparedScene, InstancesAreRelativeToTheirObject) {
  const SceneDescription scene = parsed(R"({"version": 1, "ambient": 1,
    "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "height": 4}},
    "objects": {"a": {"shape": "cube", "size": 0.4, "position": [0, 1, 0], "rotation": [0, 0, 90],
                      "instances": [{"position": [-2, 0, 0]}, {}]}}})");
  const Image<glm::u8vec4> p = picture_of(scene, 40, 40);  // 10 px per unit
  EXPECT_EQ(p.at(20, 10).x, 255) << "the instance at the position of the object";
  EXPECT_EQ(p.at(20, 30).x, 255) << "the x axis of the object points up, so the instance at -2 is below";
  EXPECT_EQ(p.at(20, 20).x, 0);
  EXPECT_EQ(p.at(10, 10).x, 0);
}

TEST(PreparedScene, PlanesAreLitOnTheVisibleSide) {
  const auto brightness = [](const char* light) {
    return picture_of(
               parsed(std::string(
                          R"({"version": 1, "cameras": {"c": {"position": [0, -5, 1]}}, "objects": {"floor": {"shape": "plane", "size": 9}},
      "lights": {"l": {"direction": )") +
                      light + "}}}"),
               16, 16)
        .at(8, 8)
        .x;
  };
  EXPECT_EQ(brightness("[0, 1, 0]"), 0) << "light from above, seen from below";
  EXPECT_EQ(brightness("[0, -1, 0]"), 255);
}

// Positions relative to the camera are computed in double, so a scene and camera far from the origin give the same image.
TEST(PreparedScene, ImageIsUnchangedFarFromTheOrigin) {
  const auto picture = [](double d) {
    SceneDescription scene = SceneFile::open("earth").description();
    scene.lights.front().second.position += glm::dvec3(d, -2 * d, d);
    scene.cameras.front().second.position += glm::dvec3(d, -2 * d, d);
    scene.cameras.front().second.target += glm::dvec3(d, -2 * d, d);
    scene.objects.front().second.placement.position += glm::dvec3(d, -2 * d, d);
    return picture_of(scene, 160, 100);
  };
  const Image<glm::u8vec4> here = picture(0), there = picture(1048576);  // 2^20: doubles retain 32 fractional bits
  int differing = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 160; ++x) differing += largest_difference(here.at(x, y), there.at(x, y)) > 1;
  }
  EXPECT_LE(differing, 2) << "a sample on a silhouette can change sides";
}

TEST(PreparedScene, RotationsAreDegreesAboutTheAxes) {
  // A bar along x. A rotation by 90° about z makes it upright; a subsequent rotation by 90° about x tilts it towards the eye.
  const auto covers = [](const char* rotation, int x, int y) {
    const SceneDescription scene = parsed(std::string(R"({"version": 1, "ambient": 1,
      "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "height": 4}},
      "objects": {"a": {"shape": "cube", "size": 1, "scale": [3, 0.4, 0.4], "rotation": )") +
                                          rotation + "}}}");
    return picture_of(scene, 40, 40).at(20 + x, 20 - y).x > 127;
  };
  EXPECT_TRUE(covers("[0, 0, 0]", 12, 0));
  EXPECT_FALSE(covers("[0, 0, 0]", 0, 12));
  EXPECT_TRUE(covers("[0, 0, 90]", 0, 12));
  EXPECT_FALSE(covers("[0, 0, 90]", 12, 0));
  EXPECT_FALSE(covers("[0, 90, 0]", 12, 0)) << "along z, seen from the end";
  EXPECT_TRUE(covers("[0, 0, 45]", 8, 8)) << "counter-clockwise, as seen from +z";
  EXPECT_FALSE(covers("[0, 0, 45]", 8, -8));
  EXPECT_FALSE(covers("[90, 0, 90]", 0, 12)) << "z is applied first, then x tilts the bar towards the eye";
}

TEST(PreparedScene, ReportsUnusableSettingsInOneLine) {
  EXPECT_THROW(moon_with({"moon.height_scale=2.5"}), InputError) << "2.5 can turn the sphere inside out";
  EXPECT_TRUE(reports(error_of(moon_with({"moon.height=surface"})), "objects.moon.height", {"color map", "height map"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.color=relief"})), "objects.moon.color", {"height map", "color map"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.normal_map=surface"})), "objects.moon.normal_map", {"color map", "data map"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.normal=map"})), "objects.moon.normal", {"normal_map", "image file"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.normal=bump"})), "objects.moon.normal", {"bump_map", "image file"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.color=/none.png"})), "objects.moon.color: /none.png", {"no such file"}));
  EXPECT_TRUE(reports(error_of(moon_with({"moon.height=/none.png"})), "objects.moon.height: /none.png", {"no such file"}));
  EXPECT_TRUE(reports(error_of(parsed(R"({"version": 1, "textures": {"t": {}}, "objects": {"a": {"color": "t"}}})")), "textures.t.file",
                      {"missing", "image file"}));
}

}  // namespace
}  // namespace halfspace
