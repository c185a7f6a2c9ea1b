// SPDX-License-Identifier: Apache-2.0
//
// An OpenGL context without a window for Mesa's software rasterizer llvmpipe, which serves as an independent reference.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace halfspace::test {

/// A surfaceless EGL context with OpenGL 4.5 core on llvmpipe. It is current on the thread that created it until it is destroyed.
class MesaContext {
 public:
  /// Returns null if EGL, Mesa or llvmpipe is missing; missing then names the missing part in one line. Sets process-wide environment
  /// variables that select llvmpipe and its exact texture filtering (see the .cpp).
  static std::unique_ptr<MesaContext> create(std::string& missing);
  ~MesaContext();
  MesaContext(const MesaContext&) = delete;
  MesaContext& operator=(const MesaContext&) = delete;

  /// GL_RENDERER and GL_VERSION, for the log.
  const std::string& description() const { return description_; }

 private:
  MesaContext() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string description_;
};

/// Fixture for tests that draw with Mesa; skips them with a reason if Mesa is not available. Base: testing::Test or
/// testing::TestWithParam<…>.
template <class Base>
class MesaFixture : public Base {
 protected:
  void SetUp() override {
    std::string missing;
    mesa_ = MesaContext::create(missing);
    if (!mesa_) GTEST_SKIP() << "not compared with Mesa: " << missing;
  }

 private:
  std::unique_ptr<MesaContext> mesa_;
};
using MesaTest = MesaFixture<testing::Test>;

}  // namespace halfspace::test
