// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

// What a channel animates. The node is -1 if it is missing.
struct ChannelTarget {
  int node = -1;
  std::string property;  // as in the file
};

std::optional<AnimatedProperty> property_of(std::string_view path) {
  if (path == "translation") return AnimatedProperty::translation;
  if (path == "rotation") return AnimatedProperty::rotation;
  if (path == "scale") return AnimatedProperty::scale;
  if (path == "weights") return AnimatedProperty::weights;
  if (path == "extensions/KHR_node_visibility/visible") return AnimatedProperty::visibility;
  return std::nullopt;
}

KeyInterpolation interpolation_of(const GltfDocument& document, const GltfValue& sampler) {
  const std::string name = document.string(sampler, "interpolation");
  if (name.empty() || name == "LINEAR") return KeyInterpolation::linear;
  if (name == "STEP") return KeyInterpolation::step;
  if (name == "CUBICSPLINE") return KeyInterpolation::cubic;
  document.fail(sampler, "interpolation", gltf_quoted(name) + " is unknown; expected LINEAR, STEP or CUBICSPLINE");
}

// Returns the number of morph targets of the meshes of a node.
int target_count(const Model& model, const ModelNode& node) {
  return node.meshes.empty() ? 0 : static_cast<int>(model.meshes[static_cast<std::size_t>(node.meshes[0])].targets.size());
}

int width_of(AnimatedProperty property, const Model& model, const ModelNode& node) {
  switch (property) {
    case AnimatedProperty::weights: return target_count(model, node);
    case AnimatedProperty::rotation: return 4;
    case AnimatedProperty::visibility: return 1;
    default: return 3;
  }
}

// Returns the node and the property of a JSON pointer "/nodes/NODE/PROPERTY" (KHR_animation_pointer). Other pointers are returned whole.
ChannelTarget target_of_pointer(const std::string& pointer, std::size_t nodes) {
  constexpr std::string_view kNodes = "/nodes/";
  if (!pointer.starts_with(kNodes)) return {-1, pointer};
  const char* const end = pointer.data() + pointer.size();
  int node = -1;
  const auto [rest, error] = std::from_chars(pointer.data() + kNodes.size(), end, node);
  if (error != std::errc() || rest == end || *rest != '/' || node < 0 || static_cast<std::size_t>(node) >= nodes) return {-1, pointer};
  return {node, std::string(rest + 1, end)};
}

class ChannelReader {
 public:
  ChannelReader(GltfAccessors& accessors, const GltfValue& samplers, const Model& model)
      : accessors_(accessors), document_(accessors.document()), samplers_(samplers), model_(model) {}

  /// Returns nullopt if the channel cannot be applied.
  std::optional<AnimationChannel> read(const GltfValue& json) {
    const GltfValue& target = document_.object(json, "target");
    const ChannelTarget animated = target_of(target);
    AnimationChannel channel;
    channel.node = animated.node;
    const std::optional<AnimatedProperty> property = property_of(animated.property);
    if (!property) {
      document_.warn("animations of " + gltf_quoted(animated.property) + " are not supported; they are skipped");
      return std::nullopt;
    }
    if (channel.node < 0) return std::nullopt;  // permitted by the specification
    const ModelNode& node = model_.nodes[static_cast<std::size_t>(channel.node)];
    if (node.matrix && *property != AnimatedProperty::weights && *property != AnimatedProperty::visibility) {
      document_.warn_at(target, "node", "the node has a matrix; its animation is skipped");
      return std::nullopt;
    }
    channel.property = *property;
    channel.width = width_of(*property, model_, node);
    if (channel.width == 0) {
      document_.warn_at(target, "path", "the node has no morph targets; its animation is skipped");
      return std::nullopt;
    }
    read_keys(samplers_[static_cast<std::size_t>(document_.required_index(json, "sampler", samplers_.size()))], channel);
    return channel;
  }

 private:
  ChannelTarget target_of(const GltfValue& target) const {
    const GltfValue* pointer = document_.extension(target, "KHR_animation_pointer");
    if (pointer != nullptr) return target_of_pointer(document_.string(*pointer, "pointer"), model_.nodes.size());
    const std::string path = document_.string(target, "path");
    return {document_.index(target, "node", model_.nodes.size()), path};
  }

  void read_keys(const GltfValue& sampler, AnimationChannel& channel) {
    channel.interpolation = interpolation_of(document_, sampler);
    if (channel.property == AnimatedProperty::visibility) channel.interpolation = KeyInterpolation::step;  // the only one for Booleans
    const GltfAccessor input = accessors_.find(sampler, "input"), output = accessors_.find(sampler, "output");
    accessors_.check_width(input, 1);
    if (input.component != GltfComponent::float32) document_.fail(*input.json, "componentType", "is not a float; expected 5126");
    accessors_.check_width(output, channel.property == AnimatedProperty::weights ? 1 : channel.width);
    channel.times = accessors_.read_floats(input);
    channel.values = accessors_.read_floats(output);
    check_times(*input.json, channel.times);
    const std::size_t per_key = static_cast<std::size_t>(channel.width) * (channel.interpolation == KeyInterpolation::cubic ? 3 : 1);
    if (channel.values.size() != channel.times.size() * per_key) {
      document_.fail(*output.json, "count",
                     fmt::format("the accessor has {} values; expected {} for each of {} keyframes", channel.values.size(), per_key,
                                 channel.times.size()));
    }
    for (const float x : channel.values) {
      if (!(std::abs(static_cast<double>(x)) <= kMaxModelNumber)) {
        document_.fail(*output.json, "has values that are not finite or exceed 1e18; expected smaller finite values");
      }
    }
  }

  void check_times(const GltfValue& json, const std::vector<float>& times) const {
    if (times.empty()) document_.fail(json, "count", "is 0; expected at least one keyframe");
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!(std::abs(times[i]) <= 1e9f) || (i > 0 && !(times[i] > times[i - 1]))) {
        document_.fail(json, fmt::format("time {} is {}; expected increasing times in seconds", i, times[i]));
      }
    }
  }

  GltfAccessors& accessors_;
  GltfDocument& document_;
  const GltfValue& samplers_;
  const Model& model_;
};

}  // namespace

void read_gltf_animations(GltfAccessors& accessors, Model& model) {
  GltfDocument& document = accessors.document();
  for (const GltfValue& json : document.list("animations")) {
    ModelAnimation animation;
    animation.name = document.string(json, "name");
    ChannelReader reader(accessors, document.objects(json, "samplers"), model);
    for (const GltfValue& channel : document.objects(json, "channels")) {
      if (std::optional<AnimationChannel> read = reader.read(channel)) animation.channels.push_back(std::move(*read));
    }
    model.animations.push_back(std::move(animation));
  }
}

}  // namespace halfspace::HS_LANES
