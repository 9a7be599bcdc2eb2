// SPDX-License-Identifier: Apache-2.0
#include "ExitCodes.h"

#include <new>

namespace myotet::app {

Ending ending_for(const std::exception_ptr& thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const UsageError& error) {
        return {ExitCode::usage, error.what()};
    } catch (const InputError& error) {
        return {ExitCode::bad_input, error.what()};
    } catch (const IoError& error) {
        return {ExitCode::bad_input, error.what()};
    } catch (const MeshError& error) {
        return {ExitCode::broken_promise, error.what()};
    } catch (const ResourceError& error) {
        return {ExitCode::out_of_resource, error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitCode::out_of_resource,
                "memory ran out; use a longer --edge-length, fewer --labels or a larger machine"};
    } catch (const Interrupted&) {
        return {ExitCode::interrupted, "interrupted; nothing was left half-written"};
    } catch (const std::exception& error) {
        return {ExitCode::bug, std::string(error.what()) +
                                   "; this is a mistake in Myotet, please "
                                   "report it with the command and input"};
    } catch (...) {
        return {ExitCode::bug, "an unknown failure; this is a mistake in Myotet, please report it"};
    }
}

}  // namespace myotet::app
