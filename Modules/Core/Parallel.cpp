// SPDX-License-Identifier: Apache-2.0
#include "Core/Parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

namespace myotet {

struct ThreadLimit::Impl {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(threads > 0 ? new Impl{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                       static_cast<std::size_t>(threads))}
                        : nullptr) {}

ThreadLimit::~ThreadLimit() = default;

int thread_count() {
    const auto limit =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(limit));
}

void parallel_for(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end) return;
    if (end - begin <= grain) return body(begin, end);
    // Isolated: a thread that waits for the end of an inner loop helps with that
    // loop only, and does not begin another piece of an outer one meanwhile.
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              body(range.begin(), range.end());
                          });
    });
}

double parallel_sum(std::size_t begin, std::size_t end, std::size_t grain,
                    const std::function<double(std::size_t, std::size_t)>& body) {
    if (begin >= end) return 0;
    const std::size_t pieces = (end - begin + grain - 1) / grain;
    std::vector<double> partial(pieces);
    parallel_for(0, pieces, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            partial[i] = body(begin + i * grain, std::min(end, begin + (i + 1) * grain));
    });
    double sum = 0;
    for (const double p : partial) sum += p;
    return sum;
}

}  // namespace myotet
