// SPDX-License-Identifier: Apache-2.0
//
// Environments are read from files, or generated at the resolution that the view needs.
#include "halfspace/render/prepare/scene_environments.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/half.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/procedural/earth.h"
#include "halfspace/procedural/sky.h"

namespace halfspace::HS_LANES {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kFaceNames{"right", "left", "top", "bottom", "front", "back"};

// Reads a cube map face or a panorama.
TextureImage read_picture(const fs::path& path) { return read_texels(path, ImageUse::colors); }

TexelFormat format_for(const Image<glm::u8vec4>&) { return TexelFormat::srgb8a8; }
// Returns half floats if their range is sufficient, otherwise floats.
TexelFormat format_for(const Image<glm::vec4>& image) {
  const bool wide = std::ranges::any_of(image.texels(), [](const glm::vec4& t) { return std::max({t.x, t.y, t.z}) > kMaxHalf; });
  return wide ? TexelFormat::rgba32f : TexelFormat::rgba16f;
}

// Returns the only file in the folder that is named NAME, with any extension.
fs::path face_in(const fs::path& folder, const std::string& name) {
  std::error_code error;
  fs::path found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().stem() != name) continue;
    if (!found.empty()) throw InputError(folder.string() + ": has two files for the face " + name + "; expected one");
    found = entry.path();
  }
  if (error) throw InputError(folder.string() + ": cannot be read (" + error.message() + "); expected a folder of six faces");
  if (found.empty())
    throw InputError(folder.string() + ": has no file for the face " + name + "; expected " + name + ".png or another image");
  return found;
}

std::array<fs::path, 6> face_files(const EnvironmentDescription& e) {
  const std::array<const FilePath*, 6> own{&e.right, &e.left, &e.top, &e.bottom, &e.front, &e.back};
  std::array<fs::path, 6> files;
  for (std::size_t f = 0; f < 6; ++f) {
    if (own[f]->path.empty() && e.folder.path.empty())
      throw InputError(std::string("the face ") + kFaceNames[f] + " is missing; expected an image file, or a folder of six");
    files[f] = own[f]->path.empty() ? face_in(e.folder.path, kFaceNames[f]) : own[f]->path;
  }
  return files;
}

template <class Texel>
EnvironmentMap cube_of(const std::array<fs::path, 6>& files, std::array<TextureImage, 6>& pictures, const Workers& workers) {
  std::array<Image<Texel>, 6> faces;
  TexelFormat format = std::is_same_v<Texel, glm::u8vec4> ? TexelFormat::srgb8a8 : TexelFormat::rgba16f;
  for (std::size_t f = 0; f < 6; ++f) {
    auto* face = std::get_if<Image<Texel>>(&pictures[f]);
    if (face == nullptr)
      throw InputError(fmt::format("{}: has 8 bits per channel and {} has more, or the reverse; expected six faces with the same number",
                                   files[f].string(), files[0].string()));
    faces[f] = std::move(*face);
    const int width = faces[f].width(), height = faces[f].height(), size = faces[0].width();
    if (width != height) throw InputError(fmt::format("{}: is {}x{}; expected a square face", files[f].string(), width, height));
    if (width != size) {
      throw InputError(fmt::format("{}: is {}x{}, but {} is {}x{}; expected six faces of the same size", files[f].string(), width, height,
                                   files[0].string(), size, size));
    }
    format = std::max(format, format_for(faces[f]));
  }
  return EnvironmentMap(faces, format, &workers);
}

EnvironmentMap read_cube(const std::array<fs::path, 6>& files, const Workers& workers) {
  std::array<TextureImage, 6> pictures;
  std::ranges::transform(files, pictures.begin(), read_picture);
  return std::holds_alternative<Image<glm::u8vec4>>(pictures[0]) ? cube_of<glm::u8vec4>(files, pictures, workers)
                                                                 : cube_of<glm::vec4>(files, pictures, workers);
}

EnvironmentMap read_panorama(const fs::path& path, const std::string& where) {
  return read_for(
      where, [&] { return std::visit([](const auto& image) { return EnvironmentMap(image, format_for(image)); }, read_picture(path)); });
}

EnvironmentMap uniform(const Color& color) {
  Image<glm::vec4> one(1, 1);
  one.at(0, 0) = glm::vec4(glm::vec3(color.linear), 1.0f);
  return EnvironmentMap(one, TexelFormat::rgba32f);
}

std::size_t bytes_of(const EnvironmentMap& map) {
  std::size_t texels = 0;  // of one face, with borders
  for (int i = 0; i < map.levels(); ++i) texels += static_cast<std::size_t>(map.width(i) + 2) * static_cast<std::size_t>(map.height(i) + 2);
  return texels * (map.layout() == EnvironmentLayout::cube ? 6 : 1) * (map.format() == TexelFormat::rgba32f ? 16 : 8);
}

}  // namespace

// Returns the panorama width that the view needs: texels in the center of the image span at most two pixels, up to a width of 4096.
int SceneEnvironments::panorama_width() const {
  const double circumference_px = std::numbers::pi / view_.tan_y * view_.height_px;
  int width = std::max(256, minimum_.panorama_width);
  while (width < 4096 && 2 * width < circumference_px) width *= 2;
  return width;
}

// Like panorama_width, for a face of a cube map, whose texels are largest at its center.
int SceneEnvironments::face_size() const {
  int size = std::max(64, minimum_.face);
  while (size < 1024 && size < view_.height_px / (2.0 * view_.tan_y)) size *= 2;
  return size;
}

SceneEnvironments::MapSource SceneEnvironments::source_of(const std::string& path, const EnvironmentDescription& e) {
  switch (e.type) {
    case EnvironmentType::equirect:
    case EnvironmentType::globe: return panorama(path, e);
    case EnvironmentType::cube: {
      const std::array<fs::path, 6> files = read_for(path, [&] { return face_files(e); });
      std::string words = "cube ";
      for (const fs::path& file : files) words += recipe(file.string());
      return {words, [=, this] { return read_for(path, [&] { return read_cube(files, workers_); }); }};
    }
    default: return generated_sky(e);
  }
}

SceneEnvironments::MapSource SceneEnvironments::panorama(const std::string& path, const EnvironmentDescription& e) {
  if (const auto* color = std::get_if<Color>(&e.map)) {
    const glm::dvec3& c = color->linear;
    return {recipe("uniform", c.x, c.y, c.z), [color = *color] { return uniform(color); }};
  }
  TextureDescription texture;
  if (const auto* file = std::get_if<FilePath>(&e.map)) {
    texture.file = *file;
  } else {
    texture = maps_.texture_named(std::get<TextureName>(e.map).name);
  }
  const int width = texture.width != 0 ? texture.width : panorama_width();
  switch (texture.source) {
    case TextureSource::file:
      return {recipe("panorama", texture.file.path.string()),
              [path, file = texture.file.path] { return read_panorama(file, path + ".map"); }};
    case TextureSource::earth_color:
      return {recipe("earth_color panorama", width),
              [=, this] { return EnvironmentMap(procedural_earth(width, width / 2, workers_), TexelFormat::srgb8a8); }};
    case TextureSource::moon_color:
      return {recipe("moon_color panorama", width),
              [=, this] { return EnvironmentMap(maps_.moon_maps(width)->color, TexelFormat::srgb8a8); }};
    default: throw InputError(path + ".map: is not a color map; expected one");
  }
}

SceneEnvironments::MapSource SceneEnvironments::generated_sky(const EnvironmentDescription& e) const {
  const int size = e.size != 0 ? e.size : face_size();
  const auto map = [this](const SkyFaces& faces) { return EnvironmentMap(faces, TexelFormat::rgba16f, &workers_); };
  if (e.type == EnvironmentType::night_sky) {
    const NightSky sky{static_cast<float>(e.milky_way)};
    return {recipe("night_sky", size, e.milky_way), [=, this] { return map(procedural_night_sky(size, sky, workers_)); }, true};
  }
  if (e.type == EnvironmentType::studio) {
    return {recipe("studio", size), [=, this] { return map(procedural_studio(size, workers_)); }, true};
  }
  // The sun direction is given in world space, so rotating the sky moves the clouds but not the sun.
  const glm::dvec3 sun = unit_or_zero(glm::transpose(glm::dmat3(world_from_object({.rotation = e.rotation}))) * e.sun);
  const DaySky sky{kMapFromWorld * glm::vec3(sun), static_cast<float>(e.clouds)};
  return {recipe("day_sky", size, sun.x, sun.y, sun.z, e.clouds), [=, this] { return map(procedural_day_sky(size, sky, workers_)); }, true};
}

const EnvironmentMap* SceneEnvironments::map_of(const MapSource& source) {
  if (source.is_shared) return used_.shared_asset<EnvironmentMap>(source.recipe, source.make, bytes_of).get();
  return used_.asset<EnvironmentMap>(source.recipe, source.make).get();
}

const FilteredEnvironment* SceneEnvironments::filtered(const MapSource& source) {
  constexpr int kSize = 128;
  const std::string words = recipe("filtered", source.recipe);
  const auto make = [&] { return FilteredEnvironment(*map_of(source), kSize, workers_); };
  if (source.is_shared) {
    const auto bytes = [](const FilteredEnvironment& f) { return bytes_of(f.radiance); };
    return used_.shared_asset<FilteredEnvironment>(words, make, bytes).get();
  }
  map_of(source);  // so that both are dropped from the cache together
  return used_.asset<FilteredEnvironment>(words, make).get();
}

SceneEnvironments::Placed SceneEnvironments::placed(const std::string& name, const EnvironmentDescription& e) {
  const glm::mat3 world_from_turned(glm::dmat3(world_from_object({.rotation = e.rotation})));
  return {source_of("environments." + name, e),
          (e.type == EnvironmentType::globe ? kMapFromGlobe : kMapFromWorld) * glm::transpose(world_from_turned),
          static_cast<float>(e.brightness)};
}

const std::pair<std::string, EnvironmentDescription>& SceneEnvironments::named(const std::string& name) const {
  const auto found = std::ranges::find_if(scene_.environments, [&](const auto& e) { return e.first == name; });
  return found == scene_.environments.end() ? scene_.environments.front() : *found;
}

SceneEnvironments::PlacedBlend SceneEnvironments::placed_background() {
  const BackgroundDescription& b = scene_.background;
  const auto make = [&](const std::string& name) {
    const auto& [found, e] = named(name);
    return placed(found, e);
  };
  PlacedBlend blend;
  blend.weight = b.second.empty() ? 0.0f : static_cast<float>(b.weight);
  if (blend.weight < 1.0f) blend.first = make(b.environment);
  if (blend.weight > 0.0f) blend.second = make(b.second);
  return blend;
}

// Returns the environment that the scene's reflections show.
SceneEnvironments::PlacedBlend SceneEnvironments::placed_reflection() {
  if (const std::string& name = scene_.reflections.environment; !name.empty()) return {placed(name, named(name).second), {}};
  if (scene_.background.type == BackgroundType::environment) return placed_background();
  EnvironmentDescription color;
  color.map = scene_.background.color;
  return {placed("background", color), {}};
}

EnvironmentBlend SceneEnvironments::blend_of(const PlacedBlend& placed) {
  const auto environment_of = [&](const std::optional<Placed>& e) -> Environment {
    if (!e) return {};
    return {map_of(e->source), e->map_from_world, e->brightness};
  };
  return {environment_of(placed.first), environment_of(placed.second), placed.weight};
}

EnvironmentBlend SceneEnvironments::background() { return blend_of(placed_background()); }

const EnvironmentBlend* SceneEnvironments::reflected_environment() {
  if (!scene_.reflections.on) return nullptr;
  if (reflected_environment_ == nullptr) {
    reflected_environment_ = std::make_shared<const EnvironmentBlend>(blend_of(placed_reflection()));
    used_.keep(reflected_environment_);
  }
  return reflected_environment_.get();
}

glm::dvec3 SceneEnvironments::mean_light() {
  if (scene_.reflections.environment.empty()) return glm::dvec3(0.0);
  const EnvironmentLightBlend* around = light();
  if (around == nullptr) return glm::dvec3(0.0);
  return glm::dvec3(around->first.map->harmonics[0] * around->first.brightness);
}

const EnvironmentLightBlend* SceneEnvironments::light() {
  if (!scene_.reflections.on) return nullptr;
  if (light_ == nullptr) {
    const PlacedBlend blend = placed_reflection();
    const auto light_of = [&](const std::optional<Placed>& e) -> EnvironmentLight {
      if (!e) return {};
      return {filtered(e->source), e->map_from_world, e->brightness};
    };
    light_ =
        std::make_shared<const EnvironmentLightBlend>(EnvironmentLightBlend{light_of(blend.first), light_of(blend.second), blend.weight});
    used_.keep(light_);
  }
  return light_.get();
}

}  // namespace halfspace::HS_LANES
