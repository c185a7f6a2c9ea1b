// SPDX-License-Identifier: Apache-2.0
#include "cli/mpi_queue.h"

#include <dlfcn.h>

#include <filesystem>

#include "command_line/errors.h"
#include "halfspace/core/available_cpus.h"
#include "halfspace/core/tool_folder.h"

namespace halfspace {

namespace {

constexpr const char* kPlugin = "halfspace-mpi.so";

const MpiFunctions* load() {
  const std::filesystem::path plugin = find_tool(kPlugin);
  if (plugin.empty()) throw UsageError("--mpi: this build has no MPI; expected --shard, or a build with OpenMPI (install_deps.sh --mpi)");
  // The plugins of OpenMPI itself need the symbols of its libraries.
  void* library = ::dlopen(plugin.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) throw UsageError(std::string("--mpi: cannot be loaded (") + ::dlerror() + "); expected the libraries of OpenMPI");
  const void* functions = ::dlsym(library, "halfspace_mpi_functions");
  if (functions == nullptr) throw UsageError("--mpi: " + plugin.string() + " is not the plugin for --mpi; expected that of this build");
  return static_cast<const MpiFunctions*>(functions);
}

}  // namespace

MpiQueue::MpiQueue() : functions_(load()), place_(functions_->start(cgroup_cpus().value_or(0))) {}

MpiQueue::~MpiQueue() { functions_->end(); }

std::optional<int> MpiQueue::next(const PictureCounts& own) {
  const int number = functions_->next(own);
  return number < 0 ? std::nullopt : std::optional(number);
}

void MpiQueue::finish(const std::string& result, const std::function<void(const std::string&)>& receive) {
  const auto pass = [](void* context, const char* text, std::size_t size) {
    (*static_cast<const std::function<void(const std::string&)>*>(context))(std::string(text, size));
  };
  functions_->finish(result.data(), result.size(), pass, const_cast<std::function<void(const std::string&)>*>(&receive));
  is_finished_ = true;
}

}  // namespace halfspace
