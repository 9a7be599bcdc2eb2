// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace myotet {

/// Bounds the number of threads that work at once while it lives (0: as many
/// as the process may use). Results never depend on it.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Threads that parallel loops use now.
[[nodiscard]] int thread_count();

/// Calls body(first, last) over disjoint pieces of [begin, end) of about
/// `grain` items. Bodies may run at the same time and in any order; they must
/// write to places of their own. An exception leaves the loop.
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Sum of body(first, last) over pieces of exactly `grain` items (the last
/// may be shorter), added in the order of the pieces: the same result for any
/// number of threads.
[[nodiscard]] double parallel_sum(std::size_t begin, std::size_t end, std::size_t grain,
                                  const std::function<double(std::size_t, std::size_t)>& body);

}  // namespace myotet
