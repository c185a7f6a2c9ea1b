// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/read_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

struct ColorKey {
  std::string_view name;
  std::optional<glm::vec3> MtlMaterial::*member;
};
constexpr ColorKey kColors[] = {{"kd", &MtlMaterial::Kd}, {"ks", &MtlMaterial::Ks}, {"ke", &MtlMaterial::Ke}};

struct NumberKey {
  std::string_view name;
  std::optional<float> MtlMaterial::*member;
};
constexpr NumberKey kNumbers[] = {{"ns", &MtlMaterial::Ns}, {"d", &MtlMaterial::d},   {"tr", &MtlMaterial::Tr},
                                  {"ni", &MtlMaterial::Ni}, {"pr", &MtlMaterial::Pr}, {"pm", &MtlMaterial::Pm},
                                  {"ps", &MtlMaterial::Ps}, {"pc", &MtlMaterial::Pc}, {"pcr", &MtlMaterial::Pcr}};

struct MapKey {
  std::string_view name;
  MtlMap map;
};
constexpr MapKey kMaps[] = {{"map_kd", MtlMap::Kd},     {"map_ks", MtlMap::Ks},   {"map_ns", MtlMap::Ns},     {"map_ke", MtlMap::Ke},
                            {"map_d", MtlMap::d},       {"bump", MtlMap::bump},   {"map_bump", MtlMap::bump}, {"norm", MtlMap::norm},
                            {"map_norm", MtlMap::norm}, {"map_kn", MtlMap::norm}, {"map_pr", MtlMap::Pr},     {"map_pm", MtlMap::Pm},
                            {"map_ps", MtlMap::Ps},     {"map_pc", MtlMap::Pc},   {"map_pcr", MtlMap::Pcr}};

// Statements that are ignored: the environment replaces ambient light, and the others do not affect the appearance of a surface.
constexpr std::string_view kIgnored[] = {"ka", "map_ka", "tf", "km", "kt", "sharpness", "map_aat"};
constexpr std::string_view kNotDrawn[] = {"disp", "map_disp", "refl", "map_refl", "decal", "aniso", "anisor"};

// Texture options, with their maximum number of arguments and whether the arguments are numbers.
struct Option {
  std::string_view name;
  int max_arguments;
  bool numbers;
};
constexpr Option kOptions[] = {{"-s", 3, true},        {"-o", 3, true},          {"-t", 3, true},       {"-mm", 2, true},
                               {"-bm", 1, true},       {"-boost", 1, true},      {"-texres", 1, true},  {"-clamp", 1, false},
                               {"-imfchan", 1, false}, {"-blendu", 1, false},    {"-blendv", 1, false}, {"-cc", 1, false},
                               {"-type", 1, false},    {"-colorspace", 1, false}};

const Option* option_named(std::string_view name) {
  const auto* const option = std::ranges::find(kOptions, name, &Option::name);
  return option == std::end(kOptions) ? nullptr : option;
}

std::string lower(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

class MtlParser {
 public:
  MtlParser(std::string_view name, std::string_view text, std::vector<std::string>& warnings)
      : name_(name), lines_(text), warnings_(warnings) {}

  std::vector<MtlMaterial> parse() {
    while (lines_.next()) {
      std::string_view rest = lines_.line();
      const std::string_view word = take_word(rest);
      if (word.empty() || word[0] == '#') continue;
      const std::string key = lower(word);
      if (key == "newmtl") {
        if (materials_.size() == kMaxMtlMaterials) {
          warn_once(key, fmt::format("has more than {} materials; the rest is skipped", kMaxMtlMaterials));
          break;
        }
        materials_.emplace_back().name = trimmed(rest);
      } else if (materials_.empty()) {
        warn_once("order", "statements before the first `newmtl` are ignored");
      } else {
        statement(key, rest);
      }
    }
    return std::move(materials_);
  }

 private:
  void warn_once(const std::string& kind, const std::string& text) {
    if (warned_.insert(kind).second) warnings_.push_back(fmt::format("{}:{}: {}", name_, lines_.number(), text));
  }

  void statement(const std::string& key, std::string_view rest) {
    MtlMaterial& material = materials_.back();
    if (const auto* const known = std::ranges::find(kColors, key, &ColorKey::name); known != std::end(kColors)) {
      return set_color(key, rest, material.*known->member);
    }
    if (const auto* const known = std::ranges::find(kNumbers, key, &NumberKey::name); known != std::end(kNumbers)) {
      return set_number(key, rest, material.*known->member);
    }
    if (const auto* const known = std::ranges::find(kMaps, key, &MapKey::name); known != std::end(kMaps)) {
      return set_texture(rest, material.maps[static_cast<std::size_t>(known->map)]);
    }
    if (key == "illum") {
      std::optional<float> value;
      set_number(key, rest, value);
      if (value && *value >= 0.0f && *value <= 10.0f) material.illum = static_cast<int>(*value);
      return;
    }
    if (std::ranges::find(kIgnored, key) != std::end(kIgnored)) return;
    if (std::ranges::find(kNotDrawn, key) != std::end(kNotDrawn))
      return warn_once(key, in_quotes(key) + " is not supported and is ignored");
    warn_once("unknown", "unknown statement " + in_quotes(key) + " is ignored, like all other unknown statements");
  }

  std::optional<double> read_number(const std::string& key, std::string_view word) {
    const std::optional<double> value = number_in(word);
    if (!value) warn_once(key, fmt::format("cannot read {} as a number; such '{}' statements are ignored", in_quotes(word), key));
    return value;
  }

  // A single number is a gray. Spectral curves and CIE XYZ colors are not read.
  void set_color(const std::string& key, std::string_view rest, std::optional<glm::vec3>& color) {
    glm::vec3 value(0.0f);
    int count = 0;
    for (std::string_view word = take_value(rest); !word.empty() && count < 3; word = take_value(rest), ++count) {
      const std::optional<double> number = read_number(key, word);
      if (!number) return;
      value[count] = static_cast<float>(*number);
    }
    if (count == 1) value = glm::vec3(value.x);
    if (count == 1 || count == 3) color = value;
  }

  void set_number(const std::string& key, std::string_view rest, std::optional<float>& number) {
    std::string_view word = take_value(rest);
    if (word == "-halo") word = take_value(rest);
    if (word.empty()) return;
    if (const std::optional<double> value = read_number(key, word)) number = static_cast<float>(*value);
  }

  // The file name is the rest of the line after the options, so it may contain spaces. Some programs write options after it.
  void set_texture(std::string_view rest, MtlTexture& texture) {
    texture = {};
    take_options(rest, texture);
    rest = trimmed(rest);
    for (std::size_t at = rest.find(" -"); at != std::string_view::npos; at = rest.find(" -", at + 1)) {
      std::string_view tail = rest.substr(at);
      std::string_view words = tail;
      if (option_named(take_word(words)) == nullptr) continue;
      take_options(tail, texture);
      rest = rest.substr(0, at);
      break;
    }
    texture.file = without_quotes(trimmed(rest));
  }

  void take_options(std::string_view& rest, MtlTexture& texture) {
    while (true) {
      std::string_view after = rest;
      const Option* const option = option_named(take_word(after));
      if (option == nullptr) return;
      rest = after;
      take_option(*option, rest, texture);
    }
  }

  void take_option(const Option& option, std::string_view& rest, MtlTexture& texture) {
    glm::vec3 values(option.name == "-s" || option.name == "-bm" ? 1.0f : 0.0f);
    std::string_view word;
    for (int i = 0; i < option.max_arguments; ++i) {
      std::string_view after = rest;
      const std::string_view next = take_word(after);
      const std::optional<double> value = number_in(next);
      if (option.numbers && !parse_number(next)) break;
      word = next;
      if (option.numbers && !value) {
        warn_once(std::string(option.name), fmt::format("cannot use {} for option {}; it is ignored", in_quotes(next), option.name));
        rest = after;
        continue;
      }
      values[i] = static_cast<float>(value.value_or(0.0));
      rest = after;
    }
    if (word.empty()) return;
    if (option.name == "-s") texture.scale = glm::vec2(values);
    if (option.name == "-o") texture.offset = glm::vec2(values);
    if (option.name == "-clamp") texture.clamp = word == "on";
    if (option.name == "-bm") texture.bump_multiplier = values.x;
    if (option.name == "-imfchan") texture.channel = word[0];
    if (option.name == "-t" || option.name == "-mm") warn_once(std::string(option.name), fmt::format("option {} is ignored", option.name));
  }

  std::string_view name_;
  TextLines lines_;
  std::vector<std::string>& warnings_;
  std::set<std::string> warned_;
  std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view name, std::string_view text, std::vector<std::string>& warnings) {
  return MtlParser(name, text, warnings).parse();
}

}  // namespace halfspace::HS_LANES
