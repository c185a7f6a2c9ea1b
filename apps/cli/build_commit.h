// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace halfspace {

/// Returns the commit from which this program was built, "COMMIT+CHANGES" if its sources differed from it, where CHANGES identifies the
/// differences, or "unknown" outside of a Git repository.
const char* build_commit();

}  // namespace halfspace
