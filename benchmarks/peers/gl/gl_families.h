// SPDX-License-Identifier: Apache-2.0
//
// The functions that prepare the OpenGL workloads, for the tables in gl_workload.cpp.
#pragma once

#include <memory>

#include "peers/gl/gl_workload.h"
#include "workloads/sphere_camera.h"

namespace halfspace::gl {

using Made = std::unique_ptr<Workload>;

Made clear(const GlInput& in);
Made fill(const GlInput& in);
Made triangles(const GlInput& in, int count, double area);
Made draws(const GlInput& in);

enum class Layers { plain, blended, perforated, prepass };
Made layers(const GlInput& in, Layers kind, bool front_to_back, int count);

enum class Light { pixel, vertex, flat };
Made sphere(const GlInput& in, Light light, SphereDetail detail);
Made multisampled_sphere(const GlInput& in);
Made near_clip(const GlInput& in);
Made hdr(const GlInput& in);
Made tonemap(const GlInput& in);

Made shadow(const GlInput& in);
Made points(const GlInput& in);
Made floor(const GlInput& in);
Made varyings(const GlInput& in, int count);

}  // namespace halfspace::gl
