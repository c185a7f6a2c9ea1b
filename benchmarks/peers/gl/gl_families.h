// SPDX-License-Identifier: Apache-2.0
//
// What each file of OpenGL workloads gives to the table in gl_workload.cpp.
#pragma once

#include <memory>

#include "sphere_camera.h"
#include "workload.h"

namespace halfspace::gl {

std::unique_ptr<Workload> clear(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> fill(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> tiny(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> draws(std::string_view name, WorkloadSize size, WorkloadAssets& assets);

enum class Layers { plain, blended, perforated, prepass };
std::unique_ptr<Workload> layers(std::string_view name, WorkloadSize size, WorkloadAssets& assets, Layers kind, bool front_to_back);

enum class Light { pixel, vertex, flat };
std::unique_ptr<Workload> sphere(std::string_view name, WorkloadSize size, WorkloadAssets& assets, Light light, SphereDetail detail);
std::unique_ptr<Workload> near_clip(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> hdr(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> tonemap(std::string_view name, WorkloadSize size, WorkloadAssets& assets);

std::unique_ptr<Workload> shadow(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> points(std::string_view name, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> floor(std::string_view name, WorkloadSize size, WorkloadAssets& assets);

}  // namespace halfspace::gl
