// SPDX-License-Identifier: Apache-2.0
//
// Mesa's software rasterizer llvmpipe as a second opinion: an OpenGL context without a window.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace halfspace::test {

/// A surfaceless EGL context of OpenGL 4.5 core on llvmpipe, current on the thread that made it until destroyed.
class MesaContext {
 public:
  /// Null where EGL, Mesa or llvmpipe is absent; why_not then says in one line what is missing. Sets the environment
  /// variables that choose llvmpipe and its exact texture filtering (see the .cpp), for the whole process.
  static std::unique_ptr<MesaContext> create(std::string& why_not);
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

/// A test that draws with Mesa, or is skipped with the reason. Base: testing::Test or testing::TestWithParam<…>.
template <class Base>
class MesaFixture : public Base {
 protected:
  void SetUp() override {
    std::string why_not;
    mesa_ = MesaContext::create(why_not);
    if (!mesa_) GTEST_SKIP() << "not compared with Mesa: " << why_not;
  }

 private:
  std::unique_ptr<MesaContext> mesa_;
};
using MesaTest = MesaFixture<testing::Test>;

}  // namespace halfspace::test
