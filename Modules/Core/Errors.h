// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace myotet {

/// Base of all that Myotet throws on purpose. A message is one sentence that
/// says where, the value, the rule it breaks and the remedy.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The input breaks a rule: a file's content, an option, a name.
struct InputError : Error {
    using Error::Error;
};
/// A mesh breaks a promise or cannot be worked on.
struct MeshError : Error {
    using Error::Error;
};
/// A file cannot be opened, read or written.
struct IoError : Error {
    using Error::Error;
};
/// Memory, disk or an index range would not suffice.
struct ResourceError : Error {
    using Error::Error;
};
/// The user asked to stop.
struct Interrupted : Error {
    Interrupted() : Error("interrupted") {}
};

/// Our own mistake: a condition that the code guarantees does not hold.
struct LogicError : std::logic_error {
    using std::logic_error::logic_error;
};

}  // namespace myotet

#define MYOTET_CHECK_TEXT_(line) #line
#define MYOTET_CHECK_LINE_(line) MYOTET_CHECK_TEXT_(line)
/// Stays on in Release. Write conditions so that NaN fails.
#define MYOTET_CHECK(condition, message)                                                    \
    do {                                                                                    \
        if (!(condition))                                                                   \
            throw ::myotet::LogicError(std::string("internal check failed: ") + (message) + \
                                       " [" #condition ", " __FILE__                        \
                                       ":" MYOTET_CHECK_LINE_(__LINE__) "]");               \
    } while (false)
