// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "Core/Errors.h"

namespace myotet::app {

/// How the program ends; the README lists them.
enum class ExitCode : int {
    done = 0,
    bug = 1,              ///< our own mistake
    usage = 2,            ///< the command line makes no sense
    bad_input = 3,        ///< a file, a name or a value breaks a rule
    broken_promise = 4,   ///< a mesh is not what Myotet promises
    not_converged = 5,    ///< a solver did not converge
    out_of_resource = 6,  ///< memory, disk or an index range would not suffice
    interrupted = 130,    ///< SIGINT or SIGTERM, as shells say it
};

/// Options that contradict each other or the kind of input.
struct UsageError : InputError {
    using InputError::InputError;
};

/// The code and the sentence for what was thrown.
struct Ending {
    ExitCode code = ExitCode::bug;
    std::string sentence;
};
[[nodiscard]] Ending ending_for(const std::exception_ptr& thrown);

}  // namespace myotet::app
