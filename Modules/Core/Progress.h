// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <string_view>

namespace myotet {

/// Where long work tells how far it is, and hears that it should stop.
/// Calls may come from any thread.
class ProgressSink {
public:
    virtual ~ProgressSink() = default;
    /// `fraction` of `stage` is done, in [0, 1].
    virtual void report(std::string_view stage, double fraction) = 0;
    /// A thing the user should know: one sentence.
    virtual void warn(std::string_view sentence) = 0;
    virtual void note(std::string_view sentence) = 0;
    /// True when the user asked to stop.
    [[nodiscard]] virtual bool interrupted() const { return false; }
    /// Throws Interrupted when the user asked to stop.
    void check() const;
};

/// Tells nobody; never interrupted.
class SilentProgress final : public ProgressSink {
public:
    void report(std::string_view, double) override {}
    void warn(std::string_view) override {}
    void note(std::string_view) override {}
};

}  // namespace myotet
