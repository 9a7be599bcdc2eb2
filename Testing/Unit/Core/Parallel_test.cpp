// SPDX-License-Identifier: Apache-2.0
#include "Core/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "Core/Errors.h"
#include "Core/Progress.h"

using namespace myotet;

TEST(Parallel, EveryItemIsVisitedOnce) {
    std::vector<std::atomic<int>> seen(10007);
    parallel_for(7, seen.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++seen[i];
    });
    for (std::size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(seen[i], i < 7 ? 0 : 1);
}

TEST(Parallel, SumsAreTheSameBitsOnAnyNumberOfThreads) {
    const auto sum = [](int threads) {
        const ThreadLimit limit(threads);
        return parallel_sum(0, 100001, 128, [](std::size_t first, std::size_t last) {
            double s = 0;
            for (std::size_t i = first; i < last; ++i) s += std::sin(static_cast<double>(i));
            return s;
        });
    };
    const double one = sum(1);
    EXPECT_EQ(one, sum(2));
    EXPECT_EQ(one, sum(0));
    EXPECT_NE(one, 0);
}

TEST(Parallel, TheLimitHoldsWhileItLives) {
    const int before = thread_count();
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(thread_count(), 1);
    }
    EXPECT_EQ(thread_count(), before);
}

TEST(Parallel, AnExceptionLeavesTheLoop) {
    EXPECT_THROW(parallel_for(0, 1000, 1,
                              [](std::size_t first, std::size_t) {
                                  if (first == 500) throw InputError("stop");
                              }),
                 InputError);
}

TEST(Progress, AnInterruptedSinkThrowsWhenChecked) {
    class Stopped final : public ProgressSink {
        void report(std::string_view, double) override {}
        void warn(std::string_view) override {}
        void note(std::string_view) override {}
        [[nodiscard]] bool interrupted() const override { return true; }
    };
    EXPECT_THROW(Stopped().check(), Interrupted);
    EXPECT_NO_THROW(SilentProgress().check());
}

TEST(Check, SpeaksOfOurOwnMistakeAndCatchesNaN) {
    EXPECT_NO_THROW(MYOTET_CHECK(1 > 0, "fine"));
    EXPECT_THROW(MYOTET_CHECK(std::nan("") > 0, "not a number"), LogicError);
}
