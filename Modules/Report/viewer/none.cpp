// SPDX-License-Identifier: Apache-2.0
// Stands in for the viewer's program where npm is not there to make it.
#include "Report/ViewerProgram.h"

namespace myotet::report {

const std::string_view kViewerProgram;
const std::string_view kViewerNotices;

}  // namespace myotet::report
