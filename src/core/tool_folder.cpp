// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/tool_folder.h"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <atomic>
#include <system_error>
#include <vector>

namespace halfspace::HS_LANES {

namespace {

struct ToolFolder {
  std::filesystem::path path;
  const ToolFolder* previous;
};

// The folder that set_tool_folder() set, or null. Earlier folders are never deleted: another thread may still read them, and a lock
// could be held by a thread that does not exist after fork().
std::atomic<const ToolFolder*> tool_folder = nullptr;

// Returns the file that contains this function: a shared library, or the program.
std::filesystem::path this_binary() {
  Dl_info info;
  link_map* map = nullptr;
  const int found = ::dladdr1(reinterpret_cast<const void*>(&this_binary), &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP);
  std::error_code error;
  if (found != 0 && map != nullptr && map->l_name[0] != '\0') return std::filesystem::canonical(map->l_name, error);
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

std::vector<std::filesystem::path> tool_folders() {
  if (const ToolFolder* set = tool_folder.load(); set != nullptr && !set->path.empty()) return {set->path};
  std::filesystem::path folder = this_binary().parent_path();
  if (folder.empty()) return {};
  // In packages, the libraries of the programs and of the Python module are in FOLDER/glibc-hwcaps/LEVEL.
  if (folder.parent_path().filename() == "glibc-hwcaps") folder = folder.parent_path().parent_path();
  // An installed Python module is in PREFIX/lib/python3/dist-packages/halfspace or PREFIX/lib/python3.N/site-packages/halfspace.
  const std::filesystem::path parent = folder.parent_path().filename();
  const bool is_python = parent == "dist-packages" || parent == "site-packages";
  return {folder, folder / "halfspace", folder / (is_python ? "../../../../bin" : "") / HALFSPACE_TOOLS_FROM_BIN};
}

}  // namespace

void set_tool_folder(const std::filesystem::path& folder) {
  auto* const next = new ToolFolder{folder, tool_folder.load()};
  while (!tool_folder.compare_exchange_weak(next->previous, next)) {
  }
}

std::filesystem::path find_tool(const char* name) {
  for (const std::filesystem::path& folder : tool_folders()) {
    const std::filesystem::path candidate = (folder / name).lexically_normal();
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

}  // namespace halfspace::HS_LANES
