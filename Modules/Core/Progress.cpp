// SPDX-License-Identifier: Apache-2.0
#include "Core/Progress.h"

#include "Core/Errors.h"

namespace myotet {

void ProgressSink::check() const {
    if (interrupted()) throw Interrupted();
}

}  // namespace myotet
