// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace halfspace {

/// Returns the commit from which this program was built, or "COMMIT+CHANGES" if its sources differed from it, where CHANGES identifies the
/// differences. Outside of a Git repository, COMMIT is "unknown" and CHANGES identifies the sources.
const char* build_commit();

}  // namespace halfspace
